"""A vehicle with the real services of the link behind a port of this machine, and fakes behind those."""

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager

from stommel.link.commands.server import CommandServer
from stommel.link.exchange import exchange
from stommel.link.files.server import FileServer
from stommel.link.missions.orders_server import OrdersServer
from stommel.link.missions.waypoint_server import WaypointServer
from stommel.link.outbox import Outbox, Priority
from stommel.link.parameters.server import ParameterServer
from stommel.link.presence import SHORE_HEARTBEAT, Presence
from stommel.link.rate import LineRate
from stommel.link.service import Received
from stommel.link.session import Session
from stommel.link.time_sync import TimeSync
from stommel.link.transports.opening import open_transport
from stommel.messages.mavlink import Fields
from tests.link.commands.quay import FakePort
from tests.link.files.fakes import MemoryFiles
from tests.link.missions.vehicle import Vehicle as Missions
from tests.link.parameters.vehicle import Vehicle as Parameters
from tests.onboard.coordination.disk import Disk

SHORE = (255, 190)


class _Says:
    """Says what a test hands it."""

    def __init__(self) -> None:
        self.waiting: list[tuple[str, Fields]] = []

    def take(self, received: Received, t: float) -> None:
        """Hears nothing."""

    def poll(self, t: float, outbox: Outbox) -> None:
        while self.waiting and outbox.room(Priority.STATE) > 300:
            outbox.put(Priority.STATE, *self.waiting.pop(0))


class _ShoreClock:
    """The shore's clock as the vehicle knows it from TIMESYNC."""

    def __init__(self, sync: TimeSync) -> None:
        self._sync = sync

    def latest(self, t: float) -> float | None:
        found = self._sync.clocks.get(SHORE) if hasattr(self._sync, "clocks") else None
        return time.time() + 1.0 if found is None else time.time()


class Served(threading.Thread):
    """Lies at the surface; `under_water` it neither hears nor speaks."""

    def __init__(self, rate: float = 1e6) -> None:
        super().__init__(daemon=True)
        self._transport = open_transport("tcp-listen:127.0.0.1:0")
        self.address = self._transport.name.replace("tcp-listen", "tcp")
        self.port, self.missions, self.parameters = FakePort(), Missions(), Parameters()
        self.files = MemoryFiles()
        self.says = _Says()
        self.disk = Disk()
        self.under_water = False
        self._rate = rate
        self._ends = threading.Event()
        self.lock = threading.Lock()
        self.restart()

    def restart(self) -> None:
        """Begin anew, with what the disk has."""
        sync = TimeSync(lambda t: t)
        self.session = Session(
            1, 1,
            [
                Presence(lambda: SHORE_HEARTBEAT), sync, CommandServer(1, 1, self.port, _ShoreClock(sync), self.disk),
                ParameterServer(1, self.parameters), OrdersServer(1, 1, self.missions, self.missions),
                WaypointServer(1, 1, self.missions), FileServer(1, 1, self.files), self.says,
            ],
            rate=LineRate(self._rate, half_duplex=False),
        )  # fmt: skip

    def run(self) -> None:
        while not self._ends.is_set():
            with self.lock:
                if self.under_water:
                    self._transport.read(time.monotonic())
                else:
                    exchange(self.session, self._transport, time.monotonic())
            time.sleep(0.005)

    def say(self, name: str, **values: object) -> None:
        """Say a message."""
        self.says.waiting.append((name, values))  # type: ignore[arg-type]

    def end(self) -> None:
        """Go."""
        self._ends.set()
        self.join(5.0)
        self._transport.close()


@contextmanager
def served(rate: float = 1e6) -> Iterator[Served]:
    """A vehicle until the block ends."""
    found = Served(rate)
    found.start()
    try:
        yield found
    finally:
        found.end()
