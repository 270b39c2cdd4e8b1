"""What happened on a mission: the log's changes of phase, and the waypoints that were reached or receded."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stommel.control.dive_cycle import DESCENT, NOTHING, TARGET_REACHED
from stommel.simulation.flight import Flown
from stommel.simulation.log import EVENT, REASONS
from stommel.simulation.results.waypoints import Waypoints

WAYPOINT_REACHED, SWEPT_AWAY = len(REASONS), len(REASONS) + 1
NAMES = (*REASONS, "waypoint reached", "swept away")
"""Why or what: what the log says, and what follows from the record."""


class Events(NamedTuple):
    """Everything that happened, in order."""

    rows: NDArray[np.void]
    """`stommel.simulation.log.EVENT`."""
    waypoint: NDArray[np.int64]
    """Number of the waypoint that it is about; 0 for none."""


def events_of(flown: Flown, waypoints: Waypoints) -> Events:
    """Put the log's events and those of the waypoints in the order of time."""
    found = [(w.reached_s, WAYPOINT_REACHED, w.number) for w in waypoints.all if w.reached_s is not None]
    found += [(r.named_s, SWEPT_AWAY, r.number) for r in waypoints.receding]
    added = np.zeros(len(found), EVENT)
    for row, (time, reason, _) in zip(added, found, strict=True):
        here = flown.record[max(0, int(np.searchsorted(flown.record["time"], time, side="right")) - 1)]
        row["time"], row["reason"] = time, reason
        for name in ("phase", "latitude", "longitude", "depth"):
            row[name] = here[name]
    rows = np.concatenate([flown.events, added])
    numbers = np.array([0] * len(flown.events) + [number for _, _, number in found], dtype=np.int64)
    order = np.argsort(rows["time"], kind="stable")
    return Events(rows[order], numbers[order])


def dives_begun(phase: NDArray[np.int8], reason: NDArray[np.int8]) -> NDArray[np.bool_]:
    """Which events are changes into descent; others happen during one."""
    return np.asarray((phase == DESCENT) & (reason == NOTHING))


def counts_of(events: Events) -> dict[str, int]:
    """How often what happened, without the ordinary turns at the target depth."""
    kinds, counts = np.unique(events.rows["reason"].astype(int), return_counts=True)
    found = zip(kinds.tolist(), counts.tolist(), strict=True)
    return {NAMES[kind]: count for kind, count in found if kind not in (NOTHING, TARGET_REACHED)}
