"""A vehicle and a shore station that command over half a link, and are both killed at random; and what truly happened.

The oracle is the vehicle's own list of what it has begun, and when by the clock ashore.
"""

import random
from dataclasses import dataclass, field

from stommel.link.commands.client import CommandClient
from stommel.link.commands.ledger import FOR_ABORTS
from stommel.link.commands.port import Answer, Readiness
from stommel.link.commands.server import CommandServer
from stommel.link.commands.states import Command, Progress, State, When
from stommel.link.commands.table import ABORT, CommandError
from stommel.link.outbox import Outbox
from stommel.link.service import Received
from stommel.messages.mavlink import message_named
from tests.onboard.coordination.disk import Disk, PowerCutError

SHORE, VEHICLE = (255, 190), (3, 1)
EPOCH = 1.8e9
"""The clock ashore when the run begins [s]."""
STEP = 1.0


@dataclass
class Begun:
    command: Command
    at: float
    """By the clock ashore [s]."""
    ends: float
    ends_as: State
    has_ended: bool = False


class Truth:
    """What the vehicle has done, through all its restarts, and how it answers."""

    def __init__(self, draw: random.Random) -> None:
        self.draw = draw
        self.t = 0.0
        self.begun: list[Begun] = []
        self.submerged = False
        self.kills_at_begin = 0
        self.ready_from: dict[int, float] = {}

    @property
    def shore_clock(self) -> float:
        return EPOCH + self.t


class Port:
    """The vehicle since its last start."""

    def __init__(self, truth: Truth) -> None:
        self._truth = truth
        self._known: dict[int, Begun] = {}

    @property
    def is_submerged(self) -> bool:
        return self._truth.submerged

    def check(self, command: Command) -> Answer:
        truth = self._truth
        if command.number == ABORT:
            return Answer(Readiness.READY)
        if command.id not in truth.ready_from:
            truth.ready_from[command.id] = truth.t + truth.draw.choice([0.0, 0.0, 0.0, 30.0])
        if command.id % 17 == 0:
            return Answer(Readiness.NEVER, "it never can")
        return Answer(Readiness.READY if truth.t >= truth.ready_from[command.id] else Readiness.NOT_YET, "not now")

    def begin(self, command: Command) -> Progress:
        truth = self._truth
        kills = truth.kills_at_begin > 0 and truth.draw.random() < 0.5
        truth.kills_at_begin -= kills
        if kills and truth.draw.random() < 0.5:
            raise PowerCutError
        lasts = truth.draw.choice([0.0, 0.0, truth.draw.uniform(0.0, 30.0)])
        ends_as = State.FAILED if command.id % 7 == 0 else State.DONE
        begun = Begun(command, truth.shore_clock, truth.t + lasts, ends_as)
        truth.begun.append(begun)
        if kills:
            raise PowerCutError
        self._known[command.id] = begun
        return self._progress(begun)

    def progress(self, id: int) -> Progress | None:
        begun = self._known.get(id)
        return None if begun is None else self._progress(begun)

    def _progress(self, begun: Begun) -> Progress:
        if self._truth.t < begun.ends:
            return Progress(State.IN_PROGRESS, 50)
        begun.has_ended = True
        return Progress(begun.ends_as)


class Clock:
    """The vehicle's comparison with the clock ashore: none at first, then late by a changing amount, never early."""

    def __init__(self, truth: Truth) -> None:
        self._truth = truth
        self._known_from = truth.t + truth.draw.uniform(0.0, 20.0)
        self._slack = truth.draw.choice([0.0, 0.01, 5.0])

    def latest(self, t: float) -> float | None:
        if self._truth.t < self._known_from:
            return None
        if self._truth.draw.random() < 0.01:
            self._slack = self._truth.draw.choice([0.0, 0.01, 5.0])
        return self._truth.shore_clock + self._slack


@dataclass
class Way:
    """One direction: half is lost, much comes twice, late, and in another order."""

    draw: random.Random
    source: tuple[int, int]
    loss: float = 0.5
    flying: list[tuple[float, str, bytes]] = field(default_factory=list)
    said: list[tuple[str, bytes]] = field(default_factory=list)

    def send(self, outbox: Outbox, t: float) -> None:
        while (outgoing := outbox.next()) is not None:
            self.said.append((outgoing.name, outgoing.payload))
            for _ in range(self.draw.choice([1, 1, 1, 2, 3])):
                if self.draw.random() >= self.loss:
                    delay = self.draw.choice([0.1, 0.4, 2.0, self.draw.uniform(0.0, 60.0)])
                    self.flying.append((t + delay, outgoing.name, outgoing.payload))

    def arrived(self, t: float) -> list[Received]:
        here = [message for message in self.flying if message[0] <= t]
        self.flying = [message for message in self.flying if message[0] > t]
        self.draw.shuffle(here)
        return [self.received(name, payload) for _, name, payload in here]

    def received(self, name: str, payload: bytes) -> Received:
        return Received(*self.source, name, message_named(name).unpack(payload))


class Voyage:
    """One run. `claims` are the last words that the shore station has ever told, by id."""

    def __init__(self, seed: int) -> None:
        self.draw = random.Random(seed)
        self.truth = Truth(self.draw)
        self.up, self.down = Way(self.draw, SHORE), Way(self.draw, VEHICLE)
        self.vehicle_disk, self.shore_disk = Disk(), Disk()
        self.most = self.draw.choice([None, None, FOR_ABORTS + 2])
        self.kill_rate = self.draw.choice([0.0, 0.002, 0.02])
        """How often a power cut is on its way, at a step of either end."""
        self.given: dict[int, Command] = {}
        self.claims: dict[int, State] = {}
        self.contradictions: list[str] = []
        self.kills = 0
        self.is_calm = False
        self.server: CommandServer | None = None
        self.client: CommandClient | None = None
        self._outbox = Outbox()
        self._server_rests = self._client_rests = 0.0

    # both ends

    def _start_server(self) -> None:
        self.server = CommandServer(*VEHICLE, Port(self.truth), Clock(self.truth), self.vehicle_disk, most=self.most)
        self._server_began = self.truth.t

    def _start_client(self) -> None:
        self.client = CommandClient(
            *SHORE, VEHICLE[0], self.shore_disk, random.Random(self.draw.getrandbits(64)), self.truth.shore_clock
        )

    def _vehicle_step(self) -> None:
        t = self.truth.t
        arrived = self.up.arrived(t)
        if self.server is None:
            if t < self._server_rests:
                return
            self._start_server()
        assert self.server is not None
        own = t - self._server_began
        for received in [] if self.truth.submerged else arrived:
            self.server.take(received, own)
        self.server.poll(own, self._outbox)
        if self.truth.submerged:
            self._outbox = Outbox()
        self.down.send(self._outbox, t)

    def _shore_step(self) -> None:
        t = self.truth.shore_clock
        arrived = self.down.arrived(self.truth.t)
        if self.client is None:
            if self.truth.t < self._client_rests:
                return
            self._start_client()
        assert self.client is not None
        for received in arrived:
            self.client.take(received, t)
        self._operate(self.client, t)
        self.client.poll(t, self._outbox)
        if self.truth.submerged:
            self._outbox = Outbox()
        self.up.send(self._outbox, self.truth.t)
        self._listen(self.client)

    def _operate(self, client: CommandClient, t: float) -> None:
        """What the operator does."""
        if self.is_calm:
            return
        draw = self.draw
        with_luck = draw.random()
        try:
            if with_luck < 0.04 and len(self.given) < 8:
                client.give(
                    *draw.choice([("start", {}), ("hold", {}), ("hold", {}), ("radio-time", {"time": 600.0})]), t,
                    valid_for=draw.choice([5.0, 60.0, 200.0, 1000.0]), when=draw.choice(list(When)),
                )  # fmt: skip
            elif with_luck < 0.048 and len(self.given) < 8:
                client.abort(t, valid_for=draw.choice([30.0, 300.0]))
            elif with_luck > 0.99 and (ids := [report.id for report in client.reports(t)]):
                client.cancel(draw.choice(ids), t)
        except CommandError:
            return  # too many are open

    def _listen(self, client: CommandClient) -> None:
        # also those that power failed before `give` could return
        self.given |= {id: entry.command for id, entry in client._queue.waiting.items()}
        for id, entry in client._queue.waiting.items():
            if entry.last is not None:
                known = self.claims.setdefault(id, entry.last.state)
                if known is not entry.last.state:
                    self.contradictions.append(f"{id:x}: {known.name}, then {entry.last.state.name}")

    # the run

    def _guarded(self, end: str) -> None:
        disk = self.vehicle_disk if end == "server" else self.shore_disk
        if not self.is_calm and disk.operations_left is None and self.draw.random() < self.kill_rate:
            disk.operations_left = self.draw.randint(1, 12)
        try:
            if end == "server":
                self._vehicle_step()
            else:
                self._shore_step()
            killed = not self.is_calm and self.draw.random() < self.kill_rate / 4
        except PowerCutError:
            killed = True
        if killed:
            self._outbox = Outbox()
            self.kills += 1
            found = disk.after_power_cut(self.draw, keeps_unsynced=False)
            rests = self.truth.t + self.draw.uniform(0.0, 15.0)
            if end == "server":
                self.server, self.vehicle_disk, self._server_rests = None, found, rests
            else:
                self.client, self.shore_disk, self._client_rests = None, found, rests

    def _step(self) -> None:
        self.truth.t += STEP
        self._guarded("server")
        self._guarded("client")

    def run(self, rough: float = 300.0, calm: float = 3000.0) -> None:
        """A rough time, then a calm one in which only messages are lost, until each command has its last word."""
        truth, draw = self.truth, self.draw
        truth.kills_at_begin = draw.choice([0, 0, 1])
        while truth.t < rough:
            if draw.random() < 0.02:
                truth.submerged = not truth.submerged
            self._step()
        self.is_calm, truth.submerged, truth.kills_at_begin = True, False, 0
        self.vehicle_disk.operations_left = self.shore_disk.operations_left = None
        while truth.t < rough + calm and not self.is_over:
            self._step()
        self._replay()

    @property
    def is_over(self) -> bool:
        """Whether the shore station knows all."""
        client = self.client
        return client is not None and all(entry.last is not None for entry in client._queue.waiting.values())

    def _replay(self) -> None:
        """All that was ever sent comes once more."""
        if self.server is None:
            self._start_server()
        assert self.server is not None
        for name, payload in self.up.said:
            self.server.take(self.up.received(name, payload), self.truth.t - self._server_began)
            self.server.poll(self.truth.t - self._server_began, Outbox())

    def problems(self) -> list[str]:
        """All that must not be."""
        found = list(self.contradictions)
        begun: dict[int, list[Begun]] = {}
        for one in self.truth.begun:
            begun.setdefault(one.command.id, []).append(one)
            if one.at * 1000.0 >= one.command.expires:
                found.append(f"{one.command.id:x}: begun after its expiry")
        for id, command in self.given.items():
            times, claim = begun.pop(id, []), self.claims.get(id)
            if len(times) > 1:
                found.append(f"{id:x}: executed {len(times)} times")
            if claim is None and self.client is not None and id in self.client._queue.waiting:
                found.append(f"{id:x}: has no last word")
            if claim in (State.DONE, State.FAILED):
                right = len(times) == 1 and times[0].has_ended and times[0].ends_as is claim
                if not right:
                    found.append(f"{id:x}: {claim.name} is false")
            if claim is not None and claim.is_not_executed and times:
                found.append(f"{id:x}: {claim.name}, but was executed")
            if command.number == ABORT and times:
                found += self._overtaken(command, times[0].at)
        return found + [f"{id:x}: was never given" for id in begun]

    def _overtaken(self, abort: Command, at: float) -> list[str]:
        late = [one for one in self.truth.begun if one.command.given < abort.given and one.at > at]
        return [
            f"{one.command.id:x}: given before an abort, begun after it" for one in late if one.command.number != ABORT
        ]
