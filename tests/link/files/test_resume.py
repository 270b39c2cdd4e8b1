"""A transfer from every state goes on. Oracle: the model below, and the bytes aboard.

yamcs/yamcs#956, #1153: a paused transfer never asked for the missing part after it was resumed.
"""

from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, precondition, rule

from stommel.link.files.download import Download
from stommel.link.files.progress import State
from stommel.link.files.server import FileServer
from stommel.link.outbox import Outbox
from stommel.link.service import Received, Service
from stommel.messages.mavlink import message_named
from tests.link.files.fakes import MemoryDisk, MemoryFiles, noise
from tests.link.files.pair import SHORE, VEHICLE

DATA = noise(20_000, 21)
FRAMES = st.integers(1, 12)


class Resuming(RuleBasedStateMachine):
    """Both ends, and two wires of which whoever tests decides what comes out."""

    def __init__(self) -> None:
        super().__init__()
        self.files, self.disk = MemoryFiles({"logs/a.log": DATA}), MemoryDisk()
        self.t = 100.0
        self.to_vehicle: list[Received] = []
        self.to_shore: list[Received] = []
        self.vehicle_restarts()
        self.shore_restarts()

    @rule()
    def vehicle_restarts(self) -> None:
        self.server = FileServer(*VEHICLE, self.files)

    @rule()
    def shore_restarts(self) -> None:
        self.download = Download(SHORE, VEHICLE, "logs/a.log", self.disk, "a.log", patience=None)

    @rule(seconds=st.sampled_from([0.01, 0.2, 1.0, 5.0, 40.0, 2000.0]))
    def time_passes(self, seconds: float) -> None:
        self.t += seconds

    @rule(most=FRAMES)
    def vehicle_speaks(self, most: int) -> None:
        self.to_shore += self.say(self.server, VEHICLE, most)

    @rule(most=FRAMES)
    def shore_speaks(self, most: int) -> None:
        self.to_vehicle += self.say(self.download, SHORE, most)

    @rule(most=FRAMES)
    def vehicle_hears(self, most: int) -> None:
        for received in self.to_vehicle[:most]:
            self.server.take(received, self.t)
        del self.to_vehicle[:most]

    @rule(most=FRAMES)
    def shore_hears(self, most: int) -> None:
        for received in self.to_shore[:most]:
            self.download.take(received, self.t)
        del self.to_shore[:most]

    @rule(rounds=st.integers(1, 12), every=st.integers(2, 7))
    def they_talk_and_some_is_lost(self, rounds: int, every: int) -> None:
        for k in range(rounds):
            self.t += 0.3
            self.to_vehicle += self.say(self.download, SHORE, 3)
            for received in self.to_vehicle:
                self.server.take(received, self.t)
            self.to_shore += self.say(self.server, VEHICLE, 3)
            for j, received in enumerate(self.to_shore):
                if (j + k + 1) % every:
                    self.download.take(received, self.t)
            self.to_vehicle, self.to_shore = [], []

    @rule(most=FRAMES)
    def air_loses(self, most: int) -> None:
        del self.to_vehicle[:most]
        del self.to_shore[:most]

    @rule()
    def air_repeats_and_turns_round(self) -> None:
        self.to_shore = self.to_shore[::-1] + self.to_shore[:3]
        self.to_vehicle = self.to_vehicle[::-1] + self.to_vehicle[:3]

    @rule()
    def shore_pauses(self) -> None:
        self.download.pause()

    @rule()
    def shore_resumes(self) -> None:
        self.download.resume(self.t)

    @precondition(lambda self: not self.download.state.is_over)
    @rule()
    def a_resume_leads_to_a_request(self) -> None:
        self.download.resume(self.t)
        said = self.say(self.download, SHORE, 20)
        if self.download.state is State.WHOLE:
            return
        assert any(self.asks(received) for received in said)
        self.to_vehicle += said

    @precondition(lambda self: not self.download.state.is_over)
    @rule()
    def on_a_good_line_it_ends_whole(self) -> None:
        self.download.resume(self.t)
        for _ in range(400):
            for received in self.say(self.download, SHORE, 20):
                self.server.take(received, self.t)
            for received in self.say(self.server, VEHICLE, 20):
                self.download.take(received, self.t)
            self.t += 0.1
            if self.download.state.is_over:
                break
        assert self.download.state is State.WHOLE
        self.disk.remove("a.log")
        self.shore_restarts()

    @invariant()
    def what_counts_as_there_is_there(self) -> None:
        if self.download.file is not None and self.download.state is not State.WHOLE:
            for first, last in self.download.file.received:
                assert self.disk.files["a.log.part"][first:last] == DATA[first:last]
        if "a.log" in self.disk.files:
            assert self.disk.files["a.log"] == DATA

    @invariant()
    def a_paused_shore_is_silent(self) -> None:
        if self.download.is_paused:
            assert not any(self.asks(received) for received in self.say(self.download, SHORE, 5))

    @staticmethod
    def asks(received: Received) -> bool:
        return received.name == "FILE_OPEN" or (received.name == "FILE_REQUEST" and received.values["count"] != 0)

    def say(self, service: Service, who: tuple[int, int], most: int) -> list[Received]:
        outbox, said = Outbox(most=10_000), list[Received]()
        for _ in range(most):
            service.poll(self.t, outbox)
            outgoing = outbox.next()
            if outgoing is None:
                break
            said.append(Received(*who, outgoing.name, message_named(outgoing.name).unpack(outgoing.payload)))
        while (outgoing := outbox.next()) is not None:
            said.append(Received(*who, outgoing.name, message_named(outgoing.name).unpack(outgoing.payload)))
        return said


TestResuming = Resuming.TestCase
TestResuming.settings = settings(
    max_examples=60, stateful_step_count=30, deadline=None, suppress_health_check=list(HealthCheck)
)
