"""All cross-checks of a vehicle file in one list, and what they found."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

from stommel.design.budget import budget_study
from stommel.design.checking.battery import voltages
from stommel.design.checking.engine import engine_agreement
from stommel.design.checking.lateral import lateral_plane
from stommel.design.checking.sizes import depths, sizes
from stommel.design.checking.travel import travels
from stommel.design.drives import drive_study
from stommel.design.hull import hull_study
from stommel.design.named_warning import NamedWarning
from stommel.errors import StommelError
from stommel.vehicle import Vehicle
from stommel.vehicle.plausible import implausible


def hull_strength(vehicle: Vehicle) -> Iterable[NamedWarning]:
    """The hull of the file against its rated depth, by every criterion."""
    hull = vehicle.description.hull
    if hull is None or (hull.depth_rating_m is None and hull.design_pressure_mpa is None):
        return ()
    return hull_study(vehicle).warnings


def drive_speeds(vehicle: Vehicle) -> Iterable[NamedWarning]:
    """What the drives can do against what the file says that they do."""
    drives = vehicle.description.drives
    if drives is None or (drives.pitch is None and drives.rudder is None):
        return ()
    return drive_study(vehicle).warnings


def masses(vehicle: Vehicle) -> Iterable[NamedWarning]:
    """The sum of the parts against the masses, places and inertia of the file, and against floating and sinking."""
    d = vehicle.description
    return () if not d.parts or d.hull is None else budget_study(vehicle).warnings


def fitting(vehicle: Vehicle) -> Iterable[NamedWarning]:
    """Numbers that are possible each by itself and do not fit each other."""
    return (NamedWarning("implausible", sentence) for _, sentence in implausible(vehicle.description))


Check = Callable[[Vehicle], Iterable[NamedWarning]]

CHECKS: tuple[Check, ...] = (
    sizes,
    depths,
    masses,
    hull_strength,
    engine_agreement,
    travels,
    drive_speeds,
    voltages,
    lateral_plane,
    fitting,
)
"""Every cross-check; a new one is added here. A check of parts that a vehicle lacks finds nothing."""

ERRORS = frozenset(
    {
        "does_not_float",
        "does_not_sink",
        "does_not_rise",
        "top_heavy",
        "no_place_to_trim",
        "wall too thin",
        "classical criterion not met",
        "depth_beyond_rating",
        "engine_volume_short",
        "engine_stalls",
        "switch_within_travel",
        "cannot_start",
        "over_run",
        "rudder_stalls",
    }
)
"""Findings with which the vehicle cannot be built or flown as its file says; all others are contradictions."""


@dataclass(frozen=True)
class CrossCheck:
    """What all cross-checks found in a vehicle file."""

    vehicle: Vehicle
    errors: tuple[NamedWarning, ...]
    warnings: tuple[NamedWarning, ...]

    def as_row(self) -> dict[str, Any]:
        """Both numbers and the command that lists the findings, for answers that only point here."""
        return {
            "errors": len(self.errors),
            "warnings": len(self.warnings),
            "command": f"stommel vehicle check {self.vehicle.builtin or self.vehicle.origin}",
        }


def cross_check(vehicle: Vehicle) -> CrossCheck:
    """Run every cross-check on a vehicle.

    A check that cannot be made, because a study refuses the vehicle, is itself a finding.
    """
    found: list[NamedWarning] = []
    for check in CHECKS:
        try:
            found += check(vehicle)
        except StommelError as error:
            found.append(NamedWarning("cannot_be_checked", f"{check.__name__.replace('_', ' ')}: {error}"))
    found = list(dict.fromkeys(found))
    return CrossCheck(
        vehicle,
        tuple(finding for finding in found if finding.name in ERRORS),
        tuple(finding for finding in found if finding.name not in ERRORS),
    )
