"""Table 4 of the paper beside ours, with each difference explained or named."""

from collections.abc import Iterator
from dataclasses import dataclass
from importlib import resources
from typing import Any

from stommel.design.hull.requirement import Requirement
from stommel.design.hull.sizing import SizedHull, size_by_paper
from stommel.files.toml_reader import parse_toml
from stommel.machinery.hull import paper_formulas
from stommel.machinery.hull.materials import Material, find_material


@dataclass(frozen=True)
class ComparedQuantity:
    """One printed number of one material beside the computed one."""

    material: str
    quantity: str
    unit: str
    printed: float
    found: float
    digits: int
    """Decimals that are printed."""
    remark: str = ""

    @property
    def difference(self) -> float:
        """Computed over printed, less one."""
        return self.found / self.printed - 1.0

    @property
    def agrees(self) -> bool:
        """Whether the computed number rounds to the printed one, to one unit of its last decimal."""
        return abs(round(self.found, self.digits) - self.printed) <= 1.001 * 10.0**-self.digits

    def as_row(self) -> dict[str, Any]:
        """Quantities in words."""
        return {
            "material": self.material,
            "quantity": self.quantity,
            "unit": self.unit,
            "printed": self.printed,
            "found": self.found,
            "difference": self.difference,
            "remark": self.remark,
        }


@dataclass(frozen=True)
class PublishedTable:
    """A printed table of hulls, and the material that its authors chose."""

    source: str
    chosen: str
    rows: tuple[dict[str, Any], ...]

    def compared(self, need: Requirement, materials: tuple[Material, ...]) -> Iterator[ComparedQuantity]:
        """Compare every printed number with the one that `need` gives."""
        for row in self.rows:
            yield from _compare(size_by_paper(find_material(row["material"], materials), need), row)


def published_table(vehicle_file: str) -> PublishedTable | None:
    """Table of hulls published for the vehicle of this built-in file, if there is one."""
    table = parse_toml((resources.files(__package__) / "table4.toml").read_text(encoding="utf-8"), "table4.toml")
    if vehicle_file != table["vehicle"]:
        return None
    return PublishedTable(table["source"], table["chosen"], tuple(table["rows"]))


def _compare(hull: SizedHull, row: dict[str, Any]) -> Iterator[ComparedQuantity]:
    name, p, need = hull.material.name, hull.material.properties, hull.requirement
    tube, modulus = hull.tube, row.get("modulus_that_fits_mpa")

    def compared(quantity: str, key: str, unit: str, found: float, digits: int, remark: str = "") -> ComparedQuantity:
        return ComparedQuantity(name, quantity, unit, row[key], found, digits, remark)

    assert p.yield_stress_mpa is not None
    assert p.tensile_stress_mpa is not None
    yield compared("yield / n_y", "permissible_yield_mpa", "MPa", p.yield_stress_mpa / need.n_y, 0)
    by_tensile = p.tensile_stress_mpa / need.n_t
    digits = 0 if float(row["permissible_tensile_mpa"]).is_integer() else 1
    yield compared("tensile / n_t", "permissible_tensile_mpa", "MPa", by_tensile, digits, row.get("misprint", ""))
    yield compared("permissible stress", "permissible_stress_mpa", "MPa", hull.sigma / 1e6, 1, f"by {hull.rule}")
    yield compared("yield wall", "yield_wall_mm", "mm", hull.as_row()["yield_wall_mm"], 1, "rounded up to 0.1 mm")
    remark = "" if modulus is None else _modulus_remark(hull, modulus)
    yield compared("circumferential wall", "circumferential_wall_mm", "mm", hull.circumferential_wall * 1e3, 2, remark)
    yield compared(
        "critical stress", "axial_critical_stress_mpa", "MPa", hull.axial_critical_stress / 1e6, 2,
        "the same modulus" if modulus else f"with the wall rounded up to {tube.delta * 1e3:.1f} mm",
    )  # fmt: skip
    yield compared("mass", "mass_kg", "kg", tube.mass, 1, _mass_remark(hull, row["mass_kg"]))


def _modulus_remark(hull: SizedHull, modulus_mpa: float) -> str:
    """Both printed numbers follow from another modulus than the printed one: show it."""
    need, E = hull.requirement, modulus_mpa * 1e6
    wall = paper_formulas.circumferential_wall(need.P, need.D_o, need.frame_length, E, need.m_c)
    stress = paper_formulas.axial_critical_stress(hull.tube.delta, hull.tube.R, E, need.m_a)
    return (
        f"the paper's inconsistency: {modulus_mpa:.4g} MPa gives {wall * 1e3:.2f} mm and {stress / 1e6:.2f} MPa as "
        f"printed, but the printed modulus is {hull.material.properties.elastic_modulus_mpa:.4g} MPa"
    )


def _mass_remark(hull: SizedHull, printed: float) -> str:
    excess = printed / hull.tube.mass - 1.0
    return (
        f"printed mass is {100 * excess:.1f} % above a plain tube, as {1e3 * excess * hull.tube.length:.0f} mm more "
        "length would be; end rings are not described"
    )
