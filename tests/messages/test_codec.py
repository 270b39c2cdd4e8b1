"""Words to frames and back. Oracle: the limits and steps that `glider.dbc` states, and what went in."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from stommel.messages.codec import REASONS, Decoder, Encoder, Received, Rejected, UnsayableError
from stommel.messages.database import NODES, database, message_named
from stommel.messages.frames import Frame
from stommel.messages.protection import checksum
from tests.messages.sayings import ADDED

if TYPE_CHECKING:
    from cantools.database.can import Message, Signal

MESSAGES = [message.name for message in database().messages]
SIGNALS = [(m.name, s.name) for m in database().messages for s in m.signals if s.name not in ADDED]


def value_of(signal: "Signal") -> st.SearchStrategy[float]:
    assert signal.minimum is not None
    assert signal.maximum is not None
    if signal.scale == 1:
        return st.integers(int(signal.minimum), int(signal.maximum))
    return st.floats(signal.minimum, signal.maximum)


def values_of(message: "Message") -> st.SearchStrategy[dict[str, float]]:
    return st.fixed_dictionaries({s.name: value_of(s) for s in message.signals if s.name not in ADDED})


@pytest.mark.parametrize("name", MESSAGES)
@settings(max_examples=40, deadline=None)
@given(data=st.data())
def test_what_was_said_is_heard_to_half_a_step(name: str, data: st.DataObject) -> None:
    message = message_named(name)
    values = data.draw(values_of(message))
    heard = Decoder().take(Encoder().frame(name, **values))
    assert isinstance(heard, Received)
    assert (heard.name, heard.lost) == (name, 0)
    for signal in message.signals:
        if signal.name not in ADDED:
            half = abs(signal.scale) * 0.5 * (1.0 + 1e-6) if signal.scale != 1 else 0.0
            assert abs(heard.values[signal.name] - values[signal.name]) <= half


def lowest(message: "Message") -> dict[str, float]:
    return {s.name: s.minimum or 0 for s in message.signals if s.name not in ADDED}


@pytest.mark.parametrize(("name", "signal"), SIGNALS)
def test_both_limits_can_be_said_and_nothing_beyond(name: str, signal: str) -> None:
    message = message_named(name)
    described = message.get_signal_by_name(signal)
    low, high, step = described.minimum, described.maximum, abs(described.scale)
    assert low is not None
    assert high is not None
    for value in (low, high):
        heard = Decoder().take(Encoder().frame(name, **lowest(message) | {signal: value}))
        assert isinstance(heard, Received)
        assert heard.values[signal] == pytest.approx(value, rel=1e-9, abs=step / 2.0)
    for value in (low - step, high + step, float("nan"), float("inf"), float("-inf")):
        with pytest.raises(UnsayableError) as refused:
            Encoder().frame(name, **lowest(message) | {signal: value})
        assert f"CAN message {name}: {signal} = {value:g}: must be between {low:g} and {high:g}" in str(refused.value)


@pytest.mark.parametrize(
    ("name", "values", "says"),
    [
        ("MotionSetpint", {}, "CAN message MotionSetpint: the database has none of this name; did you mean MotionSet"),
        ("Sync", {}, "CAN message Sync: vehicle_time: not given"),
        ("Sync", {"vehicle_tim": 1}, "CAN message Sync: vehicle_tim: it has no such signal; did you mean vehicle_time"),
        ("Sync", {"vehicle_time": None}, "CAN message Sync: vehicle_time = None: must be a number"),
    ],
)
def test_what_cannot_be_said_is_named(name: str, values: Mapping[str, float], says: str) -> None:
    with pytest.raises(UnsayableError) as refused:
        Encoder().frame(name, **values)
    assert str(refused.value).startswith(says)


def test_a_refused_message_uses_up_no_number() -> None:
    encoder, decoder = Encoder(), Decoder()
    decoder.take(encoder.frame("Sync", vehicle_time=0))
    with pytest.raises(UnsayableError):
        encoder.frame("Sync", vehicle_time=-1)
    heard = decoder.take(encoder.frame("Sync", vehicle_time=1))
    assert isinstance(heard, Received)
    assert heard.lost == 0


identifiers = st.one_of(st.integers(0, 0x7FF), st.sampled_from([m.frame_id for m in database().messages]))


@settings(max_examples=2000, deadline=None)
@given(st.lists(st.tuples(identifiers, st.binary(max_size=9), st.booleans()), max_size=4))
def test_no_bytes_make_the_decoder_stumble(frames: list[tuple[int, bytes, bool]]) -> None:
    """With their own checksum, too: what is received then lies within the limits of the database."""
    decoder = Decoder()
    for identifier, data, mended in frames:
        said = data[:-1] + bytes((checksum(identifier, data),)) if mended and data else data
        heard = decoder.take(Frame(identifier, said))
        if isinstance(heard, Rejected):
            assert heard.reason in REASONS
            continue
        for signal in message_named(heard.name).signals:
            half = abs(signal.scale) * 0.51
            assert (signal.minimum or 0) - half <= heard.values[signal.name] <= (signal.maximum or 0) + half
    assert decoder.rejected.total() + decoder.received.total() == len(frames)


def test_a_value_beyond_its_limits_is_rejected_though_its_checksum_is_right() -> None:
    data = bytearray(Encoder().frame("MotionSetpoint", ballast=0.0, moving_mass=0.0, steering=0.0).data)
    data[0:2] = (30001).to_bytes(2, "little")
    data[7] = checksum(0x100, bytes(data))
    assert Decoder().take(Frame(0x100, bytes(data))) == Rejected(0x100, "range")
    data[0:2] = (30000).to_bytes(2, "little")
    data[7] = checksum(0x100, bytes(data))
    assert isinstance(Decoder().take(Frame(0x100, bytes(data))), Received)


def test_the_database_says_all_that_documentation_needs() -> None:
    for message in database().messages:
        assert message.length == 8
        assert message.frame_id <= 0x7FF
        assert message.comment
        assert message.senders[0] in NODES.values()
        for signal in message.signals:
            assert signal.comment
            assert signal.byte_order == "little_endian"
            if signal.choices:
                assert sorted(signal.choices) == list(range(int(signal.minimum or 0), int(signal.maximum or 0) + 1))
