"""The vehicle's radio in the loop: its end of the link, as it starts with the coordinator."""

import numpy as np

from stommel.control.orders_file import orders_text
from stommel.files.storage import Storage
from stommel.link.channel.settings import ChannelSettings
from stommel.link.signing.guard import Guard
from stommel.onboard.coordination.coordinator import Coordinator
from stommel.onboard.coordination.stores.missions import MissionStore
from stommel.onboard.radio.files import VehicleFiles
from stommel.onboard.radio.flown_mission import FlownMission
from stommel.onboard.radio.mission_port import MissionPort
from stommel.onboard.radio.vehicle_link import LinkSettings, VehicleLink
from stommel.planning.vehicle_limits import vehicle_limits
from stommel.simulation.scenario.mission import Mission
from stommel.simulation.scenario.orders_header import orders_header
from stommel.simulation.setup import Setup
from stommel.sitl.radio.memory_folder import MemoryFolder

SYSTEM = 1
"""Number of the simulated vehicle on the air."""


class Station:
    """What the simulated vehicle's radio keeps while its coordinator comes and goes.

    Parameters
    ----------
    setup
        Of the mission.
    storage
        Of the coordinator: what outlives its restarts.
    channel
        Whose bit rate the radio's port has.
    guard
        Who may command.
    """

    def __init__(
        self, mission: Mission, setup: Setup, storage: Storage, channel: ChannelSettings, guard: Guard
    ) -> None:
        self._mission, self._setup, self._storage, self._guard = mission, setup, storage, guard
        self._settings = LinkSettings(SYSTEM, channel.bit_rate, channel.half_duplex)
        self._inbox = MemoryFolder()
        self._draw = np.random.default_rng((mission.scenario.seed, 7))
        self._store: MissionStore | None = None

    def link(self, coordinator: Coordinator, expires: float) -> VehicleLink:
        """Return the vehicle's end for a coordinator that has started; missions that come expire with the first."""
        start = self._setup.loop.start
        port = MissionPort(self._missions, FlownMission(coordinator))
        if self._store is not None:  # what was taken before the restart is flown on
            port.opened = self._store = self._opened()
        return VehicleLink(
            self._settings,
            coordinator,
            self._guard,
            lambda t: start + t,
            self._draw.bytes,
            self._storage,
            port,
            lambda found: coordinator.adopt(found.orders, expires, found.number, found.header.sample_every_s),
            VehicleFiles(self._inbox, port.texts, coordinator.recorder.logbook),
        )

    def _missions(self) -> MissionStore:
        """The missions that the vehicle holds; the one that it started with is number 1."""
        if self._store is None:
            self._store = self._opened()
            if self._store.active is None:
                self._store.take_whole(orders_text(self._setup.orders, orders_header(self._mission)).encode())
        return self._store

    def _opened(self) -> MissionStore:
        return MissionStore(self._storage, vehicle_limits(self._mission.vehicle))
