"""Root locus: modes along one design parameter."""

from figures.registry import Measurement, figure
from figures.timing import seconds, summary
from stommel.vehicle import load_vehicle

POINTS = 200
REPEATS = 5


@figure(unit="s", bar=0.3)
def root_locus_200_s() -> Measurement:
    """Measure a root locus of the wing's position over `POINTS` points [s]."""
    from stommel.analysis import root_locus  # noqa: PLC0415  # the other figures run without it

    vehicle = load_vehicle("zju")

    def locus() -> object:
        return root_locus(vehicle, "wing_position", 0.0, 0.2, points=POINTS, speed_m_s=0.4, pitch_deg=-35.0)

    locus()  # compiles
    detail = summary(seconds(locus, REPEATS), 1.0)
    return Measurement(detail["min"], detail | {"points": POINTS})
