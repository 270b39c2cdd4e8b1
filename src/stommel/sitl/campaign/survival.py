"""Which faults no software could have brought the vehicle home with: buoyancy needed against what is left.

From the moment at which a fault strikes that takes buoyancy, with the depth, the speed, the oil and the water of that
moment, a perfect pilot is followed who at once pumps all oil out and drops the weight. The pump delivers what it still
has at the pressure of the depth; the open valve, the creeping oil and the leak take from it; without power it stands
still. If even so the vehicle ends too heavy for the surface, or passes the depth at which its hull is lost, the
combination was unsurvivable.

He is perfect, but no prophet: nothing tells of a pump that dies while it rests, or of a valve that sticks open while it
is open. As a dive begins he proves both where the climb's ballast is left outside, the least that he can count on to
float; what breaks after that proof, while the oil runs in, he learns of when the valve is to be shut. At every other
moment, and of everything else, he is told at once.
"""

from collections.abc import Iterator, Sequence
from math import inf
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stommel.simulation.plant.parameters import Engine
from stommel.sitl.faults import table
from stommel.sitl.faults.fault import Fault
from stommel.sitl.faults.on_machinery import ML_MIN

BUOYANCY_KINDS = frozenset(
    ("pump_dead", "pump_weak", "oil_creeps", "valve_stuck_open", "hull_leak", "brown_out", "supply_drop")
)
"""Kinds of faults that take buoyancy, or the means to get it back."""
HIDDEN_KINDS = frozenset(("pump_dead", "pump_weak", "oil_creeps", "valve_stuck_open"))
"""Those of them of which nothing tells while the valve is open and the pump rests."""
_PASCAL_PER_METRE = 1.005e4
_STEP = 1.0


class Profile(NamedTuple):
    """A volume over the depth."""

    depth: NDArray[np.float64]
    """[m]"""
    volume: NDArray[np.float64]
    """[m3]"""


NO_PROFILE = Profile(np.zeros(1), np.zeros(1))
"""The same at every depth."""


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
    sinks: float = 0.0
    """Speed down [m/s]."""
    lighter: Profile = NO_PROFILE
    """By how much lighter than at the surface it is in the depth: its water is denser, its hull pressed together."""
    runs_in_to: float = inf
    """Ballast volume down to which oil runs in before the pilot can know [m3]; infinite where he knows at once."""


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
    settling_way: float
    """Depth within which its speed becomes that of its buoyancy [m]: of the square of the difference 1/e^2 is left."""


def takes_buoyancy(fault: Fault) -> bool:
    """Whether a fault takes buoyancy, or the means to get it back."""
    if fault.kind == "brown_out":
        return fault.target == table.MOTION
    return fault.kind in BUOYANCY_KINDS and not (fault.kind == "supply_drop" and fault.value >= table.BROWN_OUT_VOLTAGE)


def is_hidden(faults: Sequence[Fault], t: float) -> bool:
    """Whether nothing tells of the faults that take buoyancy at a time [s] while the valve is open."""
    return all(fault.kind in HIDDEN_KINDS for fault in faults if takes_buoyancy(fault) and fault.holds(t))


def unsurvivable(faults: Sequence[Fault], struck: Sequence[Struck], means: Means) -> str:
    """Return the name of the combination that no pilot survives from one of the moments given; empty if there is none.

    The name is that of the kinds that take buoyancy while the pilot struggles, in alphabetical order.
    """
    guilty = [fault for fault in faults if takes_buoyancy(fault)]
    for moment in struck:
        if not _comes_up(guilty, moment, means):
            return " + ".join(sorted({f.kind for f in guilty if f.ends > moment.t}))
    return ""


class Followed(NamedTuple):
    """Where the pilot has brought the vehicle after a step."""

    t: float
    depth: float
    spare: float
    """As in `Struck`."""


def followed(faults: Sequence[Fault], start: Struck, means: Means) -> Iterator[Followed]:
    """Follow the pilot from a moment on, to the end of the flight or to the depth at which the hull is lost."""
    engine, t, oil, depth, sinks = means.engine, start.t, start.oil, start.depth, start.sinks
    spare, knows = start.spare + means.drop_volume, oil <= start.runs_in_to
    while t < means.ends and depth <= means.lost_below:
        acting, pressure = [fault for fault in faults if fault.holds(t)], depth * _PASCAL_PER_METRE
        if knows:
            after = max(engine.low, oil + _STEP * _oil_flow(acting, engine, pressure))
        else:
            open_for = min((fault.value for fault in acting if fault.kind == "valve_stuck_open"), default=1.0)
            runs_in = open_for * float(np.interp(pressure, engine.pressure, engine.valve_flow))
            after = max(start.runs_in_to, oil - _STEP * runs_in)
            knows = after <= start.runs_in_to
        after = min(engine.high, after)
        spare += after - oil - _STEP * ML_MIN * sum(f.value for f in acting if f.kind == "hull_leak")
        oil = after
        here = spare + float(np.interp(depth, *start.lighter))
        # drag goes with the square of the speed: v' = (v_end^2 - v |v|) / way, with |v| of the step's beginning
        push = -here / means.speed_volume * means.sink_speed**2
        share = _STEP / means.settling_way
        sinks = (sinks + share * push) / (1.0 + share * abs(sinks))
        depth = depth + _STEP * sinks
        if depth <= 0.0:
            depth, sinks = 0.0, max(0.0, sinks)
        t += _STEP
        yield Followed(t, depth, spare)


def _comes_up(faults: Sequence[Fault], start: Struck, means: Means) -> bool:
    last = Followed(start.t, start.depth, start.spare + means.drop_volume)
    for step in followed(faults, start, means):
        last = step
    return last.depth <= means.lost_below and last.spare > 0.0


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
