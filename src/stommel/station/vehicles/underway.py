"""What only the course of values tells: when this dive began, and how fast the vehicle comes closer to its waypoint."""

import math
from collections import deque
from collections.abc import Sequence

from stommel.archive import Archive
from stommel.messages.mavlink import entry_words
from stommel.station.vehicles.summary import AT_SURFACE, Approach, Usage

LEAST_TIME = 120.0
"""Over which an approach is measured [s]."""

LOOK_BACK = 12 * 3600.0
"""Of what is looked at again after a restart [s]."""
MOST_POINTS = 20_000
WATCHED = ("waypoint", "waypoint_distance_m", "phase", "energy_used_kj")
CYCLES = 3
"""From leaving the surface to leaving it again, over which the use of energy is averaged."""

Sample = tuple[str, float, float]


class Underway:
    """Watches samples of one vehicle; times by its clock [s since 1970]."""

    def __init__(self) -> None:
        self.left_surface: float | None = None
        """When this dive began; None at the surface, or where that was not seen."""
        self._afloat: bool | None = None
        self._waypoint: float | None = None
        self._begins: deque[tuple[float, float]] = deque(maxlen=2)
        """When the last dives began, and how far the waypoint was then [m]."""
        self._distance: tuple[float, float] | None = None
        self._used: float | None = None
        """Energy that was used until now [kJ]."""
        self._uses: deque[tuple[float, float]] = deque(maxlen=CYCLES + 1)
        """When the last dives began, and what had been used by then [kJ]."""
        self._words = entry_words("GLIDER_PHASE")

    def take(self, samples: Sequence[Sample]) -> None:
        """Take samples in the order in which they came."""
        for key, t, value in samples:
            if key == "phase":
                self._take_phase(t, value)
            elif key == "waypoint" and value != self._waypoint:
                self._waypoint, self._distance = value, None
                self._begins.clear()
            elif key == "waypoint_distance_m":
                self._distance = (t, value)
                if not self._begins:
                    self._begins.append(self._distance)
            elif key == "energy_used_kj":
                self._take_energy(value)

    def _take_energy(self, value: float) -> None:
        if self._used is not None and value < self._used:  # counted anew, from the start of a mission
            self._uses.clear()
        self._used = value

    def _take_phase(self, t: float, value: float) -> None:
        afloat = self._words.get(int(value), "") in AT_SURFACE
        if self._afloat and not afloat:
            self.left_surface = t
            if self._distance is not None:
                self._begins.append((t, self._distance[1]))
            if self._used is not None:
                self._uses.append((t, self._used))
        if afloat:
            self.left_surface = None
        self._afloat = afloat

    def restore(self, archive: Archive, vehicle: int, until: float | None = None) -> None:
        """Look again at the last hours that the archive has, or had at a time, so that a restart forgets nothing.

        Raises
        ------
        ArchiveError
            The archive fails.
        """
        end = max(archive.latest(vehicle).get(key, (0.0, 0.0))[0] for key in WATCHED)
        end = end if until is None else min(end, until)
        if end <= 0.0:
            return
        found: list[Sample] = []
        for key in WATCHED:
            series = archive.series(vehicle, key, max(0.0, end - LOOK_BACK), end, MOST_POINTS)
            pairs = zip(series.t.tolist(), series.value.tolist(), strict=True)
            found += [(key, t, value) for t, value in pairs if not math.isnan(value)]
        self.take(sorted(found, key=lambda sample: sample[1]))

    @property
    def approach(self) -> Approach | None:
        """How fast the waypoint comes closer since the last dive began; None where too little was seen."""
        begins, distance = list(self._begins), self._distance  # others ask while the line goes on
        if not begins or distance is None:
            return None
        (began, before), (t, now) = begins[0], distance
        return Approach(began, (before - now) / (t - began)) if t - began >= LEAST_TIME else None

    @property
    def usage(self) -> Usage | None:
        """Mean power of the last dives with the time at the surface between them; None before the second one begins."""
        uses = list(self._uses)  # others ask while the line goes on
        if len(uses) < 2 or uses[-1][0] <= uses[0][0]:
            return None
        (t0, first), (t1, last) = uses[0], uses[-1]
        return Usage(1e3 * (last - first) / (t1 - t0), len(uses) - 1)
