"""Oracle: a serial line carries a byte in ten bits."""

import random

import pytest

from stommel.errors import StommelError
from stommel.instruments.radio import Radio, RadioDevice, RadioTruth


def test_bytes_go_through_as_they_are() -> None:
    draw = random.Random(1)
    radio, device = Radio(), RadioDevice()
    sent = heard = out = back = b""
    for t in range(20):
        up, down = draw.randbytes(300), draw.randbytes(300)
        sent, heard = sent + up, heard + down
        radio.write(up)
        back += radio.take(device.take(radio.poll(t), RadioTruth(down, True), t), t)
        out += device.on_air()
    for t in (20, 21, 22):
        back += radio.take(device.take(radio.poll(t), RadioTruth(b"", True), t), t)
        out += device.on_air()
    assert (out, back) == (sent, heard)
    assert radio.counts() == (len(sent), len(heard), 0, 0)


@pytest.mark.parametrize("step", [1.0, 0.1, 0.013])
def test_bit_rate_is_kept(step: float) -> None:
    radio = Radio(bit_rate=9600.0)
    radio.poll(0.0)
    radio.write(bytes(8000))
    sent, steps = 0, round(5.0 / step)
    for k in range(1, steps + 1):
        sent += len(radio.poll(k * step))
    assert sent == pytest.approx(960 * steps * step, abs=2)


def test_idle_time_is_not_saved_up() -> None:
    radio = Radio(bit_rate=9600.0)
    for t in range(1000):
        radio.poll(t)
    radio.write(bytes(8000))
    assert len(radio.poll(1000)) == 960


def test_full_buffer_refuses_and_counts() -> None:
    radio = Radio(buffer=100)
    assert radio.write(bytes(80)) == 80
    assert radio.room == 20
    assert radio.write(bytes(80)) == 20
    assert radio.counts().overflowed == 60
    assert radio.counts().waiting == 100


def test_without_a_link_nothing_passes_and_nothing_grows() -> None:
    device = RadioDevice(buffer=1000)
    for t in range(100):
        assert device.take(bytes(100), RadioTruth(bytes(100), False), t) == b""
    assert device.on_air() == b""
    device.take(b"", RadioTruth(b"", True), 100)
    assert len(device.on_air()) <= 1000


def test_restart_loses_what_was_on_its_way() -> None:
    device = RadioDevice()
    device.take(bytes(100), RadioTruth(b"", False), 0)
    device.restart()
    device.take(b"", RadioTruth(b"", True), 1)
    assert device.on_air() == b""


@pytest.mark.parametrize("settings", [{"bit_rate": 0.0}, {"buffer": 0}, {"bit_rate": float("nan")}])
def test_impossible_settings_are_named(settings: dict[str, float]) -> None:
    with pytest.raises(StommelError, match=r"radio\.\w+ = \w+: must be more than 0"):
        Radio(**settings)  # type: ignore[arg-type]
