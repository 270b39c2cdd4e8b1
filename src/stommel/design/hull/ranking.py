"""Which material first, and why."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib import resources
from math import prod

from stommel.design.hull.sizing import SizedHull
from stommel.files.toml_reader import parse_toml


@dataclass(frozen=True)
class Ranked:
    """A material's place in the choice."""

    hull: SizedHull
    place: int
    score: float
    marks: Mapping[str, float]
    """Mark in each criterion, 0 to 1."""
    reasons: tuple[str, ...]

    def as_row(self) -> dict[str, object]:
        """Quantities in words."""
        return {
            "name": self.hull.material.name,
            "place": self.place,
            "score": self.score,
            "marks": dict(self.marks),
            "reasons": list(self.reasons),
        }


@cache
def weights() -> dict[str, float]:
    """Weight of each criterion, from ranking.toml."""
    text = (resources.files(__package__) / "ranking.toml").read_text(encoding="utf-8")
    found: dict[str, float] = parse_toml(text, "ranking.toml")["weights"]
    return found


def ranked(hulls: Sequence[SizedHull], weigh: Mapping[str, float] | None = None) -> tuple[Ranked, ...]:
    """Rank hulls: first those whose wall fits and meets every criterion, by score; then the others, by score."""
    weigh = weights() if weigh is None else weigh
    least_wall = min(hull.tube.delta for hull in hulls)
    least_mass = min(hull.tube.mass for hull in hulls)
    rows = []
    for hull in hulls:
        p = hull.material.properties
        marks = {
            "wall": least_wall / hull.tube.delta,
            "mass": least_mass / hull.tube.mass,
            "corrosion": (p.corrosion_grade + 1) / 5,
            "machinability": (p.machinability_grade + 1) / 5,
        }
        rows.append((_usable(hull), prod(marks[name] ** weight for name, weight in weigh.items()), hull, marks))
    rows.sort(key=lambda row: (not row[0], -row[1]))
    return tuple(
        Ranked(hull, place, score, marks, tuple(_reasons(hull, marks)))
        for place, (_, score, hull, marks) in enumerate(rows, start=1)
    )


def _usable(hull: SizedHull) -> bool:
    return hull.fits and not hull.failed and hull.tube.delta >= hull.exact_wall - 1e-9


def _reasons(hull: SizedHull, marks: Mapping[str, float]) -> list[str]:
    """What speaks for and against a material, in words."""
    p = hull.material.properties
    reasons = []
    for name, quantity, unit in (("wall", hull.tube.delta * 1e3, "mm"), ("mass", hull.tube.mass, "kg")):
        share = 1.0 / marks[name]
        words = f"least {name}" if share < 1.0 + 1e-9 else f"{name} {share:.2f} times the least"
        reasons.append(f"{words} ({quantity:.1f} {unit})")
    if hull.failed:
        reasons.append(f"fails {_listed(hull.failed)} at {hull.requirement.frame_length:g} m")
    if hull.raised_for:
        reasons.append(
            f"raised to {hull.tube.delta * 1e3:.1f} mm: the {hull.required_wall * 1e3:.1f} mm of Eqs. (8) to (10) fail "
            f"{_listed(hull.raised_for)} at {hull.requirement.frame_length:g} m"
        )
    reasons += [f"corrosion: {p.corrosion}", f"machining: {p.machinability}"]
    if not hull.fits:
        reasons.append(f"its wall leaves {hull.tube.D_i * 1e3:.1f} mm inside, less than the file wants")
    if p.remark:
        reasons.append(p.remark)
    return reasons


def _listed(criteria: Sequence[str]) -> str:
    return " and ".join(criteria)
