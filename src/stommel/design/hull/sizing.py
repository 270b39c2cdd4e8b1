"""The wall that a material needs, and what a wall stands by each criterion."""

from bisect import bisect_left
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
    """With the least wall that meets every criterion, rounded up, or with the wall that was asked."""
    axial_critical_stress: float
    """Eq. (10) [Pa] for the tube."""
    criteria: tuple[Criterion, ...]
    raised_for: tuple[str, ...]
    """Criteria that the paper's wall does not meet at the checked length, for which the tube has a thicker one."""
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
    def failed(self) -> tuple[str, ...]:
        """Criteria that the tube does not meet with the file's safety factors."""
        return _failed(self.criteria, self.requirement.P)

    @property
    def governed_by(self) -> str:
        """Criterion of the paper that needs the thickest wall."""
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
            "raised_for": list(self.raised_for),
            "fails": list(self.failed),
            "knock_down": self.requirement.knock_down,
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
    """Size a hull of one material: the least wall, in steps of 0.1 mm, that meets the paper's and all other criteria.

    With `wall` [m], judge that wall instead.

    Raises
    ------
    HullError
        The wall is not between zero and the radius, or no wall withstands the pressure.
    """
    sigma, rule = material.permissible_stress(need.n_y, need.n_t)
    delta_y, delta_bc, delta_a = walls = _paper_walls(material, need, sigma)
    raised_for: tuple[str, ...] = ()
    if wall is None:
        delta, raised_for = _sufficient(material, need, sigma, rounded_up(max(walls)))
    elif 0.0 < wall < 0.5 * need.D_o:
        delta = wall
    else:
        raise HullError(
            f"wall = {wall * 1e3:g} mm: must be greater than 0 and less than half the outer diameter, "
            f"{need.D_o * 500:g} mm"
        )
    tube = Tube(material, need.D_o, delta, need.length)
    criteria = tuple(_criteria(tube, need, sigma))
    return SizedHull(
        material, need, sigma, rule, delta_y, delta_bc, delta_a, tube,
        axial_critical_stress=paper_formulas.axial_critical_stress(delta, tube.R, material.E, need.m_a),
        criteria=criteria, raised_for=raised_for,
        warnings=(*_warnings(tube, need, walls), *_classical_warnings(tube, need, criteria)),
    )  # fmt: skip


def size_by_paper(material: Material, need: Requirement) -> SizedHull:
    """Size a hull as the paper does: the wall of Eqs. (8) to (10), whatever the other criteria say of it."""
    sigma, _ = material.permissible_stress(need.n_y, need.n_t)
    return size(material, need, rounded_up(max(_paper_walls(material, need, sigma))))


def _paper_walls(material: Material, need: Requirement, sigma: float) -> tuple[float, float, float]:
    """Walls [m] by Eqs. (8), (9) and (10)."""
    if need.D_i is not None:
        delta_y = paper_formulas.yield_wall(need.P, need.D_i, sigma, need.phi_s, need.C)
    else:
        delta_y = paper_formulas.yield_wall_in_outer(need.P, need.D_o, sigma, need.phi_s, need.C)
    m_c = need.m_c / need.knock_down
    delta_bc = paper_formulas.circumferential_wall(need.P, need.D_o, need.frame_length, material.E, m_c)
    return delta_y, delta_bc, paper_formulas.axial_wall(need.P, need.D_o, material.E, need.m_a)


def _sufficient(material: Material, need: Requirement, sigma: float, paper: float) -> tuple[float, tuple[str, ...]]:
    """Least wall [m] from the paper's up that meets every criterion, and the criteria that the paper's one fails."""

    def failed(steps: int) -> tuple[str, ...]:
        tube = Tube(material, need.D_o, steps * STEP_MM / 1e3, need.length)
        return _failed(tuple(_criteria(tube, need, sigma)), need.P)

    most = ceil(0.5 * need.D_o * 1e3 / STEP_MM - 1e-9)  # the first that leaves no bore
    first = most if isinf(paper) else round(paper * 1e3 / STEP_MM)
    # every criterion grows with the wall
    steps = bisect_left(range(most), True, lo=min(first, most), key=lambda n: not failed(n))
    if steps >= most:
        raise HullError(
            f"{material.name}: no wall within the outer diameter of {need.D_o * 1e3:g} mm withstands "
            f"{need.P / 1e6:g} MPa with these safety factors"
        )
    return steps * STEP_MM / 1e3, failed(first) if steps > first else ()


def _failed(criteria: tuple[Criterion, ...], P: float) -> tuple[str, ...]:
    """Names of the criteria that are not met at a working pressure [Pa]."""
    return tuple(criterion.name for criterion in criteria if criterion.permissible < P * (1.0 - 1e-9))


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
    around = need.knock_down * paper_formulas.circumferential_pressure(delta, need.D_o, L_f, E)
    yield Criterion(paper_formulas.CIRCUMFERENTIAL, "paper", around, around / need.m_c)
    along = paper_formulas.axial_pressure(delta, need.D_o, E)
    yield Criterion(paper_formulas.AXIAL, "paper", along, along / need.m_a)
    lobed = buckling.von_mises(delta, R, L_f, E, nu)
    kept = need.knock_down * lobed.pressure
    yield Criterion("von Mises, n lobes", "classical", kept, kept / need.m_c, lobed.n)
    short = need.knock_down * buckling.windenburg_trilling(delta, R, L_f, E, nu)
    if short < float("inf"):
        yield Criterion("Windenburg and Trilling", "classical", short, short / need.m_c)
    if need.rings is not None:
        whole = buckling.bryant(delta, R, need.L, need.rings, E)
        kept = need.knock_down * whole.pressure
        yield Criterion("rings and tube, Bryant", "classical", kept, kept / need.m_c, whole.n)
    strength = need.phi_s * material.sigma_fail
    bore = tube.D_i + 2.0 * min(need.C, 0.5 * delta)
    first = elasticity.tube_first_yield(bore, tube.D_o, strength)
    yield Criterion("first yield inside, Lame", "classical", first, first * sigma / material.sigma_fail)
    plastic = elasticity.tube_plastic_collapse(bore, tube.D_o, strength)
    yield Criterion("whole wall yields", "classical", plastic, plastic * sigma / material.sigma_fail)


def _warnings(tube: Tube, need: Requirement, walls: tuple[float, float, float]) -> Iterator[NamedWarning]:
    names = (paper_formulas.YIELD, paper_formulas.CIRCUMFERENTIAL, paper_formulas.AXIAL)
    for name, wall in zip(names, walls, strict=True):
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


def _classical_warnings(tube: Tube, need: Requirement, criteria: tuple[Criterion, ...]) -> Iterator[NamedWarning]:
    for criterion in criteria:
        if criterion.family == "classical" and criterion.permissible < need.P * (1.0 - 1e-9):
            yield NamedWarning(
                "classical criterion not met",
                f"{tube.material.name}, wall {tube.delta * 1e3:.4g} mm: {criterion.name} gives "
                f"{criterion.pressure / 1e6:.3g} MPa, which leaves less than the file's safety factor at "
                f"{need.P / 1e6:.4g} MPa",
            )
