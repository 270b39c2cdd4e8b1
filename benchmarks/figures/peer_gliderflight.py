"""gliderflight's dynamic model (Merckelbach et al. 2019) of the benchmark's glider.

The model solves two force balances in the vertical plane and integrates the depth. Pitch, pressure, ballast volume and
density come from a record of a flight: it has no attitude, no actuators, no control and no ocean of its own. Here the
record is that of the benchmark mission at 1 Hz, the rate of a glider's CTD, cut into dives as a glider's files are. At
the surface the model solves nothing: it lets the velocity fade.

gliderflight integrates with SciPy's RK45 at its own tolerances; its argument `dt` is without effect since version 1.2.
It is told to work serially in this process, which spares it the worker processes of its default (5 % of its time).
"""

import os
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from figures.reference_flight import ReferenceFlight
from stommel.seawater.properties import pressure_from_depth

Array = NDArray[np.float64]
Series = dict[str, Array]

_SHORTEST = 60
"""A dive is not a wave that washes over the vehicle [s]."""
_AREA = 0.1
"""Reference area of the coefficients [m2]."""
_ROOT = Path(__file__).resolve().parents[2]
_COMET = Path("slocum-comet-2016", "flight_first_half.csv")


def series(flight: ReferenceFlight, measured: bool) -> Series:
    """What a glider's own files hold, in gliderflight's units: s, bar, rad, cm3, kg/m3.

    Pitch and pressure are those of the instruments, or the true ones. The hull's thermal expansion, which gliderflight
    does not know, is added to the ballast volume.
    """
    prefix = "measured_" if measured else ""
    p, plan = flight.vehicle, flight.mission.scenario
    expansion = p.V_0 * p.alpha_T * (flight.column("temperature") - p.T_0)
    depth = np.maximum(flight.column(prefix + "depth"), 0.0)
    return {
        "time": flight.column("time").copy(),
        "pressure": pressure_from_depth(depth, plan.start.latitude_deg) / 10.0,
        "pitch": flight.column(prefix + "pitch").copy(),
        "buoyancy_change": (flight.column("ballast") + expansion) * 1e6,
        "density": flight.column("density").copy(),
    }


def dives(flight: ReferenceFlight, given: Series) -> list[Series]:
    """Pieces of a series in which the vehicle is under water, without the one that the record's end cuts off."""
    under = flight.column("depth") > flight.mission.scenario.surface.depth_m
    edges = np.flatnonzero(np.diff(under.astype(int))) + 1
    pieces = [slice(a, b) for a, b in pairwise(edges) if under[a] and b - a > _SHORTEST]
    return [{name: values[piece].copy() for name, values in given.items()} for piece in pieces]


def model(flight: ReferenceFlight) -> Any:
    """The glider of the benchmark; forces are the vehicle file's, with its lift linear in the angle of attack."""
    from gliderflight import DynamicGliderModel  # noqa: PLC0415  # an extra

    p = flight.vehicle
    density = float(flight.column("density").mean())
    mass, per_area = float(p.m), 2.0 / (density * _AREA)
    glider = DynamicGliderModel(rho0=density, k1=float(p.M_f[0]) / mass, k2=float(p.M_f[2]) / mass, max_CPUs=1)
    glider.define(
        mg=mass,
        Vg=float(p.V_0),
        epsilon=float(p.kappa),
        S=_AREA,
        Cd0=per_area * float(p.K_D0),
        Cd1=per_area * float(p.K_D),
        aw=0.0,
        ah=per_area * float(p.K_L),
    )
    return glider


def solve(glider: Any, given: Series) -> None:
    """Integrate over a series; results are attributes of the model."""
    from gliderflight import gliderflight  # noqa: PLC0415  # an extra

    gliderflight.DEBUG_PARALLEL_EXECUTION = True  # its name for: serially, in this process
    glider.solve(dict(given))


def speed_error(flight: ReferenceFlight, glider: Any) -> float:
    """Root mean square difference of the solved speed from the mission's, below 20 m [m/s]."""
    under = flight.column("depth") > 20.0
    return float(np.sqrt(np.mean((glider.U - flight.speed())[under] ** 2)))


def comet_series() -> Series | None:
    """The recorded Slocum flight that gliderflight's own example uses, if its file is there."""
    path = Path(os.environ.get("STOMMEL_DATA", _ROOT.parent / "shared" / "data")) / _COMET
    if not path.is_file():
        return None
    rows = np.genfromtxt(path, delimiter=",", names=True)
    columns = ("time_s", "pressure_bar", "pitch_rad", "ballast_pumped_cc", "density_kg_m3")
    names = ("time", "pressure", "pitch", "buoyancy_change", "density")
    return {name: rows[column].copy() for name, column in zip(names, columns, strict=True)}


def comet_model() -> Any:
    """The Slocum of that flight, with the coefficients of gliderflight's example."""
    from gliderflight import DynamicGliderModel  # noqa: PLC0415  # an extra

    glider = DynamicGliderModel(rho0=1004, k1=0.2, k2=0.98, max_CPUs=1)
    glider.define(Vg=70 / 1004, ah=3.5, mg=70.1, Cd0=0.16)
    return glider
