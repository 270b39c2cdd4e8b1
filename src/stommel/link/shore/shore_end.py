"""One vehicle, seen from the shore: session and services, and files as they are asked for."""

import random
from collections.abc import Callable
from typing import NamedTuple, TypeVar

from stommel.files.storage import Storage
from stommel.link.commands.client import CommandClient
from stommel.link.files.disk import Disk
from stommel.link.files.download import Download
from stommel.link.files.listing import Listing
from stommel.link.files.received_file import Identity
from stommel.link.files.release import Release
from stommel.link.files.upload import Upload
from stommel.link.missions.orders_client import OrdersClient
from stommel.link.missions.waypoint_client import WaypointClient
from stommel.link.parameters.client import ParameterClient
from stommel.link.parameters.known import KnownParameters
from stommel.link.presence import SHORE_HEARTBEAT, Presence
from stommel.link.rate import LineRate
from stommel.link.service import SHORE_COMPONENT, SHORE_SYSTEM, VEHICLE_COMPONENT, Service
from stommel.link.session import Session
from stommel.link.shore.heard import Heard
from stommel.link.signing.challenge import Challenge
from stommel.link.signing.guard import Guard, PortGuard
from stommel.link.signing.key_change import KeyOffer
from stommel.link.statistics import LinkStatistics, Statistics
from stommel.link.time_sync import TimeSync

S = TypeVar("S", Download, Upload, Listing, Release)

OURS = (SHORE_SYSTEM, SHORE_COMPONENT)


class ShoreSettings(NamedTuple):
    """Whom the shore speaks to, and over what line."""

    vehicle: int
    """MAVLink system of the vehicle, 1 to 250."""
    bit_rate: float
    """Of the line [bit/s]."""
    half_duplex: bool = True
    """Whether the radios take turns."""


class ShoreEnd:
    """Bytes of the radio in, bytes out. Its time is UTC [s since 1970] that goes on evenly; commands expire by it.

    Parameters
    ----------
    settings
        Whom it speaks to.
    guard
        Signs, and knows who is the vehicle.
    draw
        Of ids and numbers; from the operating system, so that no two programs draw the same.
    random_bytes
        Returns so many random bytes, for keys.
    storage
        Keeps what must outlive the program: commands, parameters.
    t
        Now [s].
    """

    def __init__(
        self,
        settings: ShoreSettings,
        guard: Guard,
        draw: random.Random,
        random_bytes: Callable[[int], bytes],
        storage: Storage,
        t: float,
    ) -> None:
        vehicle = settings.vehicle
        self.vehicle = (vehicle, VEHICLE_COMPONENT)
        self.guard = guard
        rate = LineRate(settings.bit_rate, half_duplex=settings.half_duplex)
        self.session = Session(*OURS, (), PortGuard(guard), rate)
        self.presence = Presence(lambda: SHORE_HEARTBEAT)
        self.time_sync = TimeSync()
        self.statistics = Statistics(self.session, self.time_sync, refusals=guard.refusals)
        self.heard = Heard(vehicle)
        self.commands = CommandClient(*OURS, vehicle, storage, draw, t)
        self.parameters = ParameterClient(vehicle, KnownParameters(vehicle, storage), draw)
        self.orders, self.waypoints = OrdersClient(vehicle, draw), WaypointClient(vehicle)
        self.keys = KeyOffer(guard, vehicle, random_bytes)
        self.challenge = Challenge(guard)
        self._lasting: list[Service] = [
            self.challenge, self.keys, self.presence, self.time_sync, self.heard, self.commands,
            self.parameters, self.orders, self.waypoints, self.statistics,
        ]  # fmt: skip
        self._passing: list[Service] = []
        self._resting: list[Download | Upload] = []
        """Transfers that were paused here."""
        self._arrange()

    def take(self, data: bytes, t: float) -> None:
        """Take bytes that came until a time [s]."""
        self.session.take(data, t)

    def poll(self, t: float, room: int) -> bytes:
        """Return at most so many bytes to send; transfers rest while the vehicle is not heard, and go on when it is.

        What somebody else has paused rests until that one resumes it.
        """
        if self.is_heard(t):
            for transfer in self._resting:
                transfer.resume(t)
            self._resting = []
        else:
            transfers = [each for each in self._passing if isinstance(each, Download | Upload)]
            going = [each for each in transfers if not each.is_paused and not each.state.is_over]
            for transfer in going:
                transfer.pause()
            self._resting += going
        return self.session.poll(t, room)

    def is_heard(self, t: float) -> bool:
        """Whether the vehicle is there at a time [s]."""
        return self.presence.is_heard(t, *self.vehicle)

    def link(self, t: float) -> LinkStatistics:
        """How the link to the vehicle is at a time [s]."""
        return self.statistics.of(self.vehicle, t)

    # files, each a service for as long as it takes

    def download(self, path: str, disk: Disk, name: str, patience: float | None = None) -> Download:
        """Begin to fetch a file, or go on where it was left."""
        traffic = self.statistics.traffic
        return self._add(Download(OURS, self.vehicle, path, disk, name, patience=patience, traffic=traffic))

    def upload(self, content: bytes, path: str, patience: float | None = None) -> Upload:
        """Begin to send a file, or go on where it was left."""
        traffic = self.statistics.traffic
        return self._add(Upload(OURS, self.vehicle, content, path, patience=patience, traffic=traffic))

    def listing(self, folder: str, patience: float | None = None) -> Listing:
        """Begin to list a folder."""
        return self._add(Listing(OURS, self.vehicle, folder, patience=patience))

    def release(self, identity: Identity, patience: float | None = None) -> Release:
        """Tell the vehicle that a file is whole here, and may go there."""
        return self._add(Release(OURS, self.vehicle, identity, patience=patience))

    def drop(self, service: Download | Upload | Listing | Release) -> None:
        """End a service of a file, whatever its state."""
        self._passing = [each for each in self._passing if each is not service]
        self._resting = [each for each in self._resting if each is not service]
        self._arrange()

    def _add(self, service: S) -> S:
        self._passing.append(service)
        self._arrange()
        return service

    def _arrange(self) -> None:
        self.session.services = [*self._lasting, *self._passing]
