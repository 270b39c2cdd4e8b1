"""Oracles: a line of a real GPCTD with its values (basestation3), the session as it prints it, and a device's truth."""

import math
import random

import pytest

from stommel.errors import StommelError
from stommel.instruments.gpctd.device import CtdDevice, CtdTruth
from stommel.instruments.gpctd.driver import CtdDriver, CtdSettings, CtdState
from stommel.instruments.gpctd.live import VARIANTS, live_reading
from stommel.instruments.gpctd.reading import CtdReading
from stommel.instruments.gpctd.stream import LONGEST_LINE
from stommel.instruments.gpctd.upload import cast_of, sample, sample_line

VECTOR = b"004074C76D8651408F1A"
CAST = "cast   1 22 Jul 2026 18:23:17 samples 1 to 176, int = 5, stop = stop cmd"
UTC = 1784744597.0
"""22 July 2026 18:23:17."""
TRUTH = CtdTruth(123.456, 12.3456, 3.56789, UTC, 3663.4)


def sampled(driver: CtdDriver, device: CtdDevice, begin: int, end: int, truth: CtdTruth = TRUTH) -> list[CtdReading]:
    readings = []
    for t in range(begin, end):
        readings += driver.take(device.take(driver.poll(t), truth._replace(utc=UTC + t), t), t)
    return readings


def sampling(variant: str = "plain", oxygen: bool = False) -> CtdDriver:
    driver = CtdDriver(CtdSettings(variant, oxygen))
    driver.sample(True)
    return driver


def test_line_of_a_real_instrument() -> None:
    reading = sample(VECTOR, True, 1.0, UTC)
    assert reading is not None
    said = (reading.pressure, reading.temperature, reading.conductivity, reading.oxygen)
    assert said == pytest.approx((0.31, 26.3197, 5.45164, 3663.4), abs=1e-9)
    assert (reading.t, reading.utc, reading.refused) == (1.0, UTC, ())
    assert sample_line(0.31, 26.3197, 5.45164, 3663.4) == VECTOR


def test_line_of_the_session() -> None:
    cast = cast_of(CAST)
    assert cast is not None
    assert (cast.number, cast.utc, cast.first, cast.last, cast.interval, cast.stop) == (1, UTC, 1, 176, 5.0, "stop cmd")
    assert cast.samples == 176


@pytest.mark.parametrize(
    "line",
    [
        CAST.replace("Jul", "Jux"),
        CAST.replace("1 to 176", "176 to 1"),
        CAST.replace("18:23", "1823"),
        CAST[:-20],
        "cast",
        "",
    ],
)
def test_other_lines_are_no_cast(line: str) -> None:
    assert cast_of(line) is None


@pytest.mark.parametrize("oxygen", [True, False])
def test_stored_samples_have_the_values_that_the_instrument_has(oxygen: bool) -> None:
    size = 20 if oxygen else 15
    assert sample(VECTOR[:size], oxygen, 0.0, UTC) is not None
    for wrong in (
        VECTOR[: size - 1],
        VECTOR[: 35 - size],
        VECTOR[:size] + b"0",
        VECTOR[:size].lower(),
        b"",
        b"G" * size,
    ):
        assert sample(wrong, oxygen, 0.0, UTC) is None


def test_stored_samples_come_back() -> None:
    draw = random.Random(1)
    for _ in range(200):
        values = (draw.uniform(-5.0, 2000.0), draw.uniform(-4.9, 42.0), draw.uniform(0.0, 8.9), draw.uniform(0.0, 9e4))
        reading = sample(sample_line(*values), True, 0.0, 0.0)
        assert reading is not None
        assert reading[1:5] == pytest.approx(values, abs=0.051)
        assert reading[1:4] == pytest.approx(values[:3], abs=0.0051)


@pytest.mark.parametrize(
    ("line", "name"),
    [
        (b"FFFFF" + VECTOR[5:], "pressure"),
        (VECTOR[:5] + b"FFFFF" + VECTOR[10:], "temperature"),
        (VECTOR[:10] + b"FFFFE" + VECTOR[15:], "conductivity"),
        (b"00000" + VECTOR[5:], "pressure"),
    ],
)
def test_stored_error_values_are_no_reading(line: bytes, name: str) -> None:
    reading = sample(line, True, 0.0, 0.0)
    assert reading is not None
    assert math.isnan(getattr(reading, name))
    assert [reason.split(":")[0] for reason in reading.refused] == [name]
    assert sum(map(math.isnan, reading[1:5])) == 1, "the others are readings"


@pytest.mark.parametrize(
    ("line", "name", "word"),
    [
        (b"9999,12.0000,3.00000", "pressure", "error value"),
        (b"999,12.0000,3.00000", "pressure", "error value"),
        (b"9999.000,12.0000,3.00000", "pressure", "error value"),
        (b"-999,12.0000,3.00000", "pressure", "error value"),
        (b"10.000,9999.0000,3.00000", "temperature", "error value"),
        (b"10.000,-99.9900,3.00000", "temperature", "error value"),
        (b"10.000,NaN,3.00000", "temperature", "error value"),
        (b"10.000,12.0000,*****", "conductivity", "error value"),
        (b"10.000,60.0000,3.00000", "temperature", "outside of"),
        (b"-50.000,12.0000,3.00000", "pressure", "outside of"),
        (b"10.000,12.0000,-1.00000", "conductivity", "outside of"),
    ],
)
def test_live_error_values_are_no_reading(line: bytes, name: str, word: str) -> None:
    """c-proof/pyglider#143, #123: 9999 of the CTD was taken as a pressure; ashore it comes as no value."""
    reading = live_reading(line, VARIANTS["plain"], 1.0)
    assert reading is not None
    assert math.isnan(getattr(reading, name))
    assert len(reading.refused) == 1
    assert reading.refused[0].startswith(f"{name}: ")
    assert word in reading.refused[0]


@pytest.mark.parametrize(
    "line",
    [
        b"10.000,12.0000",
        b"10.000,12.0000,3.0000",
        b"10.000,12.0000,3.000000",
        b"10.000,12.0000,3.00000,1.0",
        b"10.00,12.0000,3.00000",
        b"10,12,3",
        b"1e1,12.0000,3.00000",
        b"10.000;12.0000;3.00000",
        b"\xff0.000,12.0000,3.00000",
        b"",
    ],
)
def test_lines_of_another_form_are_none(line: bytes) -> None:
    assert live_reading(line, VARIANTS["plain"], 1.0) is None


@pytest.mark.parametrize("variant", VARIANTS)
def test_live_readings_are_the_truth(variant: str) -> None:
    readings = sampled(sampling(variant), CtdDevice(variant, oxygen=True), 0, 10)
    assert [reading.t for reading in readings] == list(range(10))
    last = readings[-1]
    assert last[1:4] == pytest.approx(TRUTH[:3], abs=1e-3)
    assert last.refused == ()
    assert last.oxygen == pytest.approx(3663.4) if "oxygen" in variant else math.isnan(last.oxygen)


def test_slocums_pressure_is_in_bar() -> None:
    reading = live_reading(b"12.3456,12.3456,3.5678,13.0,1.0,40.0", VARIANTS["slocum_converted"], 0.0)
    assert reading is not None
    assert reading.pressure == pytest.approx(123.456)


def test_broken_sensor_leaves_the_others() -> None:
    reading = sampled(sampling(), CtdDevice(), 0, 3, TRUTH._replace(conductivity=math.nan))[-1]
    assert math.isnan(reading.conductivity)
    assert reading.temperature == pytest.approx(TRUTH.temperature)


@pytest.mark.parametrize("oxygen", [True, False])
@pytest.mark.parametrize("drop", [True, False])
def test_casts_are_listed_and_uploaded(oxygen: bool, drop: bool) -> None:
    driver = CtdDriver(CtdSettings("plain", oxygen, drop_flushed=drop))
    device = CtdDevice("plain", oxygen)
    for begin in (0, 100):
        driver.sample(True)
        sampled(driver, device, begin, begin + 50)
        driver.sample(False)
        sampled(driver, device, begin + 50, begin + 60)
    driver.list_casts()
    sampled(driver, device, 200, 202)
    assert [(cast.number, cast.first, cast.last, cast.utc) for cast in driver.casts.values()] == [
        (1, 1, 50, UTC),
        (2, 51, 100, UTC + 100),
    ]
    driver.upload(2)
    readings = sampled(driver, device, 202, 204)
    assert driver.uploaded is not None
    assert driver.uploaded.complete
    flushed = (18 if oxygen else 22) if drop else 0
    assert [reading.utc for reading in readings] == [UTC + 100 + n for n in range(50 - flushed)]
    assert readings[0][1:4] == pytest.approx(TRUTH[:3], abs=0.006)
    assert readings[0].oxygen == pytest.approx(3663.4) if oxygen else math.isnan(readings[0].oxygen)
    assert driver.health(204).state is CtdState.IDLE


def test_upload_that_breaks_off_says_so() -> None:
    driver, device = sampling(), CtdDevice()
    sampled(driver, device, 0, 50)
    driver.sample(False)
    driver.list_casts()
    sampled(driver, device, 50, 52)
    driver.upload(1)
    data = device.take(driver.poll(52), TRUTH, 52)
    readings = driver.take(data[: len(data) // 2], 52)
    assert 0 < len(readings) < 25
    assert driver.health(53).state is CtdState.UPLOADING
    for t in range(53, 60):
        driver.poll(t)
    assert driver.uploaded is not None
    assert not driver.uploaded.complete
    assert driver.uploaded.samples < driver.uploaded.cast.samples


def test_unknown_cast_is_named() -> None:
    with pytest.raises(StommelError, match=r"cast of the ctd = 7: must be one of those of a list"):
        CtdDriver().upload(7)


def test_restart_is_mended() -> None:
    driver, device = sampling(), CtdDevice()
    sampled(driver, device, 0, 10)
    device.restart()
    readings = sampled(driver, device, 10, 30)
    assert readings[-1].t == 29
    assert len(readings) >= 12


def test_first_line_may_have_lost_its_beginning() -> None:
    """1123.456 of which the first digits are gone is a plausible pressure, and wrong."""
    driver = sampling()
    assert driver.take(b"23.456,12.0000,3.00000\r\n", 0.0) == []
    assert len(driver.take(b"1123.457,12.0000,3.00000\r\n", 1.0)) == 1


def test_nothing_is_cut_off_a_line() -> None:
    driver = sampling()
    driver.take(b"\r\n11", 0.0)
    assert driver.take(b"23.4", 10.0) == []
    [reading] = driver.take(b"56,12.0000,3.00000\r\n", 20.0)
    assert reading.pressure == 1123.456
    assert driver.take(b"1" * 1000, 21.0) == []
    assert driver.take(b"23.456,12.0000,3.00000\r\n", 21.0) == []
    assert len(driver.take(b"23.456,12.0000,3.00000\r\n", 22.0)) == 1


def test_flood_without_a_line_end_is_not_kept() -> None:
    driver = sampling()
    for t in range(100):
        driver.take(b"x" * 10_000, t)
        assert driver._framer.waiting < LONGEST_LINE


def test_states() -> None:
    driver = CtdDriver()
    assert driver.health(0).state is CtdState.IDLE
    driver.sample(True)
    driver.poll(0)
    assert driver.health(1).state is CtdState.STARTING
    assert driver.health(9).state is CtdState.SILENT
    device = CtdDevice()
    sampled(driver, device, 10, 20)
    assert driver.health(19).state is CtdState.SAMPLING
    assert driver.health(19).last_reading == 19
    nothing = CtdTruth(math.nan, math.nan, math.nan)
    sampled(driver, device, 20, 30, nothing)
    assert driver.health(29).state is CtdState.NO_READING
    assert "pressure: error value" in driver.health(29).reason
    for t in range(30, 40):
        driver.take(bytes((t * 37 + k * k) % 256 for k in range(100)), t)
    assert driver.health(39).state is CtdState.GARBLED
    assert driver.health(39).bad > 0
    assert driver.health(50).state is CtdState.SILENT


def test_another_variant_is_named() -> None:
    driver = sampling("slocum_raw")
    sampled(driver, CtdDevice("plain"), 0, 10)
    assert driver.health(9).state is CtdState.GARBLED
    assert "slocum_raw" in driver.health(9).reason


def test_unknown_variant_names_the_known() -> None:
    with pytest.raises(StommelError, match=r"ctd.variant = sbe19: must be one of plain, plain_oxygen, slocum"):
        CtdSettings(variant="sbe19")


def test_device_refuses_what_it_does_not_know() -> None:
    device = CtdDevice()
    assert b"?cmd" in device.take(b"fly\r\n", TRUTH, 0.0)
    assert b"?cmd" in device.take(b"UC9\r\n", TRUTH, 0.0)
    assert b"?cmd" in device.take(b"\xff" * 5000 + b"\r\n", TRUTH, 0.0)
