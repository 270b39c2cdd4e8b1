"""The vehicle's end of the link: every service, bound to the coordinator."""

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

from stommel.files.storage import Storage
from stommel.link.commands.identity import Identity
from stommel.link.commands.server import CommandServer
from stommel.link.commands.standard import StandardCommands
from stommel.link.files.port import FilePort
from stommel.link.files.server import FileServer
from stommel.link.missions.orders_server import OrdersServer
from stommel.link.missions.waypoint_server import WaypointServer
from stommel.link.parameters.server import ParameterServer
from stommel.link.presence import Presence
from stommel.link.rate import LineRate
from stommel.link.service import VEHICLE_COMPONENT
from stommel.link.session import Session
from stommel.link.signing.challenge import Challenge
from stommel.link.signing.guard import Guard, PortGuard
from stommel.link.signing.key_change import KeyAnswer
from stommel.link.statistics import Statistics
from stommel.link.time_sync import TimeSync
from stommel.onboard.coordination.coordinator import Coordinator
from stommel.onboard.coordination.stores.missions import StoredMission
from stommel.onboard.radio.commands import VehicleCommands
from stommel.onboard.radio.dive_reports import DiveReports
from stommel.onboard.radio.mission_port import MissionPort
from stommel.onboard.radio.observed import Observed, observe
from stommel.onboard.radio.parameter_port import VehicleParameters
from stommel.onboard.radio.shore_clock import ShoreClock
from stommel.onboard.radio.telemetry import WARNING, Telemetry
from stommel.onboard.radio.telemetry_table import surface_time_left
from stommel.version import __version__


class LinkSettings(NamedTuple):
    """Who the vehicle is on the air, and its line."""

    system: int
    """Number of the vehicle, 1 to 250."""
    bit_rate: float
    """Of the line to the radio [bit/s]."""
    half_duplex: bool = True
    """Whether the radios take turns."""


class VehicleLink:
    """Bytes of the radio in, bytes out.

    Parameters
    ----------
    settings
        Who speaks.
    coordinator
        Who decides.
    guard
        Who may command.
    utc
        UTC by the vehicle's clock [s since 1970] at a time of the vehicle [s].
    random
        Returns so many random bytes, for keys.
    storage
        Keeps what commands have become of.
    missions
        Of the vehicle.
    fly
        Lets a mission be flown that was taken.
    files
        That the shore may see.
    restart
        Starts the software anew; None where nobody would.
    bench
        Whether this is the port at which whoever speaks is at the vehicle, and believed.
    """

    def __init__(
        self,
        settings: LinkSettings,
        coordinator: Coordinator,
        guard: Guard,
        utc: Callable[[float], float],
        random: Callable[[int], bytes],
        storage: Storage,
        missions: MissionPort,
        fly: Callable[[StoredMission], None],
        files: FilePort,
        restart: Callable[[], None] | None = None,
        *,
        bench: bool = False,
    ) -> None:
        self._coordinator, self.guard, self._utc = coordinator, guard, utc
        self.missions, self._fly = missions, fly
        self._bench = bench
        coordinator.key_alarm = guard.alarm
        self._seen: Observed | None = None
        me = settings.system, VEHICLE_COMPONENT
        rate = LineRate(settings.bit_rate, half_duplex=settings.half_duplex)
        self.session = Session(*me, (), PortGuard(guard, int(bench), bench), rate)
        self.presence, self.time_sync = Presence(), TimeSync(utc)
        self.parameters = VehicleParameters(coordinator)
        self.telemetry, self._reports = Telemetry(settings.bit_rate / 10.0), DiveReports()
        port = VehicleCommands(coordinator, missions, restart)
        self.commands = CommandServer(*me, port, ShoreClock(self.time_sync), storage)
        self.statistics = Statistics(
            self.session, self.time_sync, surface_time_left=self._surface_time_left, refusals=guard.refusals
        )
        self.key_answer = KeyAnswer(guard, random)
        warn = partial(self.telemetry.tell, WARNING)
        self.session.services = [
            Challenge(guard),
            self.key_answer,
            self.presence,
            self.time_sync,
            self.commands,
            StandardCommands(*me, port, self.telemetry, Identity(__version__), self.commands.abort_came, warn),
            ParameterServer(settings.system, self.parameters),
            OrdersServer(*me, missions, missions),
            WaypointServer(*me, missions, warn),
            self.telemetry,
            self._reports,
            self.statistics,
            FileServer(*me, files, self.statistics.traffic),
        ]

    def observe(self, t: float) -> None:
        """Look at what the coordinator has decided at a time [s], once for each decision; it learns how the key is."""
        self._coordinator.key_alarm = self.guard.alarm
        if self._seen is not None and self._coordinator.view is self._seen.view:
            return  # the coordinator sleeps: what it said then is not said again, nor dated anew
        seen = observe(self._coordinator, self._utc(t))
        if seen is not None:
            self._seen = seen
            self.telemetry.observe(seen)
            self._reports.observe(seen)
            self.parameters.observe()

    def take(self, data: bytes, t: float) -> None:
        """Take bytes that the radio has received until a time [s]; a mission that came is flown from here on."""
        if not self._bench:
            self._coordinator.instruments.radio.take(data, t)  # health tells when the shore was last heard
        self.session.take(data, t)
        store = self.missions.opened
        if store is not None and store.active is not None and store.active.number != self._coordinator.mission:
            self._fly(store.active)

    def poll(self, t: float, room: int) -> bytes:
        """Return at most so many bytes for the radio to send."""
        return self.session.poll(t, room)

    def rest(self, t: float) -> None:
        """Let time pass while the radio is off: commands expire, and those for the next surfacing see the dive."""
        self.commands.poll(t, self.session.outbox)

    @property
    def notes(self) -> list[str]:
        """What there is to say to whoever reads the log."""
        key = [] if self._bench else self.guard.status
        return [*key, *self.session.notes, *self.commands.notes, *self.key_answer.notes]

    def _surface_time_left(self) -> float:
        return float("nan") if self._seen is None else surface_time_left(self._seen)
