"""Oracles: the test vectors of PNI's manuals, the definition of the CRC, and the truth that a device is told."""

import math
import struct
from dataclasses import replace
from itertools import pairwise

import pytest

from stommel.errors import StommelError
from stommel.instruments.tcm.calibration import MANUALS
from stommel.instruments.tcm.components import Component, Config, config_payload
from stommel.instruments.tcm.device import CompassDevice, CompassTruth
from stommel.instruments.tcm.driver import CompassDriver, CompassSettings, CompassState
from stommel.instruments.tcm.frames import LONGEST, PAYLOADS, Id, encoded, look
from stommel.instruments.tcm.reading import DISTORTED, UNCALIBRATED, CompassReading
from tests.support.garbled_streams import crc_bit_by_bit

TRUTH = CompassTruth(math.radians(123.4), math.radians(-26.0), math.radians(3.0), (0.1, -0.2, 0.97), (20.0, -5.0, 41.0))
VECTORS = {
    "kGetModInfo": (Id.GET_MOD_INFO, b"", "00 05 01 EF D4"),
    "kGetData": (Id.GET_DATA, b"", "00 05 04 BF 71"),
    "kStartCal 2-D": (Id.START_CAL, bytes.fromhex("00000014"), "00 09 0A 00 00 00 14 5C F9"),
    "kSetDataComponents": (
        Id.SET_DATA_COMPONENTS,
        bytes.fromhex("0705181915161 74F".replace(" ", "")),
        "00 0D 03 07 05 18 19 15 16 17 4F D5 CE",
    ),
    "kStartIntervalMode": (Id.START_INTERVAL_MODE, b"", "00 05 15 BD 61"),
}


def flown(
    driver: CompassDriver, device: CompassDevice, begin: int, end: int, truth: CompassTruth = TRUTH
) -> list[CompassReading]:
    readings = []
    for t in range(begin, end):
        readings += driver.take(device.take(driver.poll(t), truth, t), t)
    return readings


@pytest.mark.parametrize("name", VECTORS)
def test_frames_are_the_manuals(name: str) -> None:
    identifier, payload, printed = VECTORS[name]
    assert encoded(identifier, payload) == bytes.fromhex(printed)
    assert look(bytes.fromhex(printed), 0) == ((identifier, payload), len(bytes.fromhex(printed)))


def test_crc_is_that_of_its_definition() -> None:
    frame = encoded(Id.CONFIG_RESP, b"\x01\x02\x03\x04\x05")
    assert crc_bit_by_bit(frame[:-2], 16, 0x1021) == int.from_bytes(frame[-2:], "big")


def test_every_identifier_has_a_length() -> None:
    assert set(PAYLOADS) == set(Id)


@pytest.mark.parametrize("bits", [1, 2, 3])
def test_flipped_bits_are_found(bits: int) -> None:
    """CRC-16 with this polynomial has a Hamming distance of 4 at these lengths."""
    frame = encoded(Id.DATA_RESP, bytes(range(30)))
    for first in range(0, 8 * len(frame) - 40, 3):
        damaged = bytearray(frame)
        for step in range(bits):
            place = first + 13 * step
            damaged[place // 8] ^= 1 << place % 8
        found = look(bytes(damaged), 0)
        assert found is None or found[0] is None


@pytest.mark.parametrize("polled", [True, False])
@pytest.mark.parametrize("big_endian", [True, False])
def test_readings_are_the_truth(polled: bool, big_endian: bool) -> None:
    driver = CompassDriver(CompassSettings(polled=polled, big_endian=big_endian))
    readings = flown(driver, CompassDevice(), 0, 20)
    assert len(readings) >= 15
    last = readings[-1]
    assert last.t == 19.0
    assert (last.heading, last.pitch, last.roll) == pytest.approx(TRUTH[:3], abs=1e-6)
    assert last.acceleration == pytest.approx(TRUTH.acceleration, abs=1e-6)
    assert last.magnetic_field == pytest.approx(TRUTH.magnetic_field, abs=1e-5)
    assert (last.status, last.temperature) == (0, 15.0)
    health = driver.health(19.0)
    assert (health.state, health.bad, health.reason, health.last_reading) == (CompassState.SAMPLING, 0, "", 19.0)


@pytest.mark.parametrize("turns", [-1, 0, 1, 2])
@pytest.mark.parametrize("degrees", [0.0, 1e-9, 90.0, 180.0, 359.9999999])
def test_every_heading_comes_through(degrees: float, turns: int) -> None:
    truth = TRUTH._replace(heading=math.radians(degrees) + 2.0 * math.pi * turns, roll=math.radians(degrees))
    reading = flown(CompassDriver(), CompassDevice(), 0, 6, truth)[-1]
    assert 0.0 <= reading.heading < 2.0 * math.pi
    assert math.remainder(reading.heading - math.radians(degrees), 2.0 * math.pi) == pytest.approx(0.0, abs=1e-6)


def test_status_says_distorted_and_uncalibrated() -> None:
    driver, device = CompassDriver(), CompassDevice()
    flown(driver, device, 0, 5)
    driver.forget_calibration()
    reading = flown(driver, device, 5, 7, TRUTH._replace(magnetic_field=(81.0, 0.0, 0.0)))[-1]
    assert reading.status == DISTORTED | UNCALIBRATED


def test_readings_come_at_the_interval_that_was_set() -> None:
    driver, device = CompassDriver(CompassSettings(interval=5.0, silence=12.0)), CompassDevice()
    times = [reading.t for reading in flown(driver, device, 0, 40)]
    assert {b - a for a, b in pairwise(times)} == {5.0}


def test_restart_of_the_instrument_is_mended() -> None:
    """It has forgotten which components to send; its own three are no reading of the driver's ten."""
    driver, device = CompassDriver(), CompassDevice()
    flown(driver, device, 0, 10)
    device.restart()
    readings = flown(driver, device, 10, 20)
    assert readings[-1].t == 19.0
    assert readings[-1].magnetic_field == pytest.approx(TRUTH.magnetic_field, abs=1e-5)
    assert len(readings) >= 6


def test_restart_without_a_word_is_mended() -> None:
    driver = CompassDriver()
    flown(driver, CompassDevice(), 0, 10)
    assert flown(driver, CompassDevice(), 10, 20)[-1].t == 19.0


def test_restart_of_the_vehicle_finds_a_compass_that_sends_by_itself() -> None:
    device = CompassDevice()
    flown(CompassDriver(CompassSettings(polled=False)), device, 0, 10)
    driver = CompassDriver()
    readings = flown(driver, device, 10, 25)
    assert [reading.t for reading in readings] == [float(t) for t in range(25 - len(readings), 25)]
    assert len(readings) >= 10


def test_silence_is_named_and_ends() -> None:
    driver, device = CompassDriver(), CompassDevice()
    flown(driver, device, 0, 10)
    for t in range(10, 30):
        assert driver.take(b"", t) == []
        driver.poll(t)
    assert driver.health(29).state is CompassState.SILENT
    assert driver.health(29).last_reading == 9.0
    assert len(flown(driver, device, 30, 40)) >= 5
    assert driver.health(39).state is CompassState.SAMPLING


def test_never_heard_is_starting_then_silent() -> None:
    driver = CompassDriver()
    asked = []
    for t in range(20):
        asked.append(driver.poll(t))
        state = driver.health(t).state
        assert state is (CompassState.STARTING if t <= 5 else CompassState.SILENT)
    assert sum(bytes.fromhex("000501EFD4") in data for data in asked) >= 5


def test_wrong_baud_rate_is_named() -> None:
    driver = CompassDriver()
    for t in range(20):
        driver.poll(t)
        driver.take(bytes((7 * t + k * k) % 251 for k in range(40)), t)
    health = driver.health(19)
    assert health.state is CompassState.GARBLED
    assert "baud" in health.reason
    assert health.bad > 0


def test_half_frames_are_counted_and_the_next_is_read() -> None:
    driver, device = CompassDriver(), CompassDevice()
    flown(driver, device, 0, 10)
    for t in range(10, 14):
        answer = device.take(driver.poll(t), TRUTH, t)
        assert driver.take(answer[: len(answer) // 2], t) == []
    assert len(flown(driver, device, 14, 17)) == 3
    assert driver.health(16).bad >= 1


def test_frame_in_single_bytes_is_read() -> None:
    driver, device = CompassDriver(), CompassDevice()
    flown(driver, device, 0, 10)
    answer = device.take(driver.poll(10), TRUTH, 10)
    readings = [r for k in range(len(answer)) for r in driver.take(answer[k : k + 1], 10 + 0.001 * k)]
    assert len(readings) == 1


def test_false_byte_count_holds_the_next_frame_up_no_longer_than_the_gap() -> None:
    """Garbage that announces 259 bytes of a frame stands before a whole one."""
    driver, device = CompassDriver(), CompassDevice()
    flown(driver, device, 0, 10)
    answer = device.take(driver.poll(10), TRUTH, 10)
    assert driver.take(b"\x01\x00\x0e" + answer, 10.0) == []
    [reading] = driver.take(b"", 10.2)
    assert reading.t == 10.0, "the time at which it came, not at which it was found"


def test_no_announcement_is_waited_for_longer_than_a_frame_can_be() -> None:
    assert look(b"\x0f\xff\x05" + bytes(20), 0) != None  # noqa: E711 - None means "wait"
    assert LONGEST < 300


@pytest.mark.parametrize("revision", ["1209", "9999", "\0\0\0\0"])
def test_unknown_revision_is_a_state_not_a_guess(revision: str) -> None:
    driver = CompassDriver()
    assert flown(driver, CompassDevice(revision=revision), 0, 30) == []
    health = driver.health(29)
    assert health.state is CompassState.UNKNOWN_REVISION
    assert "TCM5 1208" in health.reason


def test_user_names_the_manual_of_a_new_revision() -> None:
    driver = CompassDriver(CompassSettings(revisions={"TCMX 2020": "1014688"}))
    assert flown(driver, CompassDevice("TCMX", "2020"), 0, 10)
    assert driver.health(9).state is CompassState.SAMPLING


@pytest.mark.parametrize(("revision", "manual"), [("1208", "1007537"), ("2020", "1014688")])
@pytest.mark.parametrize("big_endian", [True, False])
def test_score_is_read_by_the_revision(revision: str, manual: str, big_endian: bool) -> None:
    """The trap: the same 24 bytes mean coverage in one firmware and error in another."""
    revisions = {"TCM5 1208": "1007537", "TCM5 2020": "1014688"}
    driver = CompassDriver(CompassSettings(revisions=revisions, big_endian=big_endian))
    device = CompassDevice(revision=revision, score=(1.0, 2.0, 3.0, 4.0, 5.0, 6.0))
    flown(driver, device, 0, 6)
    driver.start_calibration()
    for t in range(6, 18):
        driver.take_calibration_point()
        flown(driver, device, t, t + 1)
        assert driver.calibration.points == t - 5
    assert driver.calibration.score == dict(zip(MANUALS[manual], (1.0, 2.0, 3.0, 4.0, 5.0, 6.0), strict=True))
    assert not driver.calibration.saved
    driver.save()
    flown(driver, device, 18, 20)
    assert driver.calibration.saved


def test_saved_configuration_outlives_a_restart() -> None:
    for saved in (True, False):
        driver, device = CompassDriver(), CompassDevice()
        flown(driver, device, 0, 6)
        driver.use_coefficients(3)
        if saved:
            driver.save()
        flown(driver, device, 6, 8)
        device.restart()
        answer = device.take(encoded(Id.GET_CONFIG, bytes((Config.COEFFICIENT_SET,))), TRUTH, 9)
        assert encoded(Id.CONFIG_RESP, struct.pack(">BI", 18, 3 if saved else 0)) in answer


def test_device_answers_every_request() -> None:
    """Each frame of the manual that asks gets the frame that the manual names."""
    device = CompassDevice()
    asked = {
        Id.GET_MOD_INFO: (b"", Id.MOD_INFO_RESP),
        Id.GET_DATA: (b"", Id.DATA_RESP),
        Id.SET_CONFIG: (config_payload(Config.DECLINATION, -4.5, True), Id.SET_CONFIG_DONE),
        Id.GET_CONFIG: (bytes((Config.DECLINATION,)), Id.CONFIG_RESP),
        Id.SAVE: (b"", Id.SAVE_DONE),
        Id.SET_PARAM: (bytes((3, 1, 4)) + struct.pack(">4d", 0.1, 0.4, 0.4, 0.1), Id.SET_PARAM_DONE),
        Id.GET_PARAM: (bytes((3, 1)), Id.PARAM_RESP),
        Id.SET_ACQ_PARAMS: (struct.pack(">??ff", True, False, 0.0, 1.0), Id.ACQ_PARAMS_DONE),
        Id.GET_ACQ_PARAMS: (b"", Id.ACQ_PARAMS_RESP),
        Id.START_CAL: (bytes(4), Id.USER_CAL_SAMP_COUNT),
        Id.TAKE_USER_CAL_SAMPLE: (b"", Id.USER_CAL_SAMP_COUNT),
        Id.FACTORY_USER_CAL: (b"", Id.FACTORY_USER_CAL_DONE),
        Id.FACTORY_INCL_CAL: (b"", Id.FACTORY_INCL_CAL_DONE),
        Id.SET_MODE: (b"\x64", Id.SET_MODE_RESP),
        Id.SYNC_READ: (b"", Id.DATA_RESP),
        Id.POWER_DOWN: (b"", Id.POWER_DOWN_DONE),
    }
    for t, (identifier, (payload, answer)) in enumerate(asked.items()):
        out = device.take(encoded(identifier, payload), TRUTH, t)
        found = look(out, 0)
        assert found is not None
        assert found[0] is not None
        assert found[0].identifier == answer


def test_device_ignores_what_cannot_be() -> None:
    device = CompassDevice()
    for payload in (b"\x63\x00", bytes((Config.DECLINATION, 0)), bytes((Config.BIG_ENDIAN, 1, 2, 3, 4))):
        assert device.take(encoded(Id.SET_CONFIG, payload), TRUTH, 0.0) == b""
    assert device.take(encoded(Id.SET_DATA_COMPONENTS, b"\x02\x05\x63"), TRUTH, 0.0) == b""
    assert len(device.take(encoded(Id.GET_DATA), TRUTH, 0.0)) == 5 + 1 + 3 * 5


@pytest.mark.parametrize(
    ("component", "value"),
    [
        (Component.HEADING, math.nan),
        (Component.HEADING, 400.0),
        (Component.PITCH, 91.0),
        (Component.ROLL, -1e30),
        (Component.FIELD_X, math.inf),
        (Component.ACCELERATION_Z, 9.81),
    ],
)
def test_impossible_values_are_no_reading(component: Component, value: float) -> None:
    driver, device = CompassDriver(), CompassDevice()
    flown(driver, device, 0, 6)
    for t in range(6, 11):
        answer = bytearray(device.take(driver.poll(t), TRUTH, t))
        at = 4
        while answer[at] != component:
            at += 5
        answer[at + 1 : at + 5] = struct.pack(">f", value)
        answer[-2:] = crc_bit_by_bit(bytes(answer[:-2]), 16, 0x1021).to_bytes(2, "big")
        assert driver.take(bytes(answer), t) == []
    assert driver.health(10).bad == 5
    assert driver.health(10).state is CompassState.SAMPLING
    assert driver.health(11).state is CompassState.NO_READING
    assert component.name.lower() in driver.health(11).reason
    assert driver.poll(11) != encoded(Id.GET_DATA), "it begins anew"
    assert component.name.lower() in driver.health(11).reason


def test_settings_name_what_is_allowed() -> None:
    for setting, word in (
        ({"config": {99: 1.0}}, "compass.config = 99: must be one of 1, 2, 10"),
        ({"config": {6: 1.0}}, "compass.config = 6"),
        ({"revisions": {"TCM5 1": "none"}}, "compass.revisions = none: must be one of 1007537, 1014688"),
        ({"taps": (1.0, 2.0)}, "compass.taps = 2: must be one of 0, 4, 8, 16, 32"),
        ({"interval": 0.0}, "compass.interval = 0: must be more than 0"),
        ({"silence": math.nan}, "compass.silence = nan: must be more than 0"),
    ):
        with pytest.raises(StommelError, match=word):
            replace(CompassSettings(), **setting)


def test_filter_and_configuration_are_set() -> None:
    settings = CompassSettings(config={Config.DECLINATION: -4.5, Config.TRUE_NORTH: 1}, taps=(0.1, 0.4, 0.4, 0.1))
    driver, device = CompassDriver(settings), CompassDevice()
    assert flown(driver, device, 0, 12)
    said = device.take(encoded(Id.GET_CONFIG, b"\x01") + encoded(Id.GET_PARAM, b"\x03\x01"), TRUTH, 12)
    assert encoded(Id.CONFIG_RESP, struct.pack(">Bf", 1, -4.5)) in said
    assert encoded(Id.PARAM_RESP, struct.pack(">3B4d", 3, 1, 4, 0.1, 0.4, 0.4, 0.1)) in said
