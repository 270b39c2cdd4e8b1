"""Root locus over any number of a vehicle file: how the modes move as one number of the design changes.

The trim is solved anew at every point. `wing_position` and `rudder_position` are l_w / l and l_r / l of Figs. 2-4 of
the paper, in lengths of the sealed hull.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stommel.analysis.authority import Authority, authority
from stommel.analysis.linearization import Linearization, linearise
from stommel.analysis.request import RequestError
from stommel.analysis.trim import trim
from stommel.errors import StommelError
from stommel.files.units import unit_of
from stommel.vehicle import PAPER, Physics, Vehicle
from stommel.vehicle.missing_table import missing_table

POSITIONS = {
    "wing_position": "wing.aerodynamic_centre_aft_m",
    "rudder_position": "rudder.aerodynamic_centre_aft_m",
}
"""Names of the paper for two fields, in hull lengths."""

Branches = NDArray[np.complex128]

_MOST_POINTS = 10_000
"""A trim, a linearisation and a validation each: some ten seconds."""


@dataclass(frozen=True)
class RootLocus:
    """Eigenvalues of both planes along one number of the design."""

    over: str
    """What was varied: a field of the vehicle file, or a name of `POSITIONS`."""
    unit: str
    values: NDArray[np.float64]
    """Values of it (N)."""
    longitudinal: Branches
    """Eigenvalues [1/s], a continuous branch a column (N x 4)."""
    lateral: Branches | None
    authorities: tuple[Authority, ...]
    design_value: float
    """Value in the vehicle file."""
    design_longitudinal: NDArray[np.complex128] | None
    """Eigenvalues at it; None if the vehicle as it stands has no such flight."""
    design_lateral: NDArray[np.complex128] | None
    speed_m_s: float
    pitch_deg: float

    def as_json(self) -> dict[str, Any]:
        """The locus in words with units, point by point."""
        lateral = self.lateral
        return {
            "over": self.over,
            "unit": self.unit,
            "speed_m_s": self.speed_m_s,
            "pitch_deg": self.pitch_deg,
            "design_value": self.design_value,
            "points": [
                {
                    "value": float(value),
                    "longitudinal": _pairs(self.longitudinal[k]),
                    "lateral": _pairs(lateral[k]) if lateral is not None else None,
                    "authority": self.authorities[k].as_row(),
                }
                for k, value in enumerate(self.values)
            ],
        }


def _pairs(eigenvalues: NDArray[np.complex128]) -> list[dict[str, float]]:
    return [{"real": float(value.real), "imag": float(value.imag)} for value in eigenvalues]


def root_locus(
    vehicle: Vehicle,
    over: str,
    start: float,
    stop: float,
    *,
    points: int = 41,
    speed_m_s: float = 0.4,
    pitch_deg: float = -35.0,
    physics: Physics = PAPER,
) -> RootLocus:
    """Follow the modes while `over` goes from `start` to `stop`.

    Parameters
    ----------
    over
        `wing_position` or `rudder_position` (in hull lengths), or the dotted key of any number of the vehicle file, in
        the file's unit.
    points
        How many values, both ends included.
    speed_m_s, pitch_deg
        The wings-level flight, trimmed anew at every value.

    Raises
    ------
    RequestError
        A number is impossible, or the vehicle lacks what is varied.
    FileError
        The field is unknown, or takes an impossible value on the way.
    UnreachableFlightError
        No such flight at some value; the message names it.
    """
    if not 2 <= points <= _MOST_POINTS:
        raise RequestError(f"points = {points}: must be at least 2 and at most {_MOST_POINTS}")
    if not (np.isfinite(start) and np.isfinite(stop)) or start == stop:
        raise RequestError(f"from {start:g} to {stop:g}: must be two different finite numbers")
    key, factor, unit = _field(vehicle, over)
    values = np.linspace(start, stop, points)
    linears = []
    for value in values:
        try:
            linears.append(_linear_at(vehicle.with_value(key, float(value) * factor), speed_m_s, pitch_deg, physics))
        except StommelError as error:
            error.args = (f"at {over} = {value:g}{f' {unit}' if unit else ''}: {error}",)
            raise
    lateral = [linear.lateral.eigenvalues() for linear in linears if linear.lateral is not None]
    design = _design(vehicle, speed_m_s, pitch_deg, physics)
    return RootLocus(
        over=over,
        unit=unit,
        values=values,
        longitudinal=_branches([linear.longitudinal.eigenvalues() for linear in linears]),
        lateral=_branches(lateral) if lateral else None,
        authorities=tuple(authority(linear) for linear in linears),
        design_value=vehicle.value(key) / factor,
        design_longitudinal=design.longitudinal.eigenvalues() if design else None,
        design_lateral=design.lateral.eigenvalues() if design and design.lateral else None,
        speed_m_s=speed_m_s,
        pitch_deg=pitch_deg,
    )


def _field(vehicle: Vehicle, over: str) -> tuple[str, float, str]:
    """Dotted key, what a value is multiplied with to give the file's unit, and the unit of values."""
    if over not in POSITIONS:
        vehicle.value(over)
        return over, 1.0, unit_of(over) or ""
    key = POSITIONS[over]
    table = key.split(".", 1)[0]
    for needed in ("hull", table):
        if getattr(vehicle.description, needed) is None:
            raise RequestError(
                f"{over}: {vehicle.name} has no table [{needed}], which it needs; {missing_table(needed)}"
            )
    assert vehicle.description.hull is not None
    return key, vehicle.description.hull.length_m, "hull lengths"


def _linear_at(vehicle: Vehicle, speed_m_s: float, pitch_deg: float, physics: Physics) -> Linearization:
    flight = trim(vehicle, speed_m_s=speed_m_s, pitch_deg=pitch_deg, physics=physics, within_limits=False)
    return linearise(vehicle, flight, physics=physics)


def _design(vehicle: Vehicle, speed_m_s: float, pitch_deg: float, physics: Physics) -> Linearization | None:
    try:
        return _linear_at(vehicle, speed_m_s, pitch_deg, physics)
    except StommelError:
        return None


def _branches(eigenvalues: Sequence[NDArray[np.complex128]]) -> Branches:
    """Order each set of eigenvalues so that every column moves least from row to row."""
    from scipy.optimize import linear_sum_assignment  # noqa: PLC0415 - slow to import, only wanted here

    rows = [np.array(sorted(eigenvalues[0], key=lambda value: (-abs(value), -value.imag)))]
    for unordered in eigenvalues[1:]:
        _, columns = linear_sum_assignment(np.abs(rows[-1][:, None] - unordered[None, :]))
        rows.append(unordered[columns])
    return np.array(rows)
