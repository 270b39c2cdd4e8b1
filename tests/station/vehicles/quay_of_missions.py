"""A station's missions without threads, killed at any point, at a line that loses, before a vehicle that dives.

The link is the real one on virtual time, both ends; what the archive has and what the vehicle holds outlives a kill.
"""

import hashlib
import random
from collections.abc import Callable, Mapping
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

from stommel.archive import ArchiveError
from stommel.link.missions.orders_client import OrdersClient
from stommel.station.vehicles.mission_follower import MissionFollower
from stommel.station.vehicles.mission_rows import OPEN, MissionRow, MissionRows, MissionState
from stommel.station.vehicles.mission_task import Task
from stommel.station.vehicles.missions_left import taken_up
from tests.link.line import End, losing
from tests.link.missions.vehicle import Vehicle, orders_joined
from tests.support.orders import ORDERS

T = 1_700_000_000.0
QUIET = 15.0
ELSEWHERE = b"from elsewhere"
ON_THE_LINE = 2.0
"""How long a message that left in time may be on its way [s]."""


class KillError(BaseException):
    """The station is killed."""


class Rows(MissionRows):
    """The table of missions; the station may be killed before and after each transaction, which may fail."""

    def __init__(self, sea: "Sea") -> None:
        self._sea = sea

    def _commit(self, change: Callable[[], Any]) -> Any:
        self._sea.point()
        if self._sea.happens(self._sea.faults):
            raise ArchiveError("the server does not answer")
        found = change()
        self._sea.point()
        if self._sea.happens(self._sea.faults):
            raise ArchiveError("the answer was lost on the way")
        return found

    def add(
        self,
        row: MissionRow,
        words: str,
        preview: Mapping[str, Any] | None = None,
        ended: Mapping[int, MissionState] | None = None,
    ) -> MissionRow:
        """Keep a row, and what it ends."""

        def keep() -> MissionRow:
            kept = row._replace(id=len(self._sea.rows) + 1)
            self._sea.rows[kept.id] = kept
            self._sea.history[kept.id] = [MissionState(row.t, row.user, row.state, words)]
            self._keep_states(ended or {})
            return kept

        return self._commit(keep)  # type: ignore[no-any-return]

    def change_all(self, states: Mapping[int, MissionState]) -> None:
        """Keep states."""
        self._commit(lambda: self._keep_states(states))

    def _keep_states(self, states: Mapping[int, MissionState]) -> None:
        for id, new in states.items():
            if self._sea.rows[id].state != new.state:
                self._sea.rows[id] = self._sea.rows[id]._replace(state=new.state)
                self._sea.history[id].append(new)

    def of_hash(self, vehicle: int, sha256: str) -> MissionRow | None:
        """Look the last of these orders up."""
        return next((row for row in list(self._sea.rows.values())[::-1] if row.sha256 == sha256), None)

    def in_states(self, vehicle: int, *states: str) -> list[MissionRow]:
        """Look rows up."""
        return [row for row in list(self._sea.rows.values())[::-1] if row.state in states]


class Sea:
    """A station, its archive, a line and a vehicle; each mission has orders of its own."""

    def __init__(self, draw: random.Random, folder: Path, *, kills: float, faults: float) -> None:
        self.draw, self.kills, self.faults, self._folder = draw, kills, faults, folder
        self.rows: dict[int, MissionRow] = {}
        self.history: dict[int, list[MissionState]] = {}
        self.vehicle = Vehicle()
        self.switched_at: dict[bytes, float] = {}
        """When the vehicle switched to which orders last."""
        self._elsewhere_at = float("-inf")
        switch = self.vehicle.switch

        def switched() -> None:
            switch()
            self.switched_at[self.vehicle.files[-1]] = self.t

        self.vehicle.switch = switched  # type: ignore[method-assign]
        _, self.link = orders_joined(self.vehicle)
        self.link.loses, self.link.rate = losing(draw, 0.1), 4_000.0
        self.taken: set[int] = set()
        """Given, and told so to whoever gave it."""
        self.boot()

    @property
    def t(self) -> float:
        """Now."""
        return T + self.link.t

    def happens(self, share: float) -> bool:
        """Whether something happens here."""
        return self.draw.random() < share

    def point(self) -> None:
        """The station may be killed here."""
        if self.happens(self.kills):
            raise KillError

    def boot(self) -> None:
        """The station starts, of what the archive has."""
        self.rows_kept = Rows(self)
        client = OrdersClient(1, self.draw)
        self.link.shore = End(255, 190, [_Heard(self, client)])
        self._heard_at = float("-inf")
        is_heard = lambda _: self.link.t - self._heard_at < QUIET  # noqa: E731
        end = SimpleNamespace(orders=client, is_heard=is_heard, heard=SimpleNamespace(last={}))
        clock = SimpleNamespace(now=lambda: self.t, of_link=lambda t: t)
        self.line: Any = SimpleNamespace(vehicle=1, end=end, clock=clock)
        left = taken_up(self.rows_kept.in_states(1, *OPEN), self.t)
        self.follower = MissionFollower(self.rows_kept, self._folder, lambda *_: None, left)
        self.follower._fetch.want = self._fetched  # type: ignore[method-assign]

    def _fetched(self, _end: Any, sha256: bytes) -> None:
        """Orders from elsewhere come home at once; how they come is tested elsewhere."""
        content = next(each for each in self.vehicle.files if hashlib.sha256(each).digest() == sha256)
        self.follower._keep_fetched(self.line, content, sha256)

    def heard(self) -> None:
        """The station hears the vehicle, and the number of its mission."""
        self._heard_at = self.link.t
        is_late = self.link.t - self._elsewhere_at < ON_THE_LINE  # never before an answer of the time before
        told = {"mission": len(self.vehicle.files) - is_late, "phase": -1}
        self.line.end.heard.last = {"GLIDER_STATE": SimpleNamespace(values=told)}

    # what happens

    def step(self) -> None:
        """Something happens; the station may be killed in the middle of it, or by itself."""
        doings: list[Callable[[], object]] = [
            self._give, self._take_back, self._dive, self._pass_time, self._pass_time, self._pass_time, self._kill,
            self._from_elsewhere,
        ]  # fmt: skip
        try:
            self.draw.choice(doings)()
        except KillError:
            self.boot()
        except ArchiveError:
            pass

    def _give(self) -> None:
        number = len(self.rows) + 1
        orders = ORDERS.replace("There and back", f"Mission {number}")
        sha256 = hashlib.sha256(orders.encode()).hexdigest()
        row = MissionRow(0, 1, self.t, "ada", f"Mission {number}", sha256, orders, None, "waiting")
        task = self.follower.put(self.line, Task("upload", "ada", row, self.draw.choice([60.0, 3600.0])), self.t)
        assert task.row is not None
        self.taken.add(task.row.id)

    def _take_back(self) -> None:
        self.follower.take_back(self.line, lambda task: task.row is not None, "ada")

    def _dive(self) -> None:
        self.link.is_silent = not self.link.is_silent

    def _kill(self) -> None:
        self.link.shore = End(255, 190, [])
        self.link.wait(1.0)  # what has left arrives
        self.link.t += self.draw.choice([0.0, 1.0, 300.0])  # until somebody starts it again
        self.boot()

    def _from_elsewhere(self) -> None:
        """The vehicle is given a mission that this station does not know; seldom, and never two in turn."""
        if self.happens(0.3) and not self.vehicle.files[-1].startswith(ELSEWHERE):
            self.vehicle.files.append(ELSEWHERE + b" %d" % len(self.vehicle.files))
            self._elsewhere_at = self.link.t

    def _pass_time(self) -> None:
        self.run(self.draw.choice([0.5, 2.0, 5.0]))

    def run(self, seconds: float) -> None:
        """The line's thread, and the link, go on."""
        for _ in np.arange(0.0, seconds, 0.2):
            for _ in range(10):
                self.link.step()
            self.follower._due = 0.0
            try:
                self.follower.look(self.line, self.t)
            except ArchiveError:
                continue

    def calm_down(self) -> None:
        """Nothing fails any more, the vehicle lies at the surface, and time passes until all is over."""
        self.kills = self.faults = 0.0
        self.link.loses, self.link.is_silent = (lambda _: False), False
        self.run(2.0 * ON_THE_LINE)
        for _ in range(400):
            self.run(1.0)
            is_asked = self.follower.held is not None and not self.follower.waiting
            if is_asked and not any(row.state in OPEN for row in self.rows.values()):
                return


class _Heard:
    """Tells the sea what the shore hears, and hands it on."""

    def __init__(self, sea: Sea, client: OrdersClient) -> None:
        self._sea, self._client = sea, client

    def take(self, received: Any, t: float) -> None:
        """Hear."""
        self._sea.heard()
        self._client.take(received, T + t)

    def poll(self, t: float, outbox: Any) -> None:
        """Speak."""
        self._client.poll(T + t, outbox)
