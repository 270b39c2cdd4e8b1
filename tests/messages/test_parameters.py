"""Typed parameters over the bus and through a store that breaks. Oracle: values written before."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from stommel.errors import StommelError
from stommel.messages.codec import Decoder, Encoder, Received
from stommel.messages.database import MOTION
from stommel.messages.parameter_files import ParameterFiles
from stommel.messages.parameters import (
    MemoryStore,
    Parameter,
    ParameterAnswer,
    ParameterClient,
    ParameterError,
    ParameterServer,
    ParameterType,
    from_bits,
    to_bits,
)

F, I, B = ParameterType.float32, ParameterType.int32, ParameterType.bool
GAIN = Parameter(1, "gain", F, 0.5, -1.0, 2.0, "1/s")
TURNS = Parameter(2, "turns", I, 7000, -8000, 8000, "r/min")
BRAKE = Parameter(9, "brake", B, True, False, True)
ALL = (GAIN, TURNS, BRAKE)


class Talk:
    """A client and a server on one bus."""

    def __init__(self, store: MemoryStore | ParameterFiles | None = None) -> None:
        self.server = ParameterServer(ALL, store or MemoryStore())
        self.client = ParameterClient(MOTION, Encoder())
        self.node, self.decoder, self.t = Encoder(), Decoder(), 0.0

    def ask(self, operation: str, number: int, bits: int = 0) -> ParameterAnswer:
        self.client.ask(operation, number, self.t, bits)
        for frame in self.client.poll(self.t):
            request = self.decoder.take(frame)
            assert isinstance(request, Received)
            for answer in self.server.take(request, self.node):
                received = self.decoder.take(answer)
                assert isinstance(received, Received)
                self.client.take(received, self.t)
        (found,) = self.client.answers()
        return found


@pytest.mark.parametrize(
    ("parameter", "good", "bad"),
    [
        (GAIN, [-1.0, 0.25, 2.0], [-1.001, 2.001, float("nan"), float("inf"), float("-inf")]),
        (TURNS, [-8000, 0, 8000], [-8001, 8001, 2**31 - 1, -(2**31)]),
        (BRAKE, [False, True], [2, -1]),
    ],
)
def test_values_within_the_limits_are_taken_and_others_refused(
    parameter: Parameter, good: list[float], bad: list[float]
) -> None:
    talk = Talk()
    for value in good:
        assert talk.ask("Write", parameter.number, to_bits(parameter.type, value)).result == "Ok"
        assert talk.server[parameter.name] == value
    held = talk.server[parameter.name]
    for value in bad:
        answer = talk.ask("Write", parameter.number, to_bits(parameter.type, value))
        assert (answer.result, from_bits(parameter.type, answer.bits)) == ("OutOfRange", held)
        assert talk.server[parameter.name] == held


def test_a_parameter_describes_itself() -> None:
    talk = Talk()
    for p in ALL:
        told = [from_bits(p.type, talk.ask(f"Read{what}", p.number).bits) for what in ("Default", "Minimum", "Maximum")]
        assert told == [p.default, p.low, p.high]
        assert talk.ask("ReadType", p.number).bits == int(p.type)
    assert talk.ask("Read", 77).result == "NoSuchParameter"


def test_a_silent_node_is_given_up_and_the_next_request_goes() -> None:
    client = ParameterClient(MOTION, Encoder())
    client.ask("Read", 1, 0.0)
    client.ask("Read", 2, 0.0)
    sent = [t for t in range(8) for _ in client.poll(float(t))]
    assert sent == [0, 1, 2, 3, 4, 5, 6, 7]
    assert client.answers() == [ParameterAnswer("Read", 1, 0, "NoAnswer")]


@given(st.floats(width=32, allow_nan=False))
def test_bits_of_a_float_are_its_own(value: float) -> None:
    assert from_bits(F, to_bits(F, value)) == value


@given(st.integers(-(2**31), 2**31 - 1))
def test_bits_of_a_whole_number_are_its_own(value: int) -> None:
    assert from_bits(I, to_bits(I, value)) == value


def saved(store: MemoryStore | ParameterFiles, value: int) -> None:
    server = ParameterServer(ALL, store)
    assert server.write(2, to_bits(I, value)) == "Ok"
    assert server.save() == "Ok"


def test_what_was_saved_is_there_after_a_restart() -> None:
    store = MemoryStore()
    for value in (1, 2, 3, 4):
        saved(store, value)
        again = ParameterServer(ALL, store)
        assert (again["turns"], again.notes) == (value, [])


def test_what_was_not_saved_is_not() -> None:
    store = MemoryStore()
    server = ParameterServer(ALL, store)
    server.write(2, to_bits(I, 5))
    assert ParameterServer(ALL, store)["turns"] == 7000


def test_a_store_broken_at_any_bit_or_byte_falls_back_to_the_last_good_one_and_says_so() -> None:
    store = MemoryStore()
    saved(store, 11)
    saved(store, 22)
    newest = store.copies[1]
    assert newest is not None
    broken = [newest[:length] for length in range(len(newest))]
    for bit in range(8 * len(newest)):
        flipped = bytearray(newest)
        flipped[bit // 8] ^= 1 << bit % 8
        broken.append(bytes(flipped))
    for content in broken:
        store.copies[1] = content
        server = ParameterServer(ALL, store)
        assert server["turns"] == 11
        assert server.notes[0].startswith("parameter store, copy 1: it")
        assert server.notes[-1] == "parameter store: copy 0 holds, the last good one"
        assert server.save() == "Ok"  # mends the broken copy
        assert ParameterServer(ALL, store).notes == []


def test_two_broken_copies_leave_the_defaults_and_say_so() -> None:
    store = MemoryStore()
    store.copies = [b"", b"PAR1" + bytes(30)]
    server = ParameterServer(ALL, store)
    assert server["turns"] == 7000
    assert len(server.notes) == 3
    assert server.notes[-1] == "parameter store: no good copy; the defaults hold"


@given(st.lists(st.one_of(st.none(), st.binary(max_size=80)), min_size=2, max_size=2))
def test_any_bytes_in_a_store_are_survived(copies: list[bytes | None]) -> None:
    store = MemoryStore()
    store.copies = copies
    server = ParameterServer(ALL, store)
    assert [server[p.name] for p in ALL] == [p.default for p in ALL]


def test_a_stored_value_that_is_no_longer_allowed_is_named() -> None:
    store = MemoryStore()
    saved(store, 7999)
    narrower = ParameterServer((TURNS._replace(high=7500),), store)
    assert narrower["turns"] == 7000
    assert "turns = 7999: must be int32 between -8000 and 7500 r/min; its default holds" in narrower.notes[-2]
    other = ParameterServer((TURNS._replace(type=F),), store)
    assert "turns = 7999: must be float32" in " ".join(other.notes)


def test_files_hold_two_copies_and_a_failed_writing_is_an_answer(tmp_path: Path) -> None:
    store = ParameterFiles(tmp_path / "kept", "motion")
    assert ParameterServer(ALL, store).notes == []
    saved(store, 1)
    saved(store, 2)
    assert sorted(path.name for path in (tmp_path / "kept").iterdir()) == ["motion.0", "motion.1"]
    (tmp_path / "kept" / "motion.1").write_bytes(b"torn")
    assert ParameterServer(ALL, store)["turns"] == 1
    (tmp_path / "kept" / "motion.1").unlink()
    (tmp_path / "kept" / "motion.1").mkdir()
    server = ParameterServer(ALL, store)
    assert server["turns"] == 1
    assert (server.save(), "it is a folder" in server.notes[-1]) == ("NotSaved", True)


@pytest.mark.parametrize(
    ("parameters", "says"),
    [
        ((GAIN, GAIN), "number 1: must be between 0 and 255, each once"),
        ((GAIN._replace(number=256),), "number 256"),
        ((GAIN._replace(default=3.0),), "gain = 3.0: must be between -1.0 and 2.0"),
        ((TURNS._replace(high=2**31),), "must fit the type int32"),
        ((GAIN._replace(high=float("inf")),), "must be between"),
    ],
)
def test_a_parameter_that_cannot_be_is_refused(parameters: tuple[Parameter, ...], says: str) -> None:
    with pytest.raises(ParameterError) as refused:
        ParameterServer(parameters, MemoryStore())
    assert says in str(refused.value)
    assert isinstance(refused.value, StommelError)
