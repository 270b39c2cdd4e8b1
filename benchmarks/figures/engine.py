"""Buoyancy engine: simulation of one full stroke."""

from figures.registry import Measurement, figure
from figures.timing import seconds, summary
from stommel.vehicle import load_vehicle

REPEATS = 20
MILLISECOND = 1e-3


class NotInflatedError(Exception):
    """The stroke was not completed, so that its time means nothing."""


@figure(unit="ms", bar=50.0)
def engine_stroke_ms() -> Measurement:
    """Measure the simulation of an inflation over the whole working range at 2 MPa [ms]."""
    from stommel.machinery.engine import Outcome, engine_of, simulate  # noqa: PLC0415  # the other figures run without it

    engine = engine_of(load_vehicle("zju")).engine
    volume = engine.measured_piston.working_volume_ml / 1e6

    def stroke() -> Outcome:
        return simulate(engine, pressure_pa=2e6, inflate_m3=volume).phases[0].outcome

    if stroke() is not Outcome.REACHED:  # compiles
        raise NotInflatedError
    detail = summary(seconds(stroke, REPEATS), MILLISECOND)
    return Measurement(detail["min"], detail | {"volume_ml": volume * 1e6})
