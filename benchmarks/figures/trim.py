"""Wings-level trim inside the compiled batch."""

import numpy as np

from figures.glides import GLIDES, speeds_and_pitches
from figures.registry import Measurement, figure
from figures.timing import seconds, summary
from stommel.analysis.steady_equations import CONVERGED, QUANTITIES
from stommel.analysis.wings_level import trim_many
from stommel.dynamics.packing import pack, reference_water
from stommel.vehicle import FULL, load_vehicle

REPEATS = 5
MICROSECOND = 1e-6


class NotTrimmedError(Exception):
    """A glide of the batch was not found, so that its time means nothing."""


@figure(unit="us", bar=20.0)
def trim_us() -> Measurement:
    """Measure one wings-level trim of the ZJU glider, full physics [us]."""
    vehicle = load_vehicle("zju")
    record, water = pack(vehicle, FULL), reference_water(vehicle)
    speeds, pitches = speeds_and_pitches()
    flights = np.empty((GLIDES, QUANTITIES))
    codes = trim_many(record, speeds, pitches, False, water, flights)  # compiles
    failed = int(np.count_nonzero(codes != CONVERGED))
    if failed:
        raise NotTrimmedError(f"{failed} of {GLIDES} glides were not found")
    times = seconds(lambda: trim_many(record, speeds, pitches, False, water, flights), REPEATS)
    detail = summary(times, GLIDES * MICROSECOND)
    return Measurement(detail["min"], detail | {"glides": GLIDES})
