"""Tables of a configuration that have a key for each phase of the dive."""

from typing import Annotated, Literal

from stommel.files.fields import Table
from stommel.files.ranges import between

Interval = Annotated[float, between(0.1, 3600)]
DecisionInterval = Annotated[float, between(0.1, 60)]
PhaseName = Literal["surface", "descent", "inflection", "ascent", "recovery", "drift"]


class Decisions(Table):
    """Time between two decisions by phase of the dive [s]; in between the controller sleeps, and danger wakes it.

    Control was written for decisions each second; what turns or brings up the vehicle should not be slower.
    """

    surface: DecisionInterval = 1.0
    """At the surface, with position and radio."""
    descent: DecisionInterval = 1.0
    """Going down."""
    inflection: DecisionInterval = 1.0
    """Turning at the depth of the dive."""
    ascent: DecisionInterval = 1.0
    """Coming up."""
    recovery: DecisionInterval = 1.0
    """At the surface after the mission, calling."""
    drift: DecisionInterval = 1.0
    """Hanging in the water."""


class Samples(Table):
    """Time between two samples of the CTD by phase of the dive [s], where it is another than `sample_every_s`.

    The mission says in which phases it samples at all.
    """

    surface: Interval | None = None
    """At the surface."""
    descent: Interval | None = None
    """On the way down."""
    inflection: Interval | None = None
    """While it turns."""
    ascent: Interval | None = None
    """On the way up."""
    recovery: Interval | None = None
    """At the surface after the mission."""
    drift: Interval | None = None
    """While it hangs in the water."""
