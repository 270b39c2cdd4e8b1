"""What can be wrong with an ocean, or with a question to it."""

from stommel.errors import StommelError


class UnknownOceanError(StommelError):
    """Neither an analytic ocean nor a file, or an impossible parameter of one."""


class OutsideOceanError(StommelError):
    """A place or time that the ocean has no data for, and must not make up."""


class LandError(StommelError):
    """A place on land."""


class BelowBottomError(StommelError):
    """A depth below the bottom."""
