"""How bad an alarm is, in three words."""

from typing import Literal

Severity = Literal["notice", "warning", "critical"]
"""`critical` endangers the vehicle, `warning` asks for somebody soon, `notice` is good to know."""

RANK: dict[Severity, int] = {"notice": 0, "warning": 1, "critical": 2}


def is_at_least(severity: Severity, least: Severity) -> bool:
    """Whether one is as bad as another, or worse."""
    return RANK[severity] >= RANK[least]
