"""Everything that is asked of a vehicle's pressure hull, in one value for terminal, report and scripts."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from stommel.design.hull.comparison import ComparedQuantity, PublishedTable, published_table
from stommel.design.hull.ranking import Ranked, ranked
from stommel.design.hull.requirement import HullError, Requirement, requirement
from stommel.design.hull.sizing import SizedHull, size
from stommel.design.named_warning import NamedWarning
from stommel.machinery.hull.materials import Material, MaterialError, find_material, load_materials
from stommel.vehicle import Vehicle

_ROUGHLY = 0.1
"""Relative difference of the file's compressibility from the computed one that is worth a warning."""


@dataclass(frozen=True)
class HullStudy:
    """Hulls of every material, their ranking, the vehicle's own hull, and Table 4 where it applies."""

    vehicle: Vehicle
    requirement: Requirement
    hulls: tuple[SizedHull, ...]
    """In the order of the ranking."""
    ranking: tuple[Ranked, ...]
    own: SizedHull | None
    """The hull of the vehicle file; None if the file has no material and wall."""
    published: tuple[ComparedQuantity, ...]
    """Printed numbers beside computed ones, where any were printed for this vehicle."""
    choice: str
    """Whether the ranking agrees with the published choice; empty where there is none."""
    warnings: tuple[NamedWarning, ...]

    def as_json(self) -> dict[str, Any]:
        """Quantities in words with units."""
        need = self.requirement
        places = {row.hull.material.name: row for row in self.ranking}
        return {
            "vehicle": self.vehicle.name,
            "pressure_mpa": need.P / 1e6,
            "depth_m": need.depth,
            "knock_down": need.knock_down,
            "outer_diameter_mm": need.D_o * 1e3,
            "inner_diameter_mm": None if need.D_i is None else need.D_i * 1e3,
            "checked_length_m": need.L,
            "length_m": need.length,
            "materials": [
                hull.as_row()
                | {
                    "rank": places[hull.material.name].place,
                    "score": places[hull.material.name].score,
                    "reasons": list(places[hull.material.name].reasons),
                }
                for hull in self.hulls
            ],
            "own": self.own.as_row() if self.own is not None else None,
            "published": [row.as_row() for row in self.published],
            "warnings": [warning.as_row() for warning in self.warnings],
            "choice": self.choice,
            "notes": list(need.notes),
        }


def hull_study(
    vehicle: Vehicle,
    *,
    materials: Sequence[str] | None = None,
    depth_m: float | None = None,
    pressure_mpa: float | None = None,
    wall_mm: float | None = None,
    knock_down: float | None = None,
    materials_file: Path | None = None,
) -> HullStudy:
    """Size a vehicle's hull in each material, rank them, and judge the hull that the file describes.

    Parameters
    ----------
    vehicle
        The glider; its table [hull] gives sizes, loads and safety factors.
    materials
        Names; every known material if left out.
    depth_m, pressure_mpa
        Working depth [m] or pressure [MPa] instead of the file's.
    wall_mm
        Wall to judge in every material instead of the one each needs [mm].
    knock_down
        Share of a perfect tube's buckling pressure that imperfections leave, instead of the file's [1].
    materials_file
        A TOML file of further materials.

    Raises
    ------
    HullError
        The vehicle has no hull, or depth, pressure, wall or knock-down are impossible.
    MaterialError
        A name that no table has.
    FileError
        The file of materials is not one.
    """
    need = requirement(vehicle, depth_m=depth_m, pressure_mpa=pressure_mpa, knock_down=knock_down)
    known = load_materials(materials_file)
    chosen = known if not materials else _distinct(find_material(name, known) for name in materials)
    wall = wall_mm / 1e3 if wall_mm is not None else None
    sized, warnings = _sized(chosen, need, wall)
    ranking = ranked(sized)
    own, own_warnings = _own(vehicle, need, known)
    hulls = tuple(row.hull for row in ranking)
    if wall is not None:
        warnings += [warning for hull in hulls for warning in hull.warnings]
    table = published_table(vehicle.origin)
    names = {material.name for material in chosen}
    published = tuple(table.compared(requirement(vehicle, knock_down=1.0), known)) if table is not None else ()
    return HullStudy(
        vehicle, need, hulls, ranking, own,
        published=tuple(row for row in published if row.material in names),
        choice=_choice(table, ranking) if table is not None else "",
        warnings=tuple(dict.fromkeys([*own_warnings, *warnings])),
    )  # fmt: skip


def _sized(
    chosen: Sequence[Material], need: Requirement, wall: float | None
) -> tuple[list[SizedHull], list[NamedWarning]]:
    """Hulls of all materials that can be built at all; the others as warnings, unless it is every one."""
    sized, warnings, last = [], [], None
    for material in chosen:
        try:
            sized.append(size(material, need, wall))
        except HullError as error:
            warnings.append(NamedWarning("no wall", str(error)))
            last = error
    if not sized and last is not None:
        raise last
    return sized, warnings


def _choice(table: PublishedTable, ranking: Sequence[Ranked]) -> str:
    """Whether the authors' choice comes first among their own materials."""
    theirs = [row["material"] for row in table.rows]
    order = [row for row in ranking if row.hull.material.name in theirs]
    if len(order) < len(theirs):
        return ""
    places = ", ".join(f"{row.hull.material.name} {row.score:.3f}" for row in order)
    verdict = "as the paper chose" if order[0].hull.material.name == table.chosen else f"the paper chose {table.chosen}"
    unfit = [row.hull.material.name for row in order if not row.hull.fits]
    words = f"of the paper's materials {order[0].hull.material.name} comes first, {verdict} (scores: {places})"
    return words + (f"; {', '.join(unfit)} takes more wall than the paper's diameters leave" if unfit else "")


def _distinct(materials: Iterator[Material]) -> tuple[Material, ...]:
    return tuple({material.name: material for material in materials}.values())


def _own(
    vehicle: Vehicle, need: Requirement, known: tuple[Material, ...]
) -> tuple[SizedHull | None, tuple[NamedWarning, ...]]:
    """The hull of the vehicle file, and what is wrong with it."""
    hull = vehicle.description.hull
    assert hull is not None  # the requirement would not be there
    if hull.material is None or hull.wall_mm is None:
        return None, ()
    try:
        material = find_material(hull.material, known)
    except MaterialError as error:
        return None, (NamedWarning("unknown material", f"hull.material is not judged: {error}"),)
    own = size(material, need, hull.wall_mm / 1e3)
    return own, (*own.warnings, *_own_warnings(own, vehicle))


def _own_warnings(own: SizedHull, vehicle: Vehicle) -> Iterator[NamedWarning]:
    hull = vehicle.description.hull
    assert hull is not None
    if hull.inner_diameter_mm is not None and hull.wall_mm is not None:
        outer = hull.inner_diameter_mm + 2.0 * hull.wall_mm
        if abs(outer - hull.outer_diameter_mm) > 0.05:
            yield NamedWarning(
                "diameters and wall disagree",
                f"inner diameter {hull.inner_diameter_mm:g} mm with a wall of {hull.wall_mm:g} mm makes {outer:g} mm "
                f"outside; the file says {hull.outer_diameter_mm:g} mm. Walls are taken inward from the outer diameter",
            )
    kappa = own.tube.compressibility
    if hull.compressibility_per_pa > 0.0 and abs(hull.compressibility_per_pa / kappa - 1.0) > _ROUGHLY:
        yield NamedWarning(
            "compressibility",
            f"hull.compressibility_per_pa is {hull.compressibility_per_pa:.3g} in the file; the tube gives "
            f"{kappa:.3g} 1/Pa",
        )
