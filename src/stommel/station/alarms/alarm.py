"""An alarm as people see it, from when it was raised until it is history."""

from dataclasses import dataclass
from math import isfinite
from typing import Any

from stommel.station.alarms.severity import Severity


@dataclass(frozen=True)
class Alarm:
    """One raising of an alarm; times are those of the vehicle's clock [s since 1970]."""

    id: int | None
    """Number in the archive; None while the archive has not taken it."""
    vehicle: int | None
    """None: of the station itself."""
    key: str
    words: str
    severity: Severity
    raised: float
    value: float | None = None
    """What decided it, where it was a number."""
    cleared: float | None = None
    acknowledged: float | None = None
    acknowledged_by: str | None = None
    note: str | None = None

    def as_row(self) -> dict[str, Any]:
        """The alarm as the API tells it."""
        value = self.value if self.value is not None and isfinite(self.value) else None
        return {
            "id": self.id, "vehicle": self.vehicle, "key": self.key, "words": self.words, "severity": self.severity,
            "raised": self.raised, "cleared": self.cleared, "acknowledged": self.acknowledged,
            "acknowledged_by": self.acknowledged_by, "value": value, "note": self.note,
        }  # fmt: skip

    def as_brief(self) -> dict[str, Any]:
        """The alarm as summaries tell it: what those must know who look at everything at once."""
        return {
            "id": self.id, "vehicle": self.vehicle, "key": self.key, "words": self.words, "severity": self.severity,
            "raised": self.raised, "acknowledged": self.acknowledged, "acknowledged_by": self.acknowledged_by,
        }  # fmt: skip
