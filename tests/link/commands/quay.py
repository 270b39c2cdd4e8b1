"""A vehicle and a shore station side by side: what is said arrives at once, or not, as a test says."""

import random
from collections.abc import Callable

from stommel.link.commands.client import CommandClient
from stommel.link.commands.port import Answer, Readiness
from stommel.link.commands.server import CommandServer
from stommel.link.commands.states import Command, Progress, State
from stommel.link.outbox import Outbox
from stommel.link.service import Received
from stommel.messages.mavlink import Fields, message_named
from tests.onboard.coordination.disk import Disk

SHORE, VEHICLE = (255, 190), (3, 1)
EPOCH = 1.8e9
"""The clock ashore at 0 s of the vehicle [s]."""


class FakePort:
    """Executes in no time, but for what it is told."""

    def __init__(self) -> None:
        self.is_submerged = False
        self.answer = Answer(Readiness.READY)
        self.outcome = Progress(State.DONE)
        self.begun: list[Command] = []
        self.running: dict[int, Progress] = {}

    def check(self, command: Command) -> Answer:
        return self.answer

    def begin(self, command: Command) -> Progress:
        self.begun.append(command)
        if not self.outcome.state.is_last:
            self.running[command.id] = self.outcome
        return self.outcome

    def progress(self, id: int) -> Progress | None:
        return self.running.get(id)

    @property
    def numbers(self) -> list[int]:
        return [command.number for command in self.begun]


class FakeClock:
    """The comparison of clocks, exact where a test says nothing else."""

    def __init__(self) -> None:
        self.offset: float | None = EPOCH

    def latest(self, t: float) -> float | None:
        return None if self.offset is None else t + self.offset


class Quay:
    """Both ends; `up` and `down` say whether a message comes through."""

    def __init__(self, *, seed: int = 1, most: int | None = None) -> None:
        self.t = 100.0
        self.port, self.clock = FakePort(), FakeClock()
        self.vehicle_disk, self.shore_disk = Disk(), Disk()
        self.seed, self.most = seed, most
        self.up: Callable[[str], bool] = lambda name: True
        self.down: Callable[[str], bool] = lambda name: True
        self.heard: list[Received] = []
        """What the vehicle has heard."""
        self.said: list[Received] = []
        """What the vehicle has said."""
        self.start_vehicle()
        self.start_shore()

    def start_vehicle(self) -> None:
        self.server = CommandServer(*VEHICLE, self.port, self.clock, self.vehicle_disk, most=self.most)

    def start_shore(self) -> None:
        self.seed += 1
        # the time of the program begins anew with it, the clock does not
        began = self.t
        self.began_shore = began
        self.client = CommandClient(
            *SHORE, VEHICLE[0], self.shore_disk, random.Random(self.seed), 0.0, clock=lambda t: t + began + EPOCH
        )

    @property
    def shore_t(self) -> float:
        """Time of the program ashore."""
        return self.t - self.began_shore

    @property
    def shore_clock(self) -> float:
        """The clock ashore."""
        return self.t + EPOCH

    def give(self, name: str, valid_for: float = 600.0, **options: object) -> int:
        return self.client.give(name, {}, self.shore_t, valid_for=valid_for, **options)  # type: ignore[arg-type]

    def state(self, id: int) -> State:
        return self.client.report(id, self.shore_t).state

    def words(self, id: int) -> str:
        return self.client.report(id, self.shore_t).words

    def run(self, seconds: float, step: float = 0.25) -> None:
        """Let time pass."""
        end = self.t + seconds
        while self.t < end:
            self.t += step
            self.exchange()

    def exchange(self) -> None:
        """What both have to say now."""
        outbox = Outbox()
        self.client.poll(self.shore_t, outbox)
        for received in sayings(outbox, SHORE):
            if self.up(received.name):
                self.tell_vehicle(received)
        self.server.poll(self.t, outbox)
        for received in sayings(outbox, VEHICLE):
            self.said.append(received)
            if self.down(received.name):
                self.client.take(received, self.shore_t)

    def tell_vehicle(self, received: Received) -> None:
        self.heard.append(received)
        self.server.take(received, self.t)

    def status(self, id: int, state: State, *, system: int = VEHICLE[0], **other: int) -> Received:
        """A saying about a command, as from the vehicle or from a stranger."""
        values: Fields = {
            "id": id,
            "state": int(state),
            "target_system": SHORE[0],
            "target_component": SHORE[1],
            **other,
        }
        kind = message_named("GLIDER_COMMAND_STATUS")
        return Received(system, 1, kind.name, kind.unpack(kind.pack(values)))


def sayings(outbox: Outbox, source: tuple[int, int]) -> list[Received]:
    """What waits in an outbox, as the other end receives it."""
    found = []
    while (outgoing := outbox.next()) is not None:
        kind = message_named(outgoing.name)
        found.append(Received(*source, kind.name, kind.unpack(outgoing.payload)))
    return found
