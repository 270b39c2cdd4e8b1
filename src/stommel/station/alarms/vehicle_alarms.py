"""The vehicle's own alarms: bits of its state, each with its words."""

from collections.abc import Iterable
from functools import cache
from typing import NamedTuple

from stommel.messages.mavlink import entry_words
from stommel.station.alarms.change import Change, changes_of
from stommel.station.alarms.severity import Severity
from stommel.station.alarms.threshold import Threshold

PREFIX = "vehicle:"
_CRITICAL = (
    "leak", "leak, sinking on", "leak in both bays", "too deep", "too deep, sinking on", "deeper than the hull rating",
    "sinking on", "bottom, sinking on", "no rise", "no rise, last resort", "no surfacing, still under water",
    "voltage nearly gone", "over-current of the battery", "weight released", "blind, last resort", "vacuum loss",
    "hull flooding",
)  # fmt: skip
"""Alarms with which the vehicle may be lost."""
_NOTICES = ("node restarted", "unknown node", "silent altimeter", "silent CTD", "does not sink", "mission expired")
"""Alarms that ask for nobody at once."""


class VehicleAlarm(NamedTuple):
    """An alarm that a vehicle can raise."""

    bit: int
    key: str
    words: str
    severity: Severity


@cache
def known_alarms() -> tuple[VehicleAlarm, ...]:
    """All that the messages know, by bit."""
    return tuple(
        VehicleAlarm(bit, f"{PREFIX}{words}", f"{words[:1].upper()}{words[1:]}", _severity(words))
        for bit, words in sorted(entry_words("GLIDER_ALARM").items())
    )


def _severity(words: str) -> Severity:
    if words in _CRITICAL:
        return "critical"
    return "notice" if words in _NOTICES else "warning"


def _unknown(bit: int) -> VehicleAlarm:
    return VehicleAlarm(bit, f"{PREFIX}bit {bit.bit_length() - 1}", f"Alarm {bit.bit_length() - 1}", "warning")


def alarms_in(bits: int) -> list[VehicleAlarm]:
    """Alarms that bits stand for; one that nobody knows has its number for a name."""
    named = {alarm.bit: alarm for alarm in known_alarms()}
    return [named.get(1 << place) or _unknown(1 << place) for place in range(64) if bits >> place & 1]


class VehicleAlarmWatch:
    """Bits in, alarms that begin or end out; a bit that nobody knows has its number for a name.

    Parameters
    ----------
    open_keys
        Alarms that were raised before, as from before a restart.
    """

    def __init__(self, open_keys: Iterable[str] = ()) -> None:
        raised = set(open_keys)
        self._watched = alarms_in((1 << 64) - 1)
        self._thresholds = [Threshold(0.5, above=True, raised=alarm.key in raised) for alarm in self._watched]
        self._seen = sum(alarm.bit for alarm in self._watched if alarm.key in raised)

    def take(self, t: float, bits: int) -> list[Change]:
        """Take the bits of a moment [s]."""
        self._seen |= bits
        changes = []
        for alarm, threshold in zip(self._watched, self._thresholds, strict=True):
            if self._seen & alarm.bit:
                told = threshold.take(t, float(bool(bits & alarm.bit)))
                changes += changes_of(alarm.key, told, alarm.words, alarm.severity)
        return [change._replace(value=None) for change in changes]
