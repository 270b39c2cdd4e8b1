"""Positions out of logs and sentences, before anyone believes them."""

import math
from datetime import date
from typing import Any

from stommel.instruments.gnss.fix import Fix, NoFix, Refusal
from stommel.instruments.gnss.gps_time import unrolled, utc_of
from stommel.instruments.gnss.nmea import KNOT, midnight, number, second_of_day
from stommel.instruments.gnss.novatel.codec import Message
from stommel.instruments.gnss.novatel.logs import BestPos, BestVel, Time
from stommel.instruments.gnss.novatel.words import COMPUTED, SOLUTION

DAY = 86400.0
RANGE_ERROR = 5.0
"""Of one satellite's range [m]: with the dilution of precision it is the position's standard deviation."""
ALONE = 5.0
"""Without a GGA for so long, the position of RMC is used [s]."""
FRESH = 1.5
"""Oldest velocity that belongs to a position [s]."""
_NO_DILUTION = 5.0
"""Dilution where the receiver says none."""


class _Held:
    """How long a receiver has been saying the same time."""

    def __init__(self) -> None:
        self._said: object = None
        self._since = math.nan

    def age(self, said: object, t: float) -> float:
        if said != self._said:
            self._said, self._since = said, t
        return t - self._since


class NovatelPositions:
    """Positions of BESTPOS, with the velocity of BESTVEL and the leap seconds of TIME."""

    def __init__(self, earliest: float) -> None:
        self._earliest = earliest
        self._leap = math.nan
        self._velocity = (-math.inf, math.nan, math.nan)
        self._held = _Held()

    def take(self, message: Message, t: float) -> Fix | NoFix | None:
        """Return the position of a log, if it is one of positions."""
        header, log = message
        if isinstance(log, Time):
            if log.utc == 1:
                self._leap = -log.utc_offset
            return None
        if isinstance(log, BestVel):
            moving = log.status == COMPUTED
            self._velocity = (t, log.speed, math.radians(log.course)) if moving else (-math.inf, math.nan, math.nan)
            return None
        return self._position(log, utc_of(header.week, header.ms, self._leap), (header.week, header.ms), t)

    def _position(self, log: BestPos, utc: float, said: tuple[int, int], t: float) -> Fix | NoFix:
        if log.status != COMPUTED:
            return NoFix(t, Refusal.NO_SOLUTION, f"receiver: {SOLUTION.word(log.status)}")
        heard, speed, course = self._velocity
        if t - heard > FRESH:
            speed = course = math.nan
        return Fix(
            t,
            unrolled(utc, self._earliest) - log.solution_age if math.isfinite(utc) else utc,
            math.radians(log.latitude),
            math.radians(log.longitude),
            math.hypot(log.latitude_sigma, log.longitude_sigma),
            max(log.solution_age, self._held.age(said, t)),
            speed,
            course,
            log.used,
        )


class NmeaPositions:
    """Positions of GGA, of RMC where there is none, with the date of RMC and ZDA and the velocity of RMC and VTG."""

    def __init__(self, earliest: float) -> None:
        self._earliest = earliest
        self._clock = math.nan
        self._gga = math.nan
        self._velocity = (-math.inf, math.nan, math.nan)
        self._dilution = _NO_DILUTION
        self._held = _Held()

    def take(self, message: Any, t: float) -> Fix | NoFix | None:
        """Return the position of a sentence, if it is one of positions."""
        kind: str = message.msgID
        if math.isnan(self._gga):
            self._gga = t  # one may still come
        if kind == "GGA":
            self._gga = t
            return self._of_gga(message, t)
        if kind == "RMC":
            return self._of_rmc(message, t)
        if kind == "ZDA":
            year, month, day = message.year, message.month, message.day
            if all(isinstance(part, int) for part in (year, month, day)):
                self._set_clock(_date(year, month, day), second_of_day(message.time))
        elif kind == "GSA":
            self._dilution = number(message.HDOP) or _NO_DILUTION
        elif kind == "VTG":
            self._set_velocity(number(message.sogn), number(message.cogt), t)
        return None

    def _of_gga(self, message: Any, t: float) -> Fix | NoFix:
        if not number(message.quality):
            return NoFix(t, Refusal.NO_SOLUTION, "receiver: GGA of quality 0")
        dilution = number(message.HDOP) or self._dilution
        return self._fix(message, dilution, int(number(message.numSV) or 0), t)

    def _of_rmc(self, message: Any, t: float) -> Fix | NoFix | None:
        self._set_clock(midnight(message.date), second_of_day(message.time))
        valid = message.status == "A"
        if valid:
            self._set_velocity(number(message.spd), number(message.cog), t)
        if t - self._gga < ALONE:
            return None
        return (
            self._fix(message, self._dilution, 0, t) if valid else NoFix(t, Refusal.NO_SOLUTION, "receiver: RMC void")
        )

    def _fix(self, message: Any, dilution: float, satellites: int, t: float) -> Fix | NoFix:
        latitude, longitude, second = number(message.lat), number(message.lon), second_of_day(message.time)
        if latitude is None or longitude is None or second is None:
            return NoFix(t, Refusal.NO_SOLUTION, f"receiver: {message.msgID} without time or place")
        behind = (self._clock - second + DAY / 2.0) % DAY - DAY / 2.0 if math.isfinite(self._clock) else 0.0
        heard, speed, course = self._velocity
        if t - heard > FRESH:
            speed = course = math.nan
        return Fix(
            t,
            self._clock - behind if math.isfinite(self._clock) else math.nan,
            math.radians(latitude),
            math.radians(longitude),
            dilution * RANGE_ERROR,
            max(0.0, behind, self._held.age(second, t)),
            speed,
            course,
            satellites,
        )

    def _set_clock(self, day: float | None, second: float | None) -> None:
        if day is not None and second is not None:
            self._clock = unrolled(day + second, self._earliest)

    def _set_velocity(self, knots: float | None, course: float | None, t: float) -> None:
        if knots is not None:
            self._velocity = (t, knots * KNOT, math.nan if course is None else math.radians(course))


def _date(year: int, month: int, day: int) -> float | None:
    try:
        return midnight(date(year, month, day))
    except ValueError:
        return None
