"""The wall that a material needs, and what a wall stands by each criterion."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import ceil, isinf
from typing import Any, Literal

from stommel.design.hull.requirement import HullError, Requirement
from stommel.design.named_warning import NamedWarning
from stommel.machinery.hull import buckling, elasticity, end_caps, paper_formulas
from stommel.machinery.hull.materials import Material
from stommel.machinery.hull.tube import Tube

STEP_MM = 0.1
"""Walls are rounded up to this, as in Table 4."""


@dataclass(frozen=True)
class Criterion:
    """What one criterion says of a wall, without any safety factor."""

    name: str
    family: Literal["paper", "classical"]
    pressure: float
    """Pressure at which the criterion is reached [Pa]."""
    permissible: float
    """The same with the file's safety factors [Pa]."""
    lobes: int | None = None


@dataclass(frozen=True)
class SizedHull:
    """A material's walls by the paper's criteria, and the tube of one wall judged by all criteria. SI units."""

    material: Material
    requirement: Requirement
    sigma: float
    """Permissible stress [Pa]."""
    rule: str
    """Which rule gives it."""
    yield_wall: float
    circumferential_wall: float
    axial_wall: float
    tube: Tube
    """With the required wall rounded up, or with the wall that was asked."""
    axial_critical_stress: float
    """Eq. (10) [Pa] for the tube."""
    criteria: tuple[Criterion, ...]
    warnings: tuple[NamedWarning, ...]

    @property
    def exact_wall(self) -> float:
        """Wall that the paper's criteria need [m], not rounded."""
        return max(self.yield_wall, self.circumferential_wall, self.axial_wall)

    @property
    def required_wall(self) -> float:
        """The same rounded up [m]."""
        return rounded_up(self.exact_wall)

    @property
    def governed_by(self) -> str:
        """Criterion that needs the thickest wall."""
        walls = {
            paper_formulas.YIELD: self.yield_wall,
            paper_formulas.CIRCUMFERENTIAL: self.circumferential_wall,
            paper_formulas.AXIAL: self.axial_wall,
        }
        return max(walls, key=lambda name: walls[name])

    @property
    def fits(self) -> bool:
        """Whether the tube leaves the inner diameter that the file asks for."""
        D_i = self.requirement.D_i
        return D_i is None or self.tube.D_i >= D_i - 1e-9

    @property
    def collapse(self) -> Criterion:
        """Criterion that is reached first, without safety factors."""
        return min(self.criteria, key=lambda criterion: criterion.pressure)

    @property
    def limit(self) -> Criterion:
        """Criterion that limits the working depth, with safety factors."""
        return min(self.criteria, key=lambda criterion: criterion.permissible)

    def depth(self, pressure: float) -> float:
        """Depth [m] of a pressure [Pa]."""
        return pressure / self.requirement.pressure_per_metre

    def as_row(self) -> dict[str, Any]:
        """Quantities in words with units."""
        tube, P = self.tube, self.requirement.P
        return {
            "name": self.material.name,
            "title": self.material.properties.title,
            "permissible_stress_mpa": self.sigma / 1e6,
            "permissible_stress_rule": self.rule,
            "yield_wall_mm": _mm(rounded_up(self.yield_wall)),
            "yield_wall_unrounded_mm": _mm(self.yield_wall),
            "circumferential_wall_mm": self.circumferential_wall * 1e3,
            "axial_wall_mm": self.axial_wall * 1e3,
            "required_wall_mm": _mm(self.required_wall),
            "governed_by": self.governed_by,
            "wall_mm": _mm(tube.delta),
            "fits": self.fits,
            "axial_critical_stress_mpa": self.axial_critical_stress / 1e6,
            "axial_stress_mpa": P * tube.D_o**2 / (8.0 * tube.R * tube.delta) / 1e6,
            "mass_kg": tube.mass,
            "displaced_volume_l": tube.displaced_volume * 1e3,
            "compressibility_per_pa": tube.compressibility,
            "thermal_expansion_per_k": 3.0 * self.material.properties.thermal_expansion_per_k,
            "collapse_pressure_mpa": self.collapse.pressure / 1e6,
            "collapse_depth_m": self.depth(self.collapse.pressure),
            "collapse_by": self.collapse.name,
            "permissible_depth_m": self.depth(self.limit.permissible),
            "permissible_depth_by": self.limit.name,
            "criteria": [self._criterion_row(criterion) for criterion in self.criteria],
            "end_caps": self._end_caps(),
            "warnings": [warning.as_row() for warning in self.warnings],
        }

    def _criterion_row(self, criterion: Criterion) -> dict[str, Any]:
        return {
            "name": criterion.name,
            "family": criterion.family,
            "collapse_pressure_mpa": criterion.pressure / 1e6,
            "collapse_depth_m": self.depth(criterion.pressure),
            "permissible_depth_m": self.depth(criterion.permissible),
            "lobes": criterion.lobes,
        }

    def _end_caps(self) -> dict[str, float | None]:
        """Thicknesses of end caps of the same material [mm]; None where none is enough."""
        P, a, nu = self.requirement.P, 0.5 * self.tube.D_o, self.material.nu
        flat = end_caps.flat_wall_supported(P, a, self.sigma, nu)
        clamped = end_caps.flat_wall_clamped(P, a, self.sigma)
        dome = end_caps.hemisphere_wall(P, a, self.sigma, self.material.E, self.requirement.m_c)
        return {
            "flat_supported_mm": flat * 1e3,
            "flat_clamped_mm": clamped * 1e3,
            "hemisphere_mm": _mm(dome),
        }


def size(material: Material, need: Requirement, wall: float | None = None) -> SizedHull:
    """Size a hull of one material; with `wall` [m], judge that wall instead of the required one.

    Raises
    ------
    HullError
        The wall is not between zero and the radius, or no wall withstands the pressure.
    """
    sigma, rule = material.permissible_stress(need.n_y, need.n_t)
    if need.D_i is not None:
        delta_y = paper_formulas.yield_wall(need.P, need.D_i, sigma, need.phi_s, need.C)
    else:
        delta_y = paper_formulas.yield_wall_in_outer(need.P, need.D_o, sigma, need.phi_s, need.C)
    delta_bc = paper_formulas.circumferential_wall(need.P, need.D_o, need.frame_length, material.E, need.m_c)
    delta_a = paper_formulas.axial_wall(need.P, need.D_o, material.E, need.m_a)
    delta = rounded_up(max(delta_y, delta_bc, delta_a)) if wall is None else wall
    if not 0.0 < delta < 0.5 * need.D_o:
        if wall is None:
            raise HullError(
                f"{material.name}: no wall within the outer diameter of {need.D_o * 1e3:g} mm withstands "
                f"{need.P / 1e6:g} MPa with these safety factors"
            )
        raise HullError(
            f"wall = {delta * 1e3:g} mm: must be greater than 0 and less than half the outer diameter, "
            f"{need.D_o * 500:g} mm"
        )
    tube = Tube(material, need.D_o, delta, need.length)
    return SizedHull(
        material, need, sigma, rule, delta_y, delta_bc, delta_a, tube,
        axial_critical_stress=paper_formulas.axial_critical_stress(delta, tube.R, material.E, need.m_a),
        criteria=tuple(_criteria(tube, need, sigma)),
        warnings=tuple(_warnings(tube, need, delta_y, delta_bc, delta_a)),
    )  # fmt: skip


def rounded_up(wall: float) -> float:
    """A wall [m] rounded up to the next 0.1 mm."""
    if isinf(wall):
        return wall
    return ceil(wall * 1e3 / STEP_MM - 1e-9) * STEP_MM / 1e3


def _mm(wall: float) -> float | None:
    """A wall [m] in mm without the noise of binary fractions; None for an infinite one."""
    return None if isinf(wall) else round(wall * 1e3, 9)


def _criteria(tube: Tube, need: Requirement, sigma: float) -> Iterator[Criterion]:
    """Every criterion for one tube: the paper's, then the classical ones."""
    material, delta, R = tube.material, tube.delta, tube.R
    E, nu, L_f = material.E, material.nu, need.frame_length
    D_i = need.D_i if need.D_i is not None else tube.D_i

    def reached(stress: float) -> float:
        return paper_formulas.yield_pressure(delta, D_i, stress, need.phi_s, need.C)

    yield Criterion(paper_formulas.YIELD, "paper", reached(material.sigma_fail), reached(sigma))
    around = paper_formulas.circumferential_pressure(delta, need.D_o, L_f, E)
    yield Criterion(paper_formulas.CIRCUMFERENTIAL, "paper", around, around / need.m_c)
    along = paper_formulas.axial_pressure(delta, need.D_o, E)
    yield Criterion(paper_formulas.AXIAL, "paper", along, along / need.m_a)
    lobed = buckling.von_mises(delta, R, L_f, E, nu)
    yield Criterion("von Mises, n lobes", "classical", lobed.pressure, lobed.pressure / need.m_c, lobed.n)
    short = buckling.windenburg_trilling(delta, R, L_f, E, nu)
    if short < float("inf"):
        yield Criterion("Windenburg and Trilling", "classical", short, short / need.m_c)
    if need.rings is not None:
        whole = buckling.bryant(delta, R, need.L, need.rings, E)
        yield Criterion("rings and tube, Bryant", "classical", whole.pressure, whole.pressure / need.m_c, whole.n)
    strength = need.phi_s * material.sigma_fail
    bore = tube.D_i + 2.0 * min(need.C, 0.5 * delta)
    first = elasticity.tube_first_yield(bore, tube.D_o, strength)
    yield Criterion("first yield inside, Lame", "classical", first, first * sigma / material.sigma_fail)
    plastic = elasticity.tube_plastic_collapse(bore, tube.D_o, strength)
    yield Criterion("whole wall yields", "classical", plastic, plastic * sigma / material.sigma_fail)


def _warnings(tube: Tube, need: Requirement, delta_y: float, delta_bc: float, delta_a: float) -> Iterator[NamedWarning]:
    walls = {
        paper_formulas.YIELD: delta_y,
        paper_formulas.CIRCUMFERENTIAL: delta_bc,
        paper_formulas.AXIAL: delta_a,
    }
    for name, wall in walls.items():
        if tube.delta < wall - 1e-9:
            yield NamedWarning(
                "wall too thin",
                f"{tube.material.name}: wall {tube.delta * 1e3:.4g} mm is less than the {wall * 1e3:.2f} mm that "
                f"{name} needs at {need.P / 1e6:.4g} MPa",
            )
    if need.D_i is not None and tube.D_i < need.D_i - 1e-9:
        yield NamedWarning(
            "no room",
            f"{tube.material.name}: wall {tube.delta * 1e3:.4g} mm leaves {tube.D_i * 1e3:.4g} mm inside "
            f"{need.D_o * 1e3:.4g} mm; {need.D_i * 1e3:.4g} mm are wanted",
        )
    longest = buckling.critical_length(tube.delta, need.D_o)
    if need.frame_length > longest:
        yield NamedWarning(
            "long tube",
            f"{tube.material.name}: {need.frame_length:.3g} m between joints is longer than the {longest:.3g} m up "
            "to which Eq. (9) holds; trust von Mises' formula",
        )
    if tube.delta > 0.05 * tube.D_o:
        yield NamedWarning(
            "thick wall", f"{tube.material.name}: wall over 5 % of the diameter: thin-shell buckling is rough"
        )
