"""Oracles: the arithmetic of the settings (air time, means of the distributions), and conservation of bytes."""

import itertools
import math
import time

import pytest

from stommel.link.channel.channel import Channel, ChannelEnd
from stommel.link.channel.settings import ChannelError, ChannelSettings
from stommel.link.frames import FrameSplitter, frame_bytes
from stommel.messages.mavlink import message_named

FRAME = frame_bytes(message_named("HEARTBEAT"), bytes(range(9)), 1, 1, 0)
CLEAN = ChannelSettings()


def pour(channel: Channel, end: ChannelEnd, data: bytes, step: float = 0.01, longest: float = 1e4) -> list[bytes]:
    """What arrives of bytes that are written as fast as the modem takes them, by step."""
    arrived, at, far = [], 0, channel.other(end)
    for number in itertools.count():
        t = number * step
        at += end.write(data[at : at + end.room(t)], t)
        arrived.append(far.read(t))
        if (at == len(data) and channel.next_event() == math.inf) or t > longest:
            return arrived
    raise AssertionError


def test_a_byte_takes_ten_bits_and_arrives_after_the_latency() -> None:
    channel = Channel(ChannelSettings(bit_rate=9600.0, latency=0.5, packet=48))
    channel.vehicle.write(bytes(48), 1.0)
    due = 1.0 + 480 / 9600 + 0.5
    assert channel.shore.read(due - 1e-6) == b""
    assert channel.next_event() == pytest.approx(due)
    assert channel.shore.read(due + 1e-6) == bytes(48)
    assert channel.next_event() == math.inf


def test_a_calm_channel_carries_all_at_its_bit_rate() -> None:
    data = bytes(range(256)) * 400
    channel = Channel(CLEAN)
    arrived = pour(channel, channel.vehicle, data)
    assert b"".join(arrived) == data
    assert len(arrived) * 0.01 == pytest.approx(len(data) / 11_520 + 0.05, abs=0.03)


def test_both_ends_get_their_turn_and_the_turns_cost_what_they_cost() -> None:
    channel = Channel(CLEAN)
    arrived = {id(channel.vehicle): 0, id(channel.shore): 0}
    for number in range(2001):
        t = number * 0.01
        for end in (channel.vehicle, channel.shore):
            end.write(bytes(end.room(t)), t)
            arrived[id(end)] += len(end.read(t))
    turn = math.ceil(0.1 / (172 / 11_520)) * 172
    expected = 19.95 * turn / (2 * (turn / 11_520 + 0.01))
    for count in arrived.values():
        assert count == pytest.approx(expected, rel=0.02)


def test_a_short_word_overtakes_none_but_waits_no_longer_than_a_turn() -> None:
    channel = Channel(CLEAN)
    channel.vehicle.write(bytes(8000), 0.0)
    channel.shore.write(b"abort", 0.0)
    heard = next(n * 0.001 for n in range(2000) if channel.vehicle.read(n * 0.001))
    assert heard <= 0.1 + 172 / 11_520 + 0.01 + 0.05 + 0.005


@pytest.mark.parametrize("loss", [0.1, 0.4])
def test_loss_of_frames_is_exact_in_the_mean(loss: float) -> None:
    channel = Channel(ChannelSettings(loss=loss, whole_frames=True), seed=3)
    count = 20_000
    splitter = FrameSplitter()
    found = sum(len(splitter.take(data)) for data in pour(channel, channel.vehicle, FRAME * count))
    assert splitter.bad == 0
    assert found / count == pytest.approx(1.0 - loss, abs=4.0 * math.sqrt(loss * (1.0 - loss) / count))


def test_fades_have_their_share_and_their_length() -> None:
    settings = ChannelSettings(fade_every=3.0, fade_length=1.0, packet=21, buffer=2**20, half_duplex=False)
    channel = Channel(settings, seed=5)
    lost: list[bool] = []
    for number in range(60_000):
        t = number * 0.1
        channel.vehicle.write(FRAME, t)
        lost.append(not channel.shore.read(t + 0.099))
    runs = [len(list(run)) for is_lost, run in itertools.groupby(lost) if is_lost]
    assert sum(lost) / len(lost) == pytest.approx(0.25, abs=0.03)
    assert 0.1 * sum(runs) / len(runs) == pytest.approx(1.0, rel=0.12)


def test_bits_flip_as_often_as_they_should() -> None:
    channel = Channel(ChannelSettings(bit_error_rate=1e-3), seed=2)
    data = bytes(200_000)
    arrived = b"".join(pour(channel, channel.vehicle, data))
    assert len(arrived) == len(data)
    flipped = sum(byte.bit_count() for byte in arrived)
    assert flipped == channel.vehicle.counts.flipped_bits
    assert flipped == pytest.approx(1600, abs=4.0 * math.sqrt(1600))


def test_packets_arrive_twice_and_out_of_order_but_all_arrive() -> None:
    settings = ChannelSettings(duplication=0.2, reordering=0.2, packet=4)
    channel = Channel(settings, seed=1)
    data = b"".join(number.to_bytes(4, "big") for number in range(5000))
    arrived = b"".join(pour(channel, channel.vehicle, data))
    numbers = [int.from_bytes(arrived[at : at + 4], "big") for at in range(0, len(arrived), 4)]
    assert set(numbers) == set(range(5000))
    assert len(numbers) / 5000 == pytest.approx(1.2, abs=0.03)
    assert numbers != sorted(numbers)


def test_jitter_reorders_nothing() -> None:
    channel = Channel(ChannelSettings(jitter=0.5, packet=8), seed=1)
    data = bytes(range(256)) * 20
    assert b"".join(pour(channel, channel.vehicle, data)) == data


def test_under_water_nothing_passes_and_what_was_on_its_way_is_lost() -> None:
    channel = Channel(ChannelSettings(outages=((1.0, 2.0),), latency=0.2))
    for number in range(300):
        channel.vehicle.write(bytes((number,)) if number < 256 else b"\xff", number * 0.01)
    arrived = channel.shore.read(5.0)
    assert set(range(75)) < set(arrived)
    assert not set(arrived) & set(range(81, 199))
    assert set(range(201, 255)) < set(arrived)


def test_the_antenna_under_a_wave_is_asked_for() -> None:
    channel = Channel(CLEAN, linked=lambda t: t >= 1.0)
    channel.shore.write(b"early", 0.5)
    channel.shore.write(b"late", 1.5)
    assert channel.vehicle.read(3.0) == b"late"
    assert channel.shore.counts.lost == 1


def test_a_full_modem_refuses() -> None:
    channel = Channel(ChannelSettings(buffer=1000))
    assert channel.vehicle.write(bytes(1500), 0.0) == 1000
    assert channel.vehicle.counts.refused_bytes == 500


def test_what_arrives_does_not_depend_on_who_looks_how_often() -> None:
    settings = ChannelSettings(
        loss=0.2, fade_every=1.0, fade_length=0.3, bit_error_rate=1e-4, duplication=0.1, reordering=0.1, jitter=0.1,
        whole_frames=True,
    )  # fmt: skip

    def run(looks: int) -> tuple[bytes, bytes]:
        channel = Channel(settings, seed=7)
        vehicle, shore = b"", b""
        for number in range(1000):
            t = number * 0.02
            channel.vehicle.write(FRAME * 3, t)
            channel.shore.write(FRAME, t)
            for look in range(looks):
                vehicle += channel.vehicle.read(t + 0.02 * look / looks)
                shore += channel.shore.read(t + 0.02 * look / looks)
        return vehicle + channel.vehicle.read(60.0), shore + channel.shore.read(60.0)

    assert run(1) == run(7)
    assert run(1) == run(1)


def test_a_half_written_frame_is_waited_for_then_sent() -> None:
    channel = Channel(ChannelSettings(whole_frames=True))
    channel.vehicle.write(FRAME[:10], 0.0)
    channel.vehicle.write(FRAME[10:], 0.05)
    assert channel.shore.read(1.0) == FRAME
    assert channel.vehicle.counts.packets == 1
    channel.vehicle.write(b"noise" + FRAME[:15], 2.0)
    assert channel.shore.read(2.09) == b"noise"
    assert channel.shore.read(3.0) == FRAME[:15]


def test_a_megabyte_takes_no_time_to_speak_of() -> None:
    channel = Channel(ChannelSettings(whole_frames=True, loss=0.2), seed=1)
    frame = frame_bytes(message_named("FILE_TRANSFER_PROTOCOL"), bytes(250) + b"\1", 1, 1, 0)
    begin = time.process_time()
    pour(channel, channel.vehicle, frame * 4200, step=0.005)
    assert time.process_time() - begin < 3.0


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"loss": 1.1}, "channel.loss = 1.1: must be from 0 to 1"),
        ({"latency": math.nan}, "channel.latency = nan: must be from 0 to 3600"),
        ({"bit_rate": 0.0}, "channel.bit_rate = 0.0: must be from 10 to 1e+09"),
        ({"fade_every": 0.0}, "channel.fade_every = 0.0: must be above 0"),
        ({"outages": ((2.0, 1.0),)}, "channel.outages: from 2.0 to 1.0: must end after it begins"),
    ],
)
def test_settings_that_cannot_be_are_named(values: dict[str, float], said: str) -> None:
    with pytest.raises(ChannelError) as raised:
        ChannelSettings(**values)  # type: ignore[arg-type]
    assert str(raised.value) == said
