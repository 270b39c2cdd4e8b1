"""What alerts say to people."""

import time
from collections.abc import Callable, Sequence
from datetime import UTC, datetime
from typing import NamedTuple

from stommel.errors import one_line
from stommel.station.alarms.alert_policy import Alert

_LAST_TIME = 253_402_300_799.0
"""Of the year 9999 [s]."""
LATE_S = 300.0
"""An alert that has waited for so long is told as late."""
_LONGEST_LINE = 300
_LONGEST_SUBJECT = 120


class Sender(NamedTuple):
    """Who tells."""

    station: str
    """Name of the station."""
    title: Callable[[int], str]
    """What people call a vehicle."""
    address: str = ""
    """Of the page; empty if nobody knows it from outside."""


def utc(t: float) -> str:
    """A time [s since 1970] as people read it."""
    return datetime.fromtimestamp(min(max(t, 0.0), _LAST_TIME), UTC).strftime("%Y-%m-%d %H:%M:%S UTC")


def subject(alerts: Sequence[Alert], sender: Sender) -> str:
    """One line for all of them: the worst, and how many more there are."""
    ranked = sorted(alerts, key=lambda alert: ("critical", "warning", "notice").index(alert.alarm.severity))
    first = f"[{sender.station}] {_headline(ranked[0], sender)}"
    more = f" and {len(alerts) - 1} more" if len(alerts) > 1 else ""
    return one_line(_printable(first), _LONGEST_SUBJECT) + more


def text(alerts: Sequence[Alert], sender: Sender) -> str:
    """All of them, a line each."""
    now = time.time()
    lines = [one_line(_printable(_line(alert, sender, now)), _LONGEST_LINE) for alert in alerts]
    return "\n".join([*lines, "", *([f"Page of the station: {sender.address}"] if sender.address else [])]) + "\n"


def _headline(alert: Alert, sender: Sender) -> str:
    who = sender.station if alert.alarm.vehicle is None else sender.title(alert.alarm.vehicle)
    if alert.kind == "cleared":
        return f"Over: {alert.alarm.words} ({who})"
    return f"{alert.alarm.severity.capitalize()}: {alert.alarm.words} ({who})"


def _line(alert: Alert, sender: Sender, now: float) -> str:
    alarm = alert.alarm
    at = utc(alarm.raised) if alarm.cleared is None else f"{utc(alarm.raised)} to {utc(alarm.cleared)}"
    again = f", {alert.times} times since it was told last" if alert.kind == "repeated" else ""
    late = now - alert.since
    told = f"; told {late / 60.0:.0f} min late, it did not go out before" if late >= LATE_S else ""
    return f"{_headline(alert, sender)}, {at}{again}{told}"


def _printable(words: str) -> str:
    return "".join(sign if sign.isprintable() else " " for sign in words)
