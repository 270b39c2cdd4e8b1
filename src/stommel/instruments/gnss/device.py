"""A simulated OEMV-3: it obeys LOG commands and sends NovAtel's logs and NMEA sentences."""

import math
import re
import time
from collections.abc import Callable
from typing import NamedTuple

from stommel.instruments.gnss.gps_time import LEAP_SECONDS, ROLL_OVER, week_and_ms
from stommel.instruments.gnss.nmea import KNOT, angle, sentence
from stommel.instruments.gnss.novatel.codec import Message, to_ascii, to_binary
from stommel.instruments.gnss.novatel.logs import BestPos, BestVel, Header, Log, Time, no_position
from stommel.instruments.gnss.novatel.words import (
    COMPUTED,
    DOPPLER,
    FINESTEERING,
    INSUFFICIENT_OBS,
    NO_TYPE,
    SINGLE,
    UNKNOWN,
    WGS84,
)

_LONGEST_COMMAND = 200
_HOLDS = 5.0
"""How long it goes on saying a position after the satellites are gone [s]."""
_SATELLITES = 9
_LOG = re.compile(r"LOG (?:\[?COM1\]? )?(\w+)(?: ONTIME ([0-9.]+))?", re.IGNORECASE)


class GnssTruth(NamedTuple):
    """Where the antenna is."""

    latitude: float
    """[rad], as the receiver finds it: with its error."""
    longitude: float
    """[rad]"""
    utc: float
    """Seconds since 1970."""
    sky: bool
    """Whether the antenna is out of the water."""
    time_to_fix: float
    """That it needs under the sky this time [s]."""
    north: float = 0.0
    """Speed over ground [m/s]."""
    east: float = 0.0
    """[m/s]"""
    height: float = 0.0
    """Above mean sea level [m]."""
    sigma: float = 2.0
    """Standard deviation of each horizontal direction [m]."""


class _Moment(NamedTuple):
    """What is said at a time."""

    truth: GnssTruth
    """Where it was when it last had a position."""
    utc: float
    """Now."""
    fixed: bool
    age: float


class GnssDevice:
    """The receiver: silent until told what to send, without a fix until it has seen the sky for long enough."""

    def __init__(self, weeks_lost: int = 0) -> None:
        self.weeks_lost = weeks_lost
        """Roll-overs of the week that its software does not count."""
        self.restart()

    def restart(self) -> None:
        """Lose power and come back: it sends nothing and has to find its satellites again."""
        self._logs: dict[str, list[float]] = {}
        self._line = b""
        self._sky_since = math.nan
        self._last: tuple[GnssTruth, float] | None = None

    def take(self, data: bytes, truth: GnssTruth, t: float) -> bytes:
        """Bytes that it sends after these have come to it."""
        *lines, rest = (self._line + data).split(b"\n")
        self._line = rest[-_LONGEST_COMMAND:]
        out = b"".join(self._command(line.decode("ascii", "replace").strip(), t) for line in lines)
        moment = self._moment(truth, t)
        for name, timing in self._logs.items():
            period, due = timing
            if t < due - 1e-6:
                continue
            timing[1] = due + period if due + period > t else t + period
            out += _WRITERS[name](self, moment)
        return out

    def header(self, moment: _Moment) -> Header:
        """What stands before each log."""
        week, ms = week_and_ms(moment.utc)
        status = FINESTEERING if self._last else UNKNOWN
        return Header(week - ROLL_OVER * self.weeks_lost, ms, status)

    def _command(self, line: str, t: float) -> bytes:
        if not line:
            return b""
        if line.upper().startswith("UNLOGALL"):
            self._logs.clear()
            return b"<OK\r\n[COM1]"
        match = _LOG.fullmatch(line)
        if match is None:
            return b"<ERROR:Invalid Message. Field = 1\r\n[COM1]"
        name = match[1].upper()
        if name not in _WRITERS:
            return b"<ERROR:Invalid Message ID\r\n[COM1]"
        period = float(match[2]) if match[2] and match[2].count(".") <= 1 and match[2] != "." else 1.0
        self._logs[name] = [max(period, 0.05), t]
        return b"<OK\r\n[COM1]"

    def _moment(self, truth: GnssTruth, t: float) -> _Moment:
        if not truth.sky:
            self._sky_since = math.nan
        elif self._sky_since != self._sky_since:
            self._sky_since = t
        fixed = t - self._sky_since >= truth.time_to_fix
        if fixed:
            self._last = truth, t
        if self._last is None:
            return _Moment(truth, truth.utc, False, 0.0)
        known, when = self._last
        age = t - when
        if age > _HOLDS:
            return _Moment(truth, truth.utc, False, 0.0)
        return _Moment(known, truth.utc, True, age)


def _best_pos(moment: _Moment) -> Log:
    truth = moment.truth
    if not moment.fixed:
        return no_position(_SATELLITES // 3 if truth.sky else 0)
    latitude, longitude, sigma = math.degrees(truth.latitude), math.degrees(truth.longitude), truth.sigma
    return BestPos(
        status=COMPUTED,
        kind=SINGLE,
        latitude=latitude,
        longitude=longitude,
        height=truth.height,
        undulation=0.0,
        datum=WGS84,
        latitude_sigma=sigma,
        longitude_sigma=sigma,
        height_sigma=2.0 * sigma,
        station="",
        differential_age=0.0,
        solution_age=moment.age,
        tracked=_SATELLITES,
        used=_SATELLITES,
        used_l1=_SATELLITES,
    )


def _best_vel(moment: _Moment) -> Log:
    truth = moment.truth
    if not moment.fixed:
        return BestVel(INSUFFICIENT_OBS, NO_TYPE, 0.0, 0.0, 0.0, 0.0, 0.0)
    return BestVel(COMPUTED, DOPPLER, 0.15, 0.0, math.hypot(truth.north, truth.east), _course(truth), 0.0)


def _time(moment: _Moment) -> Log:
    at = time.gmtime(moment.utc)
    ms = at.tm_sec * 1000 + int(moment.utc % 1.0 * 1000.0)
    return Time(0, 0.0, 1e-8, -LEAP_SECONDS, at.tm_year, at.tm_mon, at.tm_mday, at.tm_hour, at.tm_min, ms, 1)


def _course(truth: GnssTruth) -> float:
    return math.degrees(math.atan2(truth.east, truth.north)) % 360.0


def _clock(utc: float) -> str:
    hundredths = round(utc * 100.0) % 8_640_000
    minutes, rest = divmod(hundredths, 6000)
    return f"{minutes // 60:02d}{minutes % 60:02d}{rest / 100.0:05.2f}"


def _place(truth: GnssTruth) -> str:
    latitude = angle(math.degrees(truth.latitude), 2, "N", "S")
    return f"{latitude},{angle(math.degrees(truth.longitude), 3, 'E', 'W')}"


def _gga(moment: _Moment) -> str:
    if not moment.fixed:
        return "GPGGA,,,,,,0,00,,,M,,M,,"
    truth = moment.truth
    dilution = math.sqrt(2.0) * truth.sigma / 5.0
    clock, place = _clock(moment.utc - moment.age), _place(truth)
    return f"GPGGA,{clock},{place},1,{_SATELLITES:02d},{dilution:.2f},{truth.height:.1f},M,0.0,M,,"


def _rmc(moment: _Moment) -> str:
    at = time.gmtime(moment.utc)
    day = f"{at.tm_mday:02d}{at.tm_mon:02d}{at.tm_year % 100:02d}"
    if not moment.fixed:
        return f"GPRMC,{_clock(moment.utc)},V,,,,,,,{day},,,N"
    truth = moment.truth
    knots = math.hypot(truth.north, truth.east) / KNOT
    return f"GPRMC,{_clock(moment.utc)},A,{_place(truth)},{knots:.3f},{_course(truth):.2f},{day},,,A"


def _zda(moment: _Moment) -> str:
    at = time.gmtime(moment.utc)
    return f"GPZDA,{_clock(moment.utc)},{at.tm_mday:02d},{at.tm_mon:02d},{at.tm_year:04d},00,00"


def _gsa(moment: _Moment) -> str:
    dilution = math.sqrt(2.0) * moment.truth.sigma / 5.0
    used = ",".join(f"{n + 1:02d}" if moment.fixed and n < _SATELLITES else "" for n in range(12))
    tail = f"{2.0 * dilution:.2f},{dilution:.2f},{1.7 * dilution:.2f}" if moment.fixed else ",,"
    return f"GPGSA,A,{3 if moment.fixed else 1},{used},{tail}"


def _vtg(moment: _Moment) -> str:
    if not moment.fixed:
        return "GPVTG,,T,,M,,N,,K,N"
    speed = math.hypot(moment.truth.north, moment.truth.east)
    return f"GPVTG,{_course(moment.truth):.2f},T,,M,{speed / KNOT:.3f},N,{3.6 * speed:.3f},K,A"


_Writer = Callable[[GnssDevice, _Moment], bytes]


def _logged(log: Callable[[_Moment], Log], form: Callable[[Message], bytes]) -> _Writer:
    return lambda device, moment: form(Message(device.header(moment), log(moment)))


def _said(text: Callable[[_Moment], str]) -> _Writer:
    def write(device: GnssDevice, moment: _Moment) -> bytes:
        lost = device.weeks_lost * ROLL_OVER * 604800.0
        return sentence(text(moment._replace(utc=moment.utc - lost) if lost else moment))

    return write


_WRITERS: dict[str, _Writer] = {
    f"{name}{ending}": _logged(log, form)
    for name, log in {"BESTPOS": _best_pos, "BESTVEL": _best_vel, "TIME": _time}.items()
    for ending, form in {"A": to_ascii, "B": to_binary}.items()
} | {
    f"GP{name}": _said(text) for name, text in {"GGA": _gga, "RMC": _rmc, "ZDA": _zda, "GSA": _gsa, "VTG": _vtg}.items()
}
