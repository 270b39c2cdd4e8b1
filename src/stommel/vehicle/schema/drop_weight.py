"""The last way up: a weight that is let go."""

from typing import Annotated

from stommel.files.fields import Table
from stommel.files.ranges import between


class DropWeight(Table):
    """A weight that the vehicle can let go once, to come up without its buoyancy engine."""

    mass_in_water_kg: Annotated[float, between(0.01, 200)]
    """By how much lighter the vehicle is in water without it."""
