"""Which faults no software could have brought the vehicle home with: buoyancy needed against what is left.

From the moment at which a fault strikes that takes buoyancy, with the depth, the oil and the water of that moment, a
perfect pilot is followed who at once pumps all oil out and drops the weight. The pump delivers what it still has at the
pressure of the depth; the open valve, the creeping oil and the leak take from it; without power it stands still. If
even so the vehicle ends sinking, or passes the depth at which its hull is lost, the combination was unsurvivable.
"""

from collections.abc import Sequence
from math import copysign, sqrt
from typing import NamedTuple

import numpy as np

from stommel.simulation.plant.parameters import Engine
from stommel.sitl.faults import table
from stommel.sitl.faults.fault import Fault
from stommel.sitl.faults.on_machinery import ML_MIN

BUOYANCY_KINDS = frozenset(
    ("pump_dead", "pump_weak", "oil_creeps", "valve_stuck_open", "hull_leak", "brown_out", "supply_drop")
)
"""Kinds of faults that take buoyancy, or the means to get it back."""
_PASCAL_PER_METRE = 1.005e4
_STEP = 5.0


class Struck(NamedTuple):
    """The vehicle as a fault strikes."""

    t: float
    """Time of the mission [s]."""
    depth: float
    """[m]"""
    oil: float
    """Outside, as ballast volume [m3]."""
    spare: float
    """Volume by which it would be too light at the surface, as it is [m3]."""


class Means(NamedTuple):
    """What the vehicle has to come up with."""

    engine: Engine
    drop_volume: float
    """Volume that a dropped weight makes it lighter by [m3]; zero for none."""
    lost_below: float
    """Depth at which the hull is lost [m]."""
    ends: float
    """End of the flight [s]."""
    sink_speed: float
    """Vertical speed by a missing volume of `speed_volume` [m/s]."""
    speed_volume: float
    """[m3]"""


def takes_buoyancy(fault: Fault) -> bool:
    """Whether a fault takes buoyancy, or the means to get it back."""
    if fault.kind == "brown_out":
        return fault.target == table.MOTION
    return fault.kind in BUOYANCY_KINDS and not (fault.kind == "supply_drop" and fault.value >= table.BROWN_OUT_VOLTAGE)


def unsurvivable(faults: Sequence[Fault], struck: Sequence[Struck], means: Means) -> str:
    """Return the name of the combination that no pilot survives from one of the moments given; empty if there is none.

    The name is that of the kinds that take buoyancy while the pilot struggles, in alphabetical order.
    """
    guilty = [fault for fault in faults if takes_buoyancy(fault)]
    for moment in struck:
        if not _comes_up(guilty, moment, means):
            return " + ".join(sorted({f.kind for f in guilty if f.ends > moment.t}))
    return ""


def _comes_up(faults: Sequence[Fault], start: Struck, means: Means) -> bool:
    engine, oil, depth = means.engine, start.oil, start.depth
    spare = start.spare + means.drop_volume
    t = start.t
    while t < means.ends:
        acting = [fault for fault in faults if fault.holds(t)]
        change = _oil_flow(acting, engine, depth * _PASCAL_PER_METRE) * _STEP
        change = min(engine.high, max(engine.low, oil + change)) - oil
        oil += change
        spare += change - _STEP * ML_MIN * sum(f.value for f in acting if f.kind == "hull_leak")
        # drag goes with the square of the speed
        sinks = -copysign(means.sink_speed * sqrt(abs(spare) / means.speed_volume), spare)
        depth = max(0.0, depth + _STEP * sinks)
        if depth > means.lost_below:
            return False
        t += _STEP
    return spare > 0.0


def _oil_flow(acting: Sequence[Fault], engine: Engine, pressure: float) -> float:
    """Greatest flow of oil out of the hull [m3/s]; negative where more runs back than the pump delivers."""
    pump = float(np.interp(pressure, engine.pressure, engine.pump_flow))
    back = 0.0
    for fault in acting:
        if fault.kind == "pump_weak":
            pump *= fault.value
        elif fault.kind in ("pump_dead", "brown_out", "supply_drop"):
            pump = 0.0
        elif fault.kind == "oil_creeps":
            back += fault.value * ML_MIN
        elif fault.kind == "valve_stuck_open":
            back += fault.value * float(np.interp(pressure, engine.pressure, engine.valve_flow))
    return pump - back
