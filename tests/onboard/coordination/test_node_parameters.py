"""The mirror of the nodes' parameters. Oracle: the settings that the nodes were made with, and the table of results."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

import pytest

from stommel.messages.codec import Decoder, Encoder, Received
from stommel.messages.database import ACQUISITION, MOTION
from stommel.messages.frames import Frame
from stommel.messages.nodes import HeartbeatSender, NodeState, NodeWatch
from stommel.messages.parameters import MemoryStore, ParameterServer, ParameterType, Value
from stommel.onboard.coordination.node_mirror import (
    ASK_AGAIN,
    MOST_WAITING,
    NodeParameter,
    ParameterOutcome,
    ParameterState,
    UnknownParameterError,
)
from stommel.onboard.coordination.node_parameters import NodeParameters, Wanted
from stommel.onboard.nodes.acquisition_settings import AcquisitionSettings
from stommel.onboard.nodes.motion_settings import MotionSettings
from stommel.onboard.nodes.node_settings import NodeSettings, parameters_of
from stommel.onboard.nodes.parameter_tables import PARAMETERS

SETTINGS: dict[int, NodeSettings] = {
    MOTION: MotionSettings(pump_flow=4e-6, blow_after=90.0), ACQUISITION: AcquisitionSettings(voltage_low=21.0),
}  # fmt: skip
NAMES = {MOTION: "Motion", ACQUISITION: "Acquisition"}
QUIET_AFTER, RETRIES, RADIO = 15, 14, 11


@dataclass
class Node:
    """A node as far as its parameters go."""

    number: int
    store: MemoryStore = field(default_factory=MemoryStore)
    restarts: int = 0
    dumb: bool = False
    """Whether it does not answer, though it lives."""
    dead: bool = False

    def __post_init__(self) -> None:
        self.start()

    def start(self) -> None:
        self.encoder, self.decoder = Encoder(), Decoder()
        self.server = ParameterServer(parameters_of(SETTINGS[self.number]), self.store)
        self.heartbeat = HeartbeatSender(self.number, self.encoder, self.restarts)

    def restart(self) -> None:
        self.restarts += 1
        self.start()

    def step(self, frames: Iterable[Frame], t: float) -> list[Frame]:
        said: list[Frame] = []
        for frame in frames:
            heard = self.decoder.take(frame)
            if isinstance(heard, Received) and heard.name == f"{NAMES[self.number]}ParameterRequest" and not self.dumb:
                said += self.server.take(heard, self.encoder)
        return [] if self.dead else said + self.heartbeat.poll(t, NodeState.Operational)


class Bench:
    """A coordinator's mirror and both nodes, second by second; answers take a second."""

    def __init__(self, wanted: Wanted | None = None) -> None:
        self.nodes = {number: Node(number) for number in SETTINGS}
        self.mirror = NodeParameters(Encoder(), wanted)
        self.watch, self.decoder = NodeWatch((MOTION, ACQUISITION), 0.0), Decoder()
        self.outcomes: list[ParameterOutcome] = []
        self.requests: list[tuple[float, str, int]] = []
        self.t = 0.0
        self._said: list[Frame] = []

    def run(self, seconds: int) -> "Bench":
        for _ in range(seconds):
            heard = [frame for node in self.nodes.values() for frame in node.step(self._said, self.t)]
            for frame in heard:
                answer = self.decoder.take(frame)
                self.watch.take(answer, self.t)
                if isinstance(answer, Received):
                    self.mirror.take(answer, self.t)
            self._said = self.mirror.step(self.watch, self.t)
            for frame in self._said:
                said = Decoder().take(frame)
                assert isinstance(said, Received)
                self.requests.append((self.t, said.name, int(said.values["parameter"])))
            self.outcomes += self.mirror.outcomes()
            self.t += 1.0
        return self

    def states(self, node: int) -> set[ParameterState]:
        return {p.state for p in self.mirror.of(node)}

    def one(self, node: int, number: int) -> NodeParameter:
        (found,) = [p for p in self.mirror.of(node) if p.number == number]
        return found

    def results(self) -> list[str]:
        results, self.outcomes = [outcome.result for outcome in self.outcomes], []
        return results


KNOWN, ASKED, SILENT, ABSENT = (
    {state} for state in (ParameterState.KNOWN, ParameterState.ASKED, ParameterState.SILENT, ParameterState.ABSENT)
)
LONG = 5 * len(PARAMETERS[MOTION]) + 5


@pytest.mark.parametrize("node", [MOTION, ACQUISITION])
def test_everything_is_read_as_the_node_was_set_up(node: int) -> None:
    bench = Bench().run(LONG)
    assert bench.states(node) == KNOWN
    theirs = bench.nodes[node].server.parameters
    assert [p.number for p in bench.mirror.of(node)] == sorted(theirs)
    for mine in bench.mirror.of(node):
        parameter = theirs[mine.number]
        assert (mine.name, mine.type, mine.unit) == (parameter.name, parameter.type, parameter.unit)
        assert mine[3:7] == (parameter.default, parameter.default, parameter.low, parameter.high)
    changed = {p.name: p.value for p in bench.mirror.of(node)}
    for name in ("pump_flow", "blow_after") if node == MOTION else ("voltage_low",):
        assert changed[name] == pytest.approx(getattr(SETTINGS[node], name), rel=1e-6)


def test_one_request_is_in_flight_at_each_node_and_none_once_all_is_known() -> None:
    bench = Bench().run(2 * LONG)
    for name in NAMES.values():
        times = [t for t, request, _ in bench.requests if request == f"{name}ParameterRequest"]
        assert len(times) == len(set(times))
    assert max(t for t, _, _ in bench.requests) < LONG


def test_nobody_is_asked_before_it_said_what_it_is() -> None:
    bench = Bench()
    for node in bench.nodes.values():
        node.dead = True
    bench.run(3)
    assert bench.requests == []
    assert bench.states(MOTION) == ASKED


def test_configuration_is_written_first_where_the_node_has_something_else() -> None:
    wanted = {MOTION: {"quiet_after": 8.0, "blow_after": 90.0}, ACQUISITION: {"radio_left_alone": False}}
    bench = Bench(wanted).run(20)
    assert bench.nodes[MOTION].server["quiet_after"] == 8.0
    assert bench.nodes[ACQUISITION].server["radio_left_alone"] is False
    assert [(o.node, o.number, o.result) for o in bench.outcomes] == [
        (MOTION, QUIET_AFTER, "Ok"), (ACQUISITION, RADIO, "Ok"),
    ]  # fmt: skip
    assert bench.outcomes[0].words == "Motion: quiet_after = 8.0 s: Ok"
    bench.nodes[MOTION].restart()
    bench.run(10)
    assert bench.nodes[MOTION].server["quiet_after"] == 8.0


def test_a_configured_value_that_the_node_refuses_is_told_and_its_own_holds() -> None:
    bench = Bench({MOTION: {"quiet_after": 1e6, "retries": 2.5}}).run(20)
    assert sorted(o.result for o in bench.outcomes) == ["OutOfRange", "OutOfRange"]
    assert bench.nodes[MOTION].server["quiet_after"] == 5.0
    assert bench.one(MOTION, QUIET_AFTER).value == 5.0


def test_an_unknown_name_is_refused() -> None:
    with pytest.raises(UnknownParameterError, match=r"^pump_flaw: is no parameter of the Motion node; there are pump_"):
        NodeParameters(Encoder(), {MOTION: {"pump_flaw": 1.0}})


def test_a_write_holds_until_the_nodes_restart_and_a_saved_one_longer() -> None:
    bench = Bench().run(LONG)
    bench.mirror.write(MOTION, QUIET_AFTER, 12.5)
    bench.run(3)
    assert bench.results() == ["Ok"]
    assert bench.one(MOTION, QUIET_AFTER).value == 12.5 == bench.nodes[MOTION].server["quiet_after"]
    bench.nodes[MOTION].restart()
    bench.run(LONG)
    assert bench.one(MOTION, QUIET_AFTER).value == 5.0
    bench.mirror.write(MOTION, QUIET_AFTER, 12.5)
    bench.mirror.save(MOTION)
    bench.run(5)
    assert bench.results() == ["Ok", "Ok"]
    bench.nodes[MOTION].restart()
    bench.run(2)
    assert bench.states(MOTION) == ASKED
    bench.run(LONG)
    assert bench.states(MOTION) == KNOWN
    assert bench.one(MOTION, QUIET_AFTER).value == 12.5


@pytest.mark.parametrize(
    ("node", "number", "value", "result"),
    [
        (MOTION, QUIET_AFTER, 1e6, "OutOfRange"),
        (MOTION, QUIET_AFTER, float("nan"), "OutOfRange"),
        (MOTION, QUIET_AFTER, 1e300, "OutOfRange"),
        (MOTION, RETRIES, 2.5, "OutOfRange"),
        (MOTION, RETRIES, 10**400, "OutOfRange"),
        (MOTION, RETRIES, 3.0, "Ok"),
        (ACQUISITION, RADIO, 2, "OutOfRange"),
        (ACQUISITION, RADIO, 0, "Ok"),
        (MOTION, 99, 1.0, "NoSuchParameter"),
        (7, 1, 1.0, "NoAnswer"),
    ],
)
def test_what_becomes_of_a_write(node: int, number: int, value: Value, result: str) -> None:
    bench = Bench().run(LONG)
    before = [node.server[p.name] for node in bench.nodes.values() for p in node.server.parameters.values()]
    bench.mirror.write(node, number, value)
    bench.run(5)
    assert bench.results() == [result]
    after = [node.server[p.name] for node in bench.nodes.values() for p in node.server.parameters.values()]
    assert (after != before) == (result == "Ok")


def test_a_counter_is_read_again_when_asked() -> None:
    bench = Bench({MOTION: {"quiet_after": 8.0}}).run(LONG)
    crept = {p.name: p.number for p in PARAMETERS[MOTION]}["oil_crept"]
    bench.nodes[MOTION].server.write(crept, 0x3E800000)  # 0.25 as 32 bits
    assert bench.one(MOTION, crept).value == 0.0
    bench.mirror.read(MOTION, crept)
    bench.run(3)
    assert bench.one(MOTION, crept).value == 0.25
    bench.results()
    bench.mirror.read(MOTION, 99)
    assert bench.run(1).results() == ["NoSuchParameter"]


def test_what_is_written_now_counts_more_than_the_configuration_until_the_next_start() -> None:
    bench = Bench({MOTION: {"quiet_after": 8.0}}).run(LONG)
    bench.mirror.write(MOTION, QUIET_AFTER, 9.0)
    bench.mirror.read(MOTION, QUIET_AFTER)
    bench.run(6)
    assert bench.nodes[MOTION].server["quiet_after"] == 9.0 == bench.one(MOTION, QUIET_AFTER).value
    bench.nodes[MOTION].restart()
    bench.run(10)
    assert bench.nodes[MOTION].server["quiet_after"] == 8.0


def test_a_store_that_takes_nothing_is_told() -> None:
    bench = Bench().run(LONG)

    def refuse(*_: object) -> None:
        raise OSError("full")

    bench.nodes[MOTION].store.write = refuse  # type: ignore[method-assign]
    bench.mirror.save(MOTION)
    bench.run(3)
    assert bench.results() == ["NotSaved"]


def test_too_many_writes_are_refused_and_the_rest_is_done_in_order() -> None:
    bench = Bench().run(LONG)
    for k in range(MOST_WAITING + 10):
        bench.mirror.write(MOTION, QUIET_AFTER, 2.0 + k % 50)
    bench.run(1)
    assert bench.results() == ["Busy"] * 10
    bench.run(MOST_WAITING + 5)
    assert bench.results() == ["Ok"] * MOST_WAITING
    assert bench.one(MOTION, QUIET_AFTER).value == 2.0 + (MOST_WAITING - 1) % 50


def test_a_dead_node_marks_only_its_own_and_is_read_again_when_it_is_back() -> None:
    bench = Bench().run(LONG)
    bench.nodes[MOTION].dead = True
    bench.mirror.write(MOTION, QUIET_AFTER, 9.0)
    bench.run(10)
    assert (bench.states(MOTION), bench.states(ACQUISITION)) == (SILENT, KNOWN)
    assert bench.results() == ["NoAnswer"]
    bench.mirror.write(MOTION, QUIET_AFTER, 10.0)
    assert bench.run(1).results() == ["NoAnswer"]
    before = len(bench.requests)
    bench.run(300)
    assert len(bench.requests) == before
    bench.nodes[MOTION].dead = False
    bench.run(LONG)
    assert bench.states(MOTION) == KNOWN


def test_a_node_that_lives_and_does_not_answer_is_asked_again_after_a_while() -> None:
    bench = Bench()
    bench.nodes[ACQUISITION].dumb = True
    bench.run(10)
    assert (bench.states(ACQUISITION), bench.states(MOTION)) == (SILENT, ASKED | KNOWN)
    asked = [t for t, name, _ in bench.requests if name.startswith("Acquisition")]
    assert len(asked) == 4  # one question, and three times again
    bench.nodes[ACQUISITION].dumb = False
    bench.run(round(ASK_AGAIN) + LONG)
    assert (bench.states(ACQUISITION), bench.states(MOTION)) == (KNOWN, KNOWN)


def test_what_the_node_has_not_is_absent() -> None:
    """A node of another software version: one parameter is missing, one of another type."""
    bench = Bench()
    server = bench.nodes[MOTION].server
    del server.parameters[RETRIES]
    server.parameters[QUIET_AFTER] = server.parameters[QUIET_AFTER]._replace(type=ParameterType.int32)
    bench.run(LONG)
    absent = {p.number for p in bench.mirror.of(MOTION) if p.state is ParameterState.ABSENT}
    assert absent == {RETRIES, QUIET_AFTER}
    assert {p.state for p in bench.mirror.of(MOTION) if p.number not in absent} == KNOWN


Lose = Callable[[int], bool]


@pytest.mark.parametrize("lose", [lambda k: k % 3 == 0, lambda k: k % 5 < 2])
def test_lost_frames_delay_and_spoil_nothing(lose: Lose) -> None:
    bench, count = Bench(), iter(range(10**6))
    take = bench.mirror.take

    def lossy(received: Received, t: float) -> None:
        if not received.name.endswith("ParameterAnswer") or not lose(next(count)):
            take(received, t)

    bench.mirror.take = lossy  # type: ignore[method-assign]
    bench.run(6 * LONG)
    for number, node in bench.nodes.items():
        assert bench.states(number) == KNOWN
        assert [p.value for p in bench.mirror.of(number)] == [
            node.server[p.name] for p in sorted(node.server.parameters.values())
        ]
