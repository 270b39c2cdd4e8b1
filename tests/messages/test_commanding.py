"""Acknowledged commands over a bus that loses frames. Oracle: what was done, counted on the other side."""

import random

import pytest

from stommel.messages.codec import Decoder, Encoder, Received, UnsayableError
from stommel.messages.commanding import TRIES, CommandReceiver, CommandSender, Order, Outcome
from stommel.messages.database import ACQUISITION, BENCH, COORDINATOR, MOTION
from stommel.messages.frames import Frame


class Line:
    """A coordinator that commands, and a node that carries out, over a bus that may lose frames."""

    def __init__(self, loses: float = 0.0, seed: int = 0, sender: int = COORDINATOR) -> None:
        self.sender = CommandSender(Encoder(), sender)
        self.node = Encoder()
        self.receiver = CommandReceiver(MOTION, self.node)
        self.down, self.up = Decoder(), Decoder()
        self.random, self.loses = random.Random(seed), loses
        self.done: list[Order] = []
        self.result = "Done"
        self.works: dict[Order, float] = {}
        self.takes = 0.0
        """Seconds that each command takes."""

    def carried(self, frames: list[Frame], decoder: Decoder) -> list[Received]:
        heard = [decoder.take(frame) for frame in frames if self.random.random() >= self.loses]
        return [answer for answer in heard if isinstance(answer, Received)]

    def step(self, t: float) -> None:
        answers: list[Frame] = []
        for received in self.carried(self.sender.poll(t), self.down):
            order, frames = self.receiver.take(received, t)
            answers += frames
            if order is not None:
                self.done.append(order)
                self.works[order] = t + self.takes
                answers.append(self.receiver.acknowledge(order, "InProgress"))
        for order in [order for order, end in self.works.items() if t >= end]:
            del self.works[order]
            answers.append(self.receiver.acknowledge(order, self.result, 5))
        for received in self.carried(answers, self.up):
            self.sender.take(received, t)


def test_a_command_is_done_and_its_outcome_known() -> None:
    line = Line()
    number = line.sender.send(MOTION, "Brake", 3, 0.0)
    line.step(0.0)
    assert line.done == [Order("CoordinatorCommand", "Brake", 3, number)]
    assert line.sender.outcomes() == [Outcome(MOTION, "Brake", number, "Done", 5)]
    assert line.sender.outcomes() == []
    assert line.sender.pending == 0


@pytest.mark.parametrize(("loses", "least"), [(0.1, 10), (0.5, 0)])
@pytest.mark.parametrize("seed", range(20))
def test_however_many_frames_are_lost_each_command_is_done_once_at_most(seed: int, loses: float, least: int) -> None:
    """Of 12 commands the last may be waiting; with a tenth of the frames lost, four tries fail once in 800."""
    line = Line(loses, seed)
    line.takes = 3.0
    for t in range(120):
        if t % 10 == 0:
            line.sender.send(MOTION, "SelfTest", t, float(t))
        line.step(float(t))
    arguments = [order.argument for order in line.done]
    assert len(arguments) == len(set(arguments))
    outcomes = line.sender.outcomes()
    assert len(outcomes) + line.sender.pending == 12
    assert sum(outcome.result == "Done" for outcome in outcomes) >= least
    for outcome in outcomes:
        assert outcome.result in ("Done", "NoAnswer")


def test_a_dead_node_is_asked_four_times_and_given_up() -> None:
    sender = CommandSender(Encoder())
    number = sender.send(MOTION, "Blow", 0, 10.0)
    sent = [(t, frame.data[:6]) for t in range(10, 30) for frame in sender.poll(float(t))]
    assert [t for t, _ in sent] == [10, 11, 12, 13]
    assert len({data for _, data in sent}) == 1
    assert sender.outcomes() == [Outcome(MOTION, "Blow", number, "NoAnswer", 0)]


@pytest.mark.parametrize("result", ["Refused", "Unknown", "Failed", "Done"])
def test_a_last_word_that_is_lost_is_said_again(result: str) -> None:
    line = Line()
    line.result, line.takes = result, 1.0
    line.sender.send(MOTION, "SelfTest", 0, 0.0)
    line.step(0.0)
    line.loses = 1.0
    line.step(1.0)
    line.loses = 0.0
    for t in range(2, 20):
        line.step(float(t))
    assert [outcome.result for outcome in line.sender.outcomes()] == [result]
    assert len(line.done) == 1


def test_long_work_is_waited_for() -> None:
    line = Line()
    line.takes = 300.0
    line.sender.send(MOTION, "SelfTest", 0, 0.0)
    for t in range(302):
        line.step(float(t))
    assert [outcome.result for outcome in line.sender.outcomes()] == ["Done"]
    assert len(line.done) == 1


def test_a_restarted_coordinator_is_not_taken_for_a_retry() -> None:
    encoder, receiver, decoder = Encoder(), CommandReceiver(MOTION, Encoder()), Decoder()
    for restarts in range(3):
        sender = CommandSender(encoder, restarts=restarts)
        sender.send(MOTION, "Start", 0, 0.0)
        received = decoder.take(sender.poll(0.0)[0])
        assert isinstance(received, Received)
        order, _ = receiver.take(received, 0.0)
        assert order is not None


def test_the_bench_and_the_coordinator_do_not_answer_for_each_other() -> None:
    encoder = Encoder()
    coordinator, bench = CommandSender(encoder), CommandSender(encoder, BENCH)
    assert coordinator.send(MOTION, "Stop", 0, 0.0) != bench.send(MOTION, "Stop", 0, 0.0)
    receiver, decoder = CommandReceiver(MOTION, Encoder()), Decoder()
    received = decoder.take(bench.poll(0.0)[0])
    assert isinstance(received, Received)
    order, _ = receiver.take(received, 0.0)
    assert order is not None
    answer = decoder.take(receiver.acknowledge(order, "Done"))
    assert isinstance(answer, Received)
    coordinator.take(answer, 0.0)
    bench.take(answer, 0.0)
    assert coordinator.outcomes() == []
    assert len(bench.outcomes()) == 1


def test_another_nodes_command_is_passed_over_and_one_for_all_is_not() -> None:
    sender, decoder = CommandSender(Encoder()), Decoder()
    receiver = CommandReceiver(MOTION, Encoder())
    sender.send(ACQUISITION, "Stop", 0, 0.0)
    sender.send(0, "Stop", 0, 0.0)
    taken = []
    for t in range(TRIES + 2):
        for frame in sender.poll(float(t)):
            received = decoder.take(frame)
            assert isinstance(received, Received)
            order, _ = receiver.take(received, float(t))
            taken.append(order)
    assert sum(order is not None for order in taken) == 1
    assert [outcome.target for outcome in sender.outcomes()] == [ACQUISITION]


@pytest.mark.parametrize(
    ("target", "command", "argument", "says"),
    [
        (MOTION, "Fly", 0, "command Fly: must be one of Blow, Brake"),
        (9, "Stop", 0, "target 9: must be 0 (all), 2 (Motion) or 3 (Acquisition)"),
        (MOTION, "Stop", 40000, "argument = 40000: must be between -32768 and 32767"),
    ],
)
def test_what_cannot_be_said_is_refused_at_once(target: int, command: str, argument: int, says: str) -> None:
    sender = CommandSender(Encoder())
    with pytest.raises(UnsayableError) as refused:
        sender.send(target, command, argument, 0.0)
    assert says in str(refused.value)
    assert sender.pending == 0
