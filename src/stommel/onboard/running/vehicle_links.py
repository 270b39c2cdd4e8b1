"""The links of a running vehicle: one over its radio, one at the bench where there is a port for it."""

import os
from collections.abc import Callable

from stommel.files.storage import Storage
from stommel.onboard.coordination.config import Configuration
from stommel.onboard.coordination.coordinator import Coordinator
from stommel.onboard.coordination.stores.missions import MissionStore, StoredMission
from stommel.onboard.radio.files import VehicleFiles
from stommel.onboard.radio.flown_mission import FlownMission
from stommel.onboard.radio.mission_port import MissionPort
from stommel.onboard.radio.vehicle_link import LinkSettings, VehicleLink
from stommel.onboard.running.folders import bench_storage, inbox_of, storage_of
from stommel.onboard.running.port_link import Port, PortLink, Tell
from stommel.onboard.running.vehicle_key import guard_of

RADIO, BENCH = "radio", "bench"


class VehicleLinks:
    """Every link of a vehicle; they share missions, files and key, and each remembers its own commands.

    Parameters
    ----------
    configuration
        From `read_configuration`.
    coordinator
        Who decides.
    missions
        Of the vehicle.
    fly
        Lets a mission be flown that was taken.
    utc
        UTC by the vehicle's clock [s since 1970] at a time of the vehicle [s].
    radio, bench
        The ports; no bench where the configuration names none.
    t
        Time of the vehicle [s].
    tell
        Takes time, code and words for the log.
    restart
        Starts the software anew; None where nobody would.

    Raises
    ------
    FileError
        A folder cannot be used.
    """

    def __init__(
        self,
        configuration: Configuration,
        coordinator: Coordinator,
        missions: MissionStore,
        fly: Callable[[StoredMission], None],
        utc: Callable[[float], float],
        radio: Port,
        bench: Port | None,
        t: float,
        tell: Tell,
        restart: Callable[[], None] | None = None,
    ) -> None:
        file = configuration.file
        kept = storage_of(configuration, "parameters")
        self.guard = guard_of(configuration, kept, utc(t))
        port = MissionPort(lambda: missions, FlownMission(coordinator))
        files = VehicleFiles(inbox_of(configuration), port.texts, coordinator.recorder.logbook)

        def link(settings: LinkSettings, storage: Storage, *, on_bench: bool) -> VehicleLink:
            return VehicleLink(
                settings, coordinator, self.guard, utc, os.urandom, storage, port, fly, files, restart,
                bench=on_bench,
            )  # fmt: skip

        over = LinkSettings(file.vehicle_id, file.radio.baud, file.radio.half_duplex)
        self.radio = PortLink(RADIO, link(over, kept, on_bench=False), radio, over.bit_rate, tell)
        self.bench: PortLink | None = None
        if bench is not None:
            at = LinkSettings(file.vehicle_id, file.bench.baud, half_duplex=False)
            made = link(at, bench_storage(configuration), on_bench=True)
            self.bench = PortLink(BENCH, made, bench, at.bit_rate, tell)
        self._coordinator = coordinator

    @property
    def failures(self) -> int:
        """How often a link failed."""
        return self.radio.failures + (0 if self.bench is None else self.bench.failures)

    @property
    def radio_is_on(self) -> bool:
        """Whether the radio has power."""
        view = self._coordinator.view
        return view is not None and view.commands.radio

    def look(self, t: float) -> None:
        """Hear and speak at a time [s]."""
        self.radio.look(t, on=self.radio_is_on)
        if self.bench is not None:
            self.bench.look(t)

    def observe(self, t: float) -> None:
        """Look at what the coordinator has decided at a time [s]."""
        self.radio.observe(t, on=self.radio_is_on)
        if self.bench is not None:
            self.bench.observe(t)
