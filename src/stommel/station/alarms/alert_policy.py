"""Which alarms people are told of, and when: once, and not again and again while one flaps."""

import math
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

from stommel.station.alarms.alarm import Alarm
from stommel.station.alarms.alert_settings import AlertSettings
from stommel.station.alarms.severity import is_at_least

MOST_ALARMS = 5000
"""Different alarms that are remembered for the time in which they are not told again."""


AlertKind = Literal["raised", "cleared", "repeated", "test"]


class Alert(NamedTuple):
    """Something that people are told."""

    kind: AlertKind
    alarm: Alarm
    times: int = 1
    """How often it was raised since it was told last."""
    since: float = math.inf
    """When it was to be told first, by the station's clock [s since 1970]; not known before it waits."""

    def as_row(self) -> dict[str, Any]:
        """The alert as a webhook tells it."""
        since = self.since if math.isfinite(self.since) else None
        return {"kind": self.kind, "times": self.times, "since": since, "alarm": self.alarm.as_row()}


@dataclass
class _Told:
    t: float
    alarm: Alarm
    is_raise_told: bool = True
    untold: int = 0


class AlertPolicy:
    """Alarms in, alerts out; times are those of whoever asks [s]."""

    def __init__(self, settings: AlertSettings) -> None:
        self._settings = settings
        self._told: dict[tuple[int | None, str], _Told] = {}

    def take(self, alarm: Alarm, t: float) -> list[Alert]:
        """Take an alarm that was raised or cleared."""
        if not is_at_least(alarm.severity, self._settings.least_severity):
            return []
        known = self._told.get((alarm.vehicle, alarm.key))
        return self._cleared(known, alarm) if alarm.cleared is not None else self._raised(known, alarm, t)

    def look(self, t: float) -> list[Alert]:
        """Say what was only counted, once its quiet time is over."""
        alerts = []
        for place, told in list(self._told.items()):
            if t - told.t < self._settings.quiet_s:
                continue
            if told.untold:
                alerts.append(Alert("repeated", told.alarm, told.untold))
                told.t, told.untold, told.is_raise_told = t, 0, True
            elif told.alarm.cleared is not None:
                del self._told[place]
        return alerts

    def _raised(self, known: _Told | None, alarm: Alarm, t: float) -> list[Alert]:
        if known is not None and t - known.t < self._settings.quiet_s:
            known.alarm, known.is_raise_told = alarm, False
            known.untold += 1
            return []
        times = 1 if known is None else 1 + known.untold
        self._told[alarm.vehicle, alarm.key] = _Told(t, alarm)
        while len(self._told) > MOST_ALARMS:
            del self._told[next(iter(self._told))]
        return [Alert("raised", alarm, times)]

    def _cleared(self, known: _Told | None, alarm: Alarm) -> list[Alert]:
        if known is None:
            return []
        known.alarm = alarm
        return [Alert("cleared", alarm)] if self._settings.cleared and known.is_raise_told else []
