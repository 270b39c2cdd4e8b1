"""A vehicle file whose rigid body comes from its budget."""

from typing import Any

import numpy as np

from stommel.design.budget.failures import BudgetError
from stommel.design.budget.mass_properties import Tensor3
from stommel.design.budget.study import BudgetStudy
from stommel.vehicle import vehicle_from_text

NEVER_APPLIED = ("does_not_float", "does_not_sink", "does_not_rise")
"""Findings with which no file is written."""
SOURCE = "sum of [[parts]], by stommel budget"


def applied_text(study: BudgetStudy, text: str) -> str:
    """Return the text of a vehicle file with m_rb, r_rb and J_rb of its budget; all else, and comments, stay.

    Where the file's added inertia is zero, its `rigid_body.inertia_kg_m2` holds the sum with the water's. What the sum
    leaves beside the parts then becomes the added inertia, so that the sum stays what was published; where it leaves
    less than nothing, the added inertia becomes that of a spheroid.

    Parameters
    ----------
    study
        The budget of the vehicle that `text` describes.
    text
        The vehicle file.

    Raises
    ------
    BudgetError
        The vehicle does not float, sink or rise in the waters of the study, has no rigid parts, or its added inertia
        is unknown in every way.
    FileError
        The new file would be no possible vehicle.
    """
    import tomlkit  # noqa: PLC0415 - only wanted here

    origin, body = study.vehicle.origin, study.budget.rigid_body
    stuck = next((warning for warning in study.warnings if warning.name in NEVER_APPLIED), None)
    if stuck is not None:
        words = stuck.name.replace("_", " ")
        raise BudgetError(f"{origin}: a budget with which the vehicle {words} is not applied: {stuck.message}")
    if body.mass <= 0.0:
        raise BudgetError(f"{origin}: every part moves or is ballast; the rigid body would have no mass")
    document: Any = tomlkit.parse(text)
    table = tomlkit.table()
    table.add("source", SOURCE)
    table.add("mass_kg", _rounded(body.mass))
    table.add("centre_of_mass_m", [_rounded(value) for value in body.centre])
    table.add("inertia_about", "centre_of_buoyancy")
    table.add("inertia_kg_m2", _rows(body.inertia))
    table.add(tomlkit.nl())
    document["rigid_body"] = table
    if not np.any(study.vehicle.description.added_inertia.inertia_kg_m2):
        J_f, reason = _water(study)
        value = tomlkit.inline_table()
        value.update({"value": _rows(J_f), "source": reason})
        document["added_inertia"]["inertia_kg_m2"] = value
    written: str = tomlkit.dumps(document)
    vehicle_from_text(written, origin)
    return written


def _water(study: BudgetStudy) -> tuple[Tensor3, str]:
    """Added inertia that was part of the file's rigid body, and where it comes from."""
    if study.inertia.possible:
        return study.inertia.left_for_water, "the file's sum less the rigid body's parts"
    if study.inertia.spheroid is None:
        raise BudgetError(
            f"{study.vehicle.origin}: rigid_body.inertia_kg_m2 holds the sum with the water's inertia, and the parts "
            "have more than it; give added_inertia.inertia_kg_m2, or the table [hull] for an estimate"
        )
    return np.diag(study.inertia.spheroid), "spheroid of the hull's overall length and diameter, by stommel budget"


def _rows(J: Tensor3) -> list[list[float]]:
    """Symmetric to the last digit, as a vehicle file must be."""
    J = 0.5 * (J + J.T)
    return [[_rounded(value) for value in row] for row in J]


def _rounded(value: float) -> float:
    """Nine decimals: a microgram, a nanometre."""
    return round(float(value), 9) + 0.0
