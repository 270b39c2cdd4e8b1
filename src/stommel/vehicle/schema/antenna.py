"""Where the antenna of position and radio sits."""

from stommel.files.fields import Point, Table


class Antenna(Table):
    """The antenna that a vehicle raises at the surface."""

    position_m: Point
    """Its tip in the body frame; one behind the centre of buoyancy is raised by lying nose down."""
