"""Why a drive cannot be computed."""

from stommel.errors import StommelError


class DriveError(StommelError):
    """The vehicle file lacks what a drive needs, or a question about it is impossible."""
