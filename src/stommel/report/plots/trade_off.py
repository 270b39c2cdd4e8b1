"""Both sides of the scale of section 3.2 along a root locus: decay rates of the modes, and control authority."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from stommel.analysis import Modes, RootLocus
from stommel.report.plots.complex_plane import nearest_mode
from stommel.report.plots.root_locus_plot import Plane

Series = NDArray[np.float64]


@dataclass(frozen=True)
class Decay:
    """Decay rate of one mode along a locus."""

    name: str
    oscillatory: bool
    rate: Series
    """-Re of the eigenvalue at each value [1/s]."""


@dataclass(frozen=True)
class TradeOff:
    """Both sides of the scale along a locus, for one plane."""

    plane: Plane
    decays: tuple[Decay, ...]
    authority: Series | None
    """Magnitude of the control authority at each value; None where nothing steers."""
    authority_name: str
    authority_unit: str


def trade_off(locus: RootLocus, plane: Plane, modes: Modes | None = None) -> TradeOff:
    """Collect decay rates and control authority of one plane; names come from the design's `modes` if given."""
    branches = locus.longitudinal if plane == "longitudinal" else locus.lateral
    design = locus.design_longitudinal if plane == "longitudinal" else locus.design_lateral
    named = getattr(modes, plane) if modes is not None and design is not None else None
    k_design = int(np.argmin(np.abs(locus.values - locus.design_value)))
    decays = []
    for branch in branches.T if branches is not None else ():
        if np.any(branch.imag < -1e-9):
            continue  # the other half of a pair
        swings = bool(np.all(branch.imag > 1e-9))
        name = nearest_mode(branch[k_design], named).name if named else ("oscillation" if swings else "real mode")
        decays.append(Decay(name, swings, -branch.real))
    return TradeOff(plane, tuple(decays), *_authority(locus, plane))


def _authority(locus: RootLocus, plane: Plane) -> tuple[Series | None, str, str]:
    if plane == "longitudinal":
        # the final pitch hardly moves with stability: weight and moving mass set it; how fast it is reached does
        pitch = np.abs([point.peak_pitch_rate_deg_s_per_mm for point in locus.authorities])
        return pitch, "peak pitch rate per mm of moving mass", "(deg/s)/mm"
    for field, actuator in (
        ("turn_rate_deg_s_per_rudder_deg", "rudder"),
        ("turn_rate_deg_s_per_roll_deg", "rolled mass"),
    ):
        rates = [getattr(point, field) for point in locus.authorities]
        if all(rate is not None for rate in rates):
            return np.abs(rates), f"final turn rate per deg of {actuator}", "(deg/s)/deg"
    return None, "control authority", ""
