"""Oracles: the truth that a simulated receiver is told, pynmeagps for its sentences, and the rules of a fix."""

import math
from functools import reduce
from operator import xor

import pytest
from pynmeagps import VALCKSUM, VALMSGID, NMEAReader

from stommel.errors import StommelError
from stommel.instruments.gnss.device import GnssDevice, GnssTruth
from stommel.instruments.gnss.driver import LOGS, GnssDriver, GnssSettings, GnssState
from stommel.instruments.gnss.fix import Fix, FixLimits, FixRules, NoFix, Refusal
from stommel.instruments.gnss.nmea import angle, sentence
from stommel.instruments.gnss.stream import LONGEST_LINE, look

UTC = 1790000000.25
PLACE = GnssTruth(math.radians(30.26), math.radians(-120.12), UTC, True, 0.0, 0.3, -0.4, 1.0, 2.0)
FORMS = tuple(LOGS)


def surfaced(
    driver: GnssDriver, device: GnssDevice, begin: int, end: int, place: GnssTruth = PLACE, depth: float = 0.0
) -> list[Fix | NoFix]:
    outcomes = []
    for t in range(begin, end):
        data = device.take(driver.poll(t), place._replace(utc=UTC + t), t)
        outcomes += driver.take(data, t, depth)
    return outcomes


def refusals(outcomes: list[Fix | NoFix]) -> list[Refusal | None]:
    return [outcome.reason if isinstance(outcome, NoFix) else None for outcome in outcomes]


def nmea(content: str) -> bytes:
    return f"${content}*{reduce(xor, content.encode(), 0):02X}\r\n".encode()


@pytest.mark.parametrize("form", FORMS)
def test_fixes_are_the_truth(form: str) -> None:
    fix = surfaced(GnssDriver(GnssSettings(format=form)), GnssDevice(), 0, 5)[-1]
    assert isinstance(fix, Fix)
    assert fix.latitude == pytest.approx(PLACE.latitude, abs=2e-9), "a centimetre"
    assert fix.longitude == pytest.approx(PLACE.longitude, abs=2e-9)
    assert fix.utc == pytest.approx(UTC + 4, abs=0.006)
    assert fix.sigma == pytest.approx(math.hypot(2.0, 2.0), rel=0.02)
    assert fix.speed == pytest.approx(0.5, abs=1e-3)
    assert fix.course == pytest.approx(math.atan2(-0.4, 0.3) % math.tau, abs=1e-4)
    assert (fix.t, fix.age, fix.satellites) == (4, 0.0, 9)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("needed", [0.0, 8.0, 30.0])
def test_first_fix_comes_when_it_is_said_to(form: str, needed: float) -> None:
    driver, device = GnssDriver(GnssSettings(format=form)), GnssDevice()
    outcomes = surfaced(driver, device, 0, 40, PLACE._replace(time_to_fix=needed))
    first = next(outcome for outcome in outcomes if isinstance(outcome, Fix))
    assert first.t == needed
    assert {outcome.reason for outcome in outcomes if isinstance(outcome, NoFix)} <= {Refusal.NO_SOLUTION}
    if needed:
        assert "INSUFFICIENT_OBS" in str(outcomes[0]) or form == "nmea"


@pytest.mark.parametrize("form", FORMS)
def test_washed_antenna_holds_the_position_and_it_grows_old(form: str) -> None:
    driver, device = GnssDriver(GnssSettings(format=form)), GnssDevice()
    surfaced(driver, device, 0, 10)
    outcomes = surfaced(driver, device, 10, 20, PLACE._replace(sky=False))
    old, none = Refusal.OLD, Refusal.NO_SOLUTION
    # the last position was of t = 9: 2 s old at t = 11, believed until then
    assert refusals(outcomes)[:8] == [None, None, old, old, old, none, none, none]


@pytest.mark.parametrize("form", FORMS)
def test_week_rolls_over(form: str) -> None:
    """Midnight of a Saturday by GPS time; no second is lost or told twice."""
    saturday = 315964800 + 2425 * 604800 - 18
    driver, device = GnssDriver(GnssSettings(format=form)), GnssDevice()
    times = []
    for t in range(10):
        data = device.take(driver.poll(t), PLACE._replace(utc=saturday - 5.0 + t), t)
        times += [fix.utc for fix in driver.take(data, t) if isinstance(fix, Fix)]
    assert times == pytest.approx([saturday - 5.0 + t for t in range(10)], abs=0.006)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("midnight", [1798761600.0, 1772323200.0])
def test_midnight_and_the_turn_of_the_year(form: str, midnight: float) -> None:
    driver, device = GnssDriver(GnssSettings(format=form)), GnssDevice()
    for t in range(10):
        data = device.take(driver.poll(t), PLACE._replace(utc=midnight - 5.0 + t), t)
        [fix] = driver.take(data, t)
        assert isinstance(fix, Fix)
        assert fix.utc == pytest.approx(midnight - 5.0 + t, abs=0.006)
        assert fix.age == pytest.approx(0.0, abs=0.006)


@pytest.mark.parametrize("form", FORMS)
def test_receiver_that_has_lost_a_roll_over_is_corrected_where_the_settings_say_since_when(form: str) -> None:
    for earliest, wrong in ((0.0, 1024 * 604800.0), (1780000000.0, 0.0)):
        driver = GnssDriver(GnssSettings(format=form, earliest=earliest))
        fix = surfaced(driver, GnssDevice(weeks_lost=1), 0, 3)[-1]
        assert isinstance(fix, Fix)
        assert fix.utc == pytest.approx(UTC + 2 - wrong, abs=0.006)


def test_leap_seconds_are_the_receivers() -> None:
    """Before it has told them UTC is unknown, and not guessed."""
    device = GnssDevice()
    device.take(b"LOG COM1 BESTPOSB ONTIME 1\r\n", PLACE, 0)
    [fix] = GnssDriver().take(device.take(b"", PLACE, 1), 1)
    assert isinstance(fix, Fix)
    assert math.isnan(fix.utc)


@pytest.mark.parametrize("latitude", [89.999999, 45.5, 1e-7, -0.999999999, -33.0, -90.0])
@pytest.mark.parametrize("longitude", [179.9999999, 60.0, 9.99999999, -1e-7, -180.0])
def test_sentences_are_what_pynmeagps_reads(latitude: float, longitude: float) -> None:
    device = GnssDevice()
    names = ("GGA", "RMC", "ZDA", "GSA", "VTG")
    commands = "".join(f"LOG COM1 GP{name} ONTIME 1\r\n" for name in names)
    truth = PLACE._replace(latitude=math.radians(latitude), longitude=math.radians(longitude))
    lines = device.take(commands.encode(), truth, 0).split(b"[COM1]")[-1].splitlines(keepends=True)
    assert len(lines) == 5
    read = {}
    for line in lines:
        assert len(line) <= 82
        message = NMEAReader.parse(line, validate=VALCKSUM | VALMSGID)
        read[message.msgID] = message
    for name in ("GGA", "RMC"):
        assert read[name].lat == pytest.approx(latitude, abs=1e-8)
        assert read[name].lon == pytest.approx(longitude, abs=1e-8)
    assert read["GGA"].time.isoformat() == "14:13:20.250000"
    assert read["RMC"].date.isoformat() == "2026-09-21"
    assert (read["ZDA"].year, read["ZDA"].month, read["ZDA"].day) == (2026, 9, 21)
    assert read["GSA"].navMode == 3
    assert read["RMC"].spd * 1852 / 3600 == pytest.approx(0.5, abs=1e-3)
    assert read["VTG"].sogk / 3.6 == pytest.approx(0.5, abs=1e-3)
    assert read["VTG"].cogt == pytest.approx(306.87, abs=0.006)


def test_minutes_are_never_sixty() -> None:
    assert angle(29.99999999999, 2, "N", "S") == "3000.000000,N"
    assert angle(-0.5, 3, "E", "W") == "00030.000000,W"


@pytest.mark.parametrize("ending", ["\r\n", "*\r\n", "*5\r\n", "*ZZ\r\n", "*00\r\n"])
def test_sentence_without_a_right_checksum_is_refused(ending: str) -> None:
    driver = GnssDriver(GnssSettings(format="nmea"))
    good = "GPGGA,092725.00,4717.113990,N,00833.915900,E,1,08,1.01,499.6,M,48.0,M,,"
    assert driver.take(f"${good}{ending}".encode(), 0.0) == []
    assert driver.health(0.0).bad == 1
    assert len(driver.take(nmea(good), 1.0)) == 1


@pytest.mark.parametrize(
    "content",
    [
        "GPGGA",
        "GPGGA,,,,,,*",
        "GPGGA,,,,,,0",
        "GPGGA,92725,4717,N,00833,E,1",
        "GPGGA,246060.00,4717.0,N,00833.0,E,1,08,1.0,1,M,1,M,,",
        "GPGGA,999999.99,xx,Q,yy,Z,a,b,c,d,e,f,g,h,i",
        "GPGGA,120000.00,9999.0,N,99999.0,E,1,08,1.0,1,M,1,M,,",
        "GPGGA,120000.00,nan,N,inf,E,1,08,nan,1,M,1,M,,",
        "GPRMC,,,,,,,,,,,,",
        "GPZDA,120000.00,31,02,2026,00,00",
        "GPZDA,120000.00,01,01,99999999,00,00",
        "GPZDA,,,,,,",
        "GPGSA,A,3,,,,,,,,,,,,,,,",
        "GPGSA,A,3," + "," * 60,
        "GPVTG,,,,,,,,,",
        "GPVTG,x,T,x,M,x,N,x,K",
        "PUBX,00",
        "P",
        "",
        "GPTXT,01,01,02,hello",
        "GP\u00e9".encode("ascii", "ignore").decode(),
    ],
)
def test_sentences_that_make_no_sense_are_no_fix(content: str) -> None:
    """All with a right checksum: a receiver may say anything."""
    driver = GnssDriver(GnssSettings(format="nmea"))
    for t in range(10):
        outcomes = driver.take(nmea(content), float(t))
        assert not any(isinstance(outcome, Fix) for outcome in outcomes)
    assert driver.health(3.0).state is not GnssState.FIXED


def test_position_of_rmc_is_used_where_no_gga_comes() -> None:
    driver = GnssDriver(GnssSettings(format="nmea"))
    device = GnssDevice()
    device.take(b"LOG COM1 GPRMC ONTIME 1\r\n", PLACE, 0)
    outcomes = [outcome for t in range(1, 8) for outcome in driver.take(device.take(b"", PLACE, t), t)]
    assert [outcome.t for outcome in outcomes] == [6, 7], "after five seconds without a GGA"
    [*_, fix] = outcomes
    assert isinstance(fix, Fix)
    assert fix.latitude == pytest.approx(PLACE.latitude, abs=2e-9)


def test_speed_that_makes_no_sense_is_none_and_the_position_holds() -> None:
    driver = GnssDriver(GnssSettings(format="nmea"))
    driver.take(nmea("GPRMC,120000.00,A,4717.0,N,00833.0,E,1e400,0,310226,,,A"), 0.0)
    [fix] = driver.take(nmea("GPGGA,120000.00,4717.0,N,00833.0,E,1,08,1.0,1,M,1,M,,"), 0.0)
    assert isinstance(fix, Fix)
    assert math.isnan(fix.speed)
    assert math.isnan(fix.utc), "31 February is no date"


HERE = Fix(100.0, UTC, math.radians(30.0), math.radians(120.0), 3.0)
METRE = 1.0 / 6371e3


@pytest.mark.parametrize(
    ("fix", "t", "depth", "reason"),
    [
        (HERE, 100.0, 0.0, None),
        (HERE, 102.0, 0.0, None),
        (HERE, 102.1, 0.0, Refusal.OLD),
        (HERE._replace(age=2.1), 100.0, 0.0, Refusal.OLD),
        (HERE._replace(age=1.5), 101.0, 0.0, Refusal.OLD),
        (HERE, 100.0, 1.0, None),
        (HERE, 100.0, 1.1, Refusal.SUBMERGED),
        (HERE, 100.0, math.nan, None),
        (HERE._replace(latitude=0.0, longitude=0.0), 100.0, 0.0, Refusal.ORIGIN),
        (HERE._replace(latitude=1e-9, longitude=-1e-9), 100.0, 0.0, Refusal.ORIGIN),
        (HERE._replace(latitude=0.0), 100.0, 0.0, None),
        (HERE._replace(longitude=0.0), 100.0, 0.0, None),
        (HERE._replace(latitude=math.nan), 100.0, 0.0, Refusal.IMPOSSIBLE),
        (HERE._replace(latitude=1.6), 100.0, 0.0, Refusal.IMPOSSIBLE),
        (HERE._replace(longitude=3.2), 100.0, 0.0, Refusal.IMPOSSIBLE),
        (HERE._replace(sigma=math.nan), 100.0, 0.0, Refusal.IMPOSSIBLE),
        (HERE._replace(age=math.nan), 100.0, 0.0, Refusal.OLD),
    ],
)
def test_rules_of_a_fix(fix: Fix, t: float, depth: float, reason: Refusal | None) -> None:
    outcome = FixRules().judge(fix, t, depth)
    assert refusals([outcome]) == [reason]
    if isinstance(outcome, NoFix):
        assert outcome.detail


def moved(metres: float, seconds: float) -> Fix:
    return HERE._replace(t=HERE.t + seconds, latitude=HERE.latitude + metres * METRE)


@pytest.mark.parametrize(
    ("metres", "seconds", "believed"),
    [(10.0, 1.0, True), (120.0, 1.0, True), (500.0, 1.0, False), (500.0, 60.0, True), (1e6, 3600.0, False)],
)
def test_jumps_are_no_fix(metres: float, seconds: float, believed: bool) -> None:
    rules = FixRules(FixLimits(speed=10.0, slack=100.0))
    rules.judge(HERE, HERE.t)
    fix = moved(metres, seconds)
    outcome = rules.judge(fix, fix.t)
    assert refusals([outcome]) == [None if believed else Refusal.JUMP]


def test_jump_across_the_date_line_is_none() -> None:
    rules = FixRules()
    rules.judge(HERE._replace(longitude=math.pi - METRE), HERE.t)
    assert isinstance(rules.judge(HERE._replace(longitude=METRE - math.pi), HERE.t), Fix)


def test_one_wrong_fix_does_not_shut_the_true_ones_out() -> None:
    rules = FixRules(FixLimits(agreeing=10))
    rules.judge(moved(1e6, 0.0), HERE.t)
    outcomes = [rules.judge(moved(float(n), float(n)), HERE.t + n) for n in range(12)]
    assert refusals(outcomes) == [Refusal.JUMP] * 9 + [None] * 3


def test_fixes_that_jump_about_are_never_believed() -> None:
    rules = FixRules()
    rules.judge(HERE, HERE.t)
    outcomes = [rules.judge(moved(1e6 * (n % 5 + 1), float(n)), HERE.t + n) for n in range(50)]
    assert set(refusals(outcomes)) == {Refusal.JUMP}


@pytest.mark.parametrize("form", FORMS)
def test_what_is_heard_below_a_metre_is_no_fix(form: str) -> None:
    driver = GnssDriver(GnssSettings(format=form))
    outcomes = surfaced(driver, GnssDevice(), 0, 5, depth=1.5)
    assert set(refusals(outcomes)) == {Refusal.SUBMERGED}
    health = driver.health(4)
    assert health.state is GnssState.REFUSED
    assert "1.5 m" in health.reason


@pytest.mark.parametrize("form", FORMS)
def test_receiver_that_says_the_same_for_ever_grows_old(form: str) -> None:
    device, driver = GnssDevice(), GnssDriver(GnssSettings(format=form))
    stuck = device.take(driver.poll(0), PLACE, 0).split(b"[COM1]")[-1]
    outcomes = [outcome for t in range(6) for outcome in driver.take(stuck, t)]
    assert refusals(outcomes) == [None, None, None, Refusal.OLD, Refusal.OLD, Refusal.OLD]


@pytest.mark.parametrize("form", FORMS)
def test_restart_of_the_receiver_is_mended(form: str) -> None:
    driver, device = GnssDriver(GnssSettings(format=form)), GnssDevice()
    surfaced(driver, device, 0, 10)
    device.restart()
    outcomes = surfaced(driver, device, 10, 30)
    assert isinstance(outcomes[-1], Fix)
    assert outcomes[-1].t == 29


def test_states() -> None:
    driver, device = GnssDriver(), GnssDevice()
    driver.poll(0)
    assert driver.health(1).state is GnssState.STARTING
    assert driver.health(20).state is GnssState.SILENT
    surfaced(driver, device, 20, 30, PLACE._replace(time_to_fix=5.0))
    assert driver.health(29).state is GnssState.FIXED
    assert driver.health(29).last_reading == 29
    surfaced(driver, device, 30, 40, PLACE._replace(sky=False))
    assert driver.health(39).state is GnssState.SEARCHING
    assert driver.health(50).state is GnssState.SILENT


def test_wrong_baud_rate_is_named() -> None:
    driver = GnssDriver()
    for t in range(10):
        driver.poll(t)
        driver.take(bytes((t * 31 + k * k) % 256 for k in range(200)), t)
    assert driver.health(9).state is GnssState.GARBLED
    assert "baud" in driver.health(9).reason


def test_another_receiver_that_only_sends_other_sentences_is_named() -> None:
    driver = GnssDriver()
    for t in range(10):
        driver.poll(t)
        driver.take(b"<ERROR:Invalid Message ID\r\n[COM1]" + sentence("GPTXT,01,01,02,hello"), t)
    health = driver.health(9)
    assert health.state is GnssState.NO_POSITIONS
    assert "Invalid Message ID" in health.reason


def test_device_refuses_what_it_does_not_know() -> None:
    device = GnssDevice()
    assert b"<ERROR" in device.take(b"LOG COM1 RANGEB ONTIME 1\r\n", PLACE, 0)
    assert b"<ERROR" in device.take(b"FRESET\r\n", PLACE, 0)
    assert b"<ERROR" in device.take(b"\xff" * 1000 + b"\r\n", PLACE, 0)
    assert device.take(b"", PLACE, 1) == b""


def test_unknown_format_names_the_known() -> None:
    with pytest.raises(StommelError, match=r"gnss.format = rtcm: must be one of novatel_binary, novatel_ascii, nmea"):
        GnssSettings(format="rtcm")


@pytest.mark.parametrize(
    "flood",
    [b"$" * 5000, b"#" + b"A" * 5000, b"\xaa" * 5000, b"\xaa\x44" * 3000, b"[COM" * 2000, b"<" * 5000],
    ids=["$", "#", "binary", "half binary", "prompt", "answer"],
)
def test_no_flood_is_kept(flood: bytes) -> None:
    driver = GnssDriver(GnssSettings(format="nmea"))
    driver.take(flood, 0.0)
    assert driver._framer.waiting <= LONGEST_LINE
    [outcome] = driver.take(sentence("GPGGA,120000.00,4717.0,N,00833.0,E,1,08,1.0,1,M,1,M,,"), 0.001)
    assert isinstance(outcome, Fix)


def test_look_takes_a_prompt_without_a_line_end() -> None:
    assert look(b"[COM1]", 0) is not None
    assert look(b"[CO", 0) is None
    assert look(b"[CX", 0) == (None, 1)
