"""What the shore learns of each dive at the surface after it: a summary, and a profile of a few samples."""

import math
from dataclasses import dataclass, field

import numpy as np

from stommel.compilation import plain
from stommel.control.dead_reckoning import leave_surface
from stommel.control.dive_cycle import RECOVERY, SURFACE
from stommel.link.outbox import Outbox, Priority
from stommel.link.service import Received
from stommel.messages.mavlink import Fields
from stommel.onboard.radio.observed import Observed
from stommel.onboard.radio.telemetry_table import clipped, degrees_e7, dive_number

MOST_SAMPLES = 128
"""Of a profile: when there are more, every second is left out."""
SAID_AGAIN = 60.0
"""Between two times that a summary is said while the vehicle lies at the surface [s]: one may be lost."""
_AFLOAT = (SURFACE, RECOVERY)


@dataclass
class _Dive:
    """A dive under way."""

    number: int
    utc: float
    latitude: float
    longitude: float
    energy: float
    deepest: float = 0.0
    lowest: float = math.inf
    samples: list[Fields] = field(default_factory=list)
    stride: int = 1
    """Of so many samples one is kept."""
    passed: int = 0

    def sample(self, values: Fields) -> None:
        self.passed += 1
        if (self.passed - 1) % self.stride:
            return
        self.samples.append(values)
        if len(self.samples) > MOST_SAMPLES:
            del self.samples[1::2]
            self.stride *= 2


class DiveReports:
    """A service of the link that nobody has to ask."""

    def __init__(self) -> None:
        self._dive: _Dive | None = None
        self._ended: _Dive | None = None
        self._seen: Observed | None = None
        self._samples: list[Fields] = []
        self._due = 0.0
        self._afloat = True
        self._sampled_at = -math.inf

    def observe(self, seen: Observed) -> None:
        """Take what a decision saw."""
        memory, navigation = seen.memory, seen.view.navigation
        if memory is None or navigation is None:
            return
        self._seen = seen
        afloat = int(memory["phase"]) in _AFLOAT
        if self._afloat and not afloat:
            number = dive_number(seen)
            energy = float(memory["energy_used"])
            self._dive = _Dive(number, seen.utc, navigation.latitude, navigation.longitude, energy)
            self._ended, self._samples = None, []
        self._afloat = afloat
        if self._dive is None:
            return
        readings = seen.view.situation.readings
        self._dive.deepest = max(self._dive.deepest, readings.depth)
        self._dive.lowest = min(self._dive.lowest, readings.altitude)
        self._take_sample(self._dive, seen)
        if afloat and float(memory["first_fix_at"]) >= 0.0:
            self._ended, self._samples = self._dive, self._dive.samples[::-1]
            self._dive, self._due = None, 0.0

    def _take_sample(self, dive: _Dive, seen: Observed) -> None:
        heard = seen.heard.get("CtdSample", -math.inf)
        if heard <= self._sampled_at:
            return
        self._sampled_at = heard
        values, ago = seen.said("CtdSample"), seen.t - heard
        dive.sample(
            {
                "time_unix_ms": clipped(1e3 * (seen.utc - ago), 64, signed=False),
                "pressure": values["pressure"],
                "temperature": values["temperature"],
                "conductivity": values["conductivity"],
                "dive": dive.number,
            }
        )

    def take(self, received: Received, t: float) -> None:
        """Hear nothing: nobody asks for it."""

    def poll(self, t: float, outbox: Outbox) -> None:
        """Say the report, as far as there is room."""
        if self._ended is not None and self._seen is not None and t >= self._due:
            outbox.put(Priority.SUMMARY, "DIVE_SUMMARY", _summary(self._ended, self._seen))
            self._due = t + SAID_AGAIN
        while self._samples and outbox.room(Priority.SUMMARY) > 512:
            outbox.put(Priority.SUMMARY, "CTD_SAMPLE", self._samples.pop())


def _summary(dive: _Dive, seen: Observed) -> Fields:
    """What became of a dive, by the positions since: they tell the drift better as time goes on."""
    memory = seen.memory
    assert memory is not None
    found = np.array([memory], memory.dtype).view(np.recarray)[0]
    plain(leave_surface)(found, seen.t)  # what control finds when it leaves; it has no other place for the current
    known = found.averaged_over > 0.0
    return {
        "time_begin_unix_ms": clipped(1e3 * dive.utc, 64, signed=False),
        "time_end_unix_ms": clipped(1e3 * (seen.utc - (seen.t - float(memory["surfaced_at"]))), 64, signed=False),
        "dive": dive.number,
        "latitude_begin": degrees_e7(dive.latitude),
        "longitude_begin": degrees_e7(dive.longitude),
        "latitude_end": degrees_e7(float(memory["first_fix_latitude"])),
        "longitude_end": degrees_e7(float(memory["first_fix_longitude"])),
        "greatest_depth": dive.deepest,
        "least_altitude": dive.lowest if math.isfinite(dive.lowest) else math.nan,
        "current_north": float(found.current_north) if known else math.nan,
        "current_east": float(found.current_east) if known else math.nan,
        "energy": float(memory["energy_used"]) - dive.energy,
    }
