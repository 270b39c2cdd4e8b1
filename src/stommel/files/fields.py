"""What the tables of a vehicle file are made of: points, tensors, intervals; numbers without a range of their own."""

from typing import Annotated, Any

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field

from stommel.files.ranges import Coordinate, Inertia

Finite = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Point = tuple[Coordinate, Coordinate, Coordinate]
Row = tuple[Inertia, Inertia, Inertia]
Matrix3 = tuple[Row, Row, Row]

Name = Annotated[str, Field(min_length=1, max_length=80)]
"""Of a part, a bay, a column, a mission; long enough to say what it is, short enough for a message."""

ZERO_MATRIX: Matrix3 = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def _as_matrix(value: Any) -> Any:
    """Take [xx, yy, zz] for a diagonal matrix."""
    if isinstance(value, list | tuple) and len(value) == 3 and all(isinstance(v, int | float) for v in value):
        xx, yy, zz = value
        return ((xx, 0.0, 0.0), (0.0, yy, 0.0), (0.0, 0.0, zz))
    return value


Tensor = Annotated[Matrix3, BeforeValidator(_as_matrix)]
"""Symmetric 3 x 3 tensor: [xx, yy, zz], or three rows."""


class Table(BaseModel):
    """A table of a vehicle file."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=False, defer_build=True)


def ordered(name: str, interval: tuple[float, float]) -> None:
    """Refuse an interval whose ends are swapped."""
    if not interval[0] < interval[1]:
        raise ValueError(f"{name} = {list(interval)}: the first number must be less than the second")
