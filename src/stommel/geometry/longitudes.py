"""The one way in which longitudes are written: above -180 and up to 180."""

from math import ceil


def wrapped_deg(longitude: float) -> float:
    """The same meridian, above -180 and up to 180 [deg]."""
    return longitude - 360.0 * ceil((longitude - 180.0) / 360.0)
