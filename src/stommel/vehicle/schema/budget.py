"""Parts of the vehicle with their masses, volumes and places, and where they do not fit."""

from collections.abc import Iterator, Sequence
from math import hypot
from typing import Annotated, Self

from pydantic import model_validator

from stommel.files.fields import Name, Point, Table
from stommel.files.ranges import PartSize, ZeroOr
from stommel.vehicle.schema.hull import Bay, Hull

TOLERANCE_M = 1e-6
"""Parts that end where their bay ends are inside it."""


class Part(Table):
    """One entry of the mass and volume budget. Without dimensions it is a point."""

    name: Name
    """What it is; no two parts share a name."""
    bay: Name
    """Name of the bay that it belongs to."""
    mass_kg: Annotated[float, ZeroOr(0.001, 1000)]
    """Mass."""
    volume_ml: Annotated[float, ZeroOr(0.1, 1e6)] = 0.0
    """Water that it displaces by itself. A dry part displaces none: the hull around it does."""
    position_m: Point
    """Its centre, of mass and of volume alike; a moving part's with the moving mass at neutral."""
    moving: bool = False
    """Whether it belongs to the moving mass."""
    ballast: bool = False
    """Whether it belongs to the ballast system; its volume is that of neutral ballast."""
    trim_weight: bool = False
    """Whether it is there for trim alone, so that some or all of it may be taken out."""
    box_mm: tuple[PartSize, PartSize, PartSize] | None = None
    """Length, width and height of a homogeneous box."""
    length_mm: PartSize | None = None
    """Length of a homogeneous cylinder along the hull; with `diameter_mm`."""
    diameter_mm: PartSize | None = None
    """Diameter of that cylinder."""
    inner_diameter_mm: Annotated[float, ZeroOr(0.5, 10000)] = 0.0
    """Of a cylinder that is hollow."""

    @property
    def volume_m3(self) -> float:
        """Displaced volume in cubic metres."""
        return self.volume_ml / 1e6

    @property
    def wet(self) -> bool:
        """Whether water touches it."""
        return self.volume_ml > 0.0

    @property
    def length_m(self) -> float:
        """Extent along the hull in metres; 0 for a point."""
        if self.box_mm is not None:
            return self.box_mm[0] / 1e3
        return (self.length_mm or 0.0) / 1e3

    @model_validator(mode="after")
    def _is_one_thing(self) -> Self:
        if self.moving and self.ballast:
            raise ValueError(f"{self.name!r}: is either moving or ballast, not both")
        if self.trim_weight and (self.moving or self.ballast or self.wet):
            raise ValueError(f"{self.name!r}: a trim weight is dry and neither moving nor ballast")
        if (self.length_mm is None) != (self.diameter_mm is None):
            raise ValueError(f"{self.name!r}: length_mm and diameter_mm go together")
        if self.box_mm is not None and self.length_mm is not None:
            raise ValueError(f"{self.name!r}: is either a box (box_mm) or a cylinder (length_mm, diameter_mm)")
        if self.inner_diameter_mm and self.inner_diameter_mm >= (self.diameter_mm or 0.0):
            raise ValueError(
                f"{self.name!r}: inner_diameter_mm = {self.inner_diameter_mm:g}: must be less than diameter_mm"
            )
        return self


def part_problems(parts: Sequence[Part], bays: Sequence[Bay], hull: Hull | None) -> Iterator[tuple[str, str]]:
    """Yield (key, what is wrong and what is allowed) for parts that share a name, lack a bay or do not fit."""
    by_name = {bay.name: bay for bay in bays}
    seen: set[str] = set()
    for k, part in enumerate(parts):
        where = f"parts.{k}"
        if part.name in seen:
            yield f"{where}.name", f"{where}.name = {part.name!r}: another part has this name; names must differ"
        seen.add(part.name)
        bay = by_name.get(part.bay)
        if bay is None:
            known = ", ".join(repr(name) for name in by_name) or "none"
            yield f"{where}.bay", f"{where}.bay = {part.bay!r}: {part.name!r} is in an unknown bay; known bays: {known}"
            continue
        yield from _outside_bay(where, part, bay)
        if hull is not None and not bay.flooded and not part.wet:
            yield from _outside_wall(where, part, hull)


def _outside_bay(where: str, part: Part, bay: Bay) -> Iterator[tuple[str, str]]:
    x, half = part.position_m[0], 0.5 * part.length_m
    if x - half < bay.to_m - TOLERANCE_M or x + half > bay.from_m + TOLERANCE_M:
        reach = f"{x:g} m" if half == 0.0 else f"{x - half:g} to {x + half:g} m"
        yield (
            f"{where}.position_m",
            f"{where}.position_m: {part.name!r} at {reach} is outside its bay {part.bay!r}, which reaches from "
            f"{bay.to_m:g} to {bay.from_m:g} m",
        )


def _outside_wall(where: str, part: Part, hull: Hull) -> Iterator[tuple[str, str]]:
    """A dry part in a sealed bay lies within the hull's inner radius (its outer one where no wall is given)."""
    radius = (hull.inner_diameter_mm or hull.outer_diameter_mm) / 2e3
    _, y, z = part.position_m
    if part.box_mm is not None:
        reach = hypot(abs(y) + part.box_mm[1] / 2e3, abs(z) + part.box_mm[2] / 2e3)
    else:
        reach = hypot(y, z) + (part.diameter_mm or 0.0) / 2e3
    if reach > radius + TOLERANCE_M:
        yield (
            f"{where}.position_m",
            f"{where}.position_m: {part.name!r} reaches {reach:.4g} m off the axis, outside the hull, whose inner "
            f"radius is {radius:g} m",
        )
