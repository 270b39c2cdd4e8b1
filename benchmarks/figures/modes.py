"""Trim and both sets of modes for a hundred thousand glides."""

import numpy as np

from figures.glides import GLIDES, speeds_and_pitches
from figures.registry import Measurement, figure
from figures.timing import seconds, summary
from figures.trim import NotTrimmedError
from stommel.dynamics.packing import pack, reference_water
from stommel.vehicle import FULL, load_vehicle

REPEATS = 3


@figure(unit="s", bar=20.0)
def trims_with_modes_100k_s() -> Measurement:
    """Measure trim, longitudinal and lateral eigenvalues of `GLIDES` glides [s]."""
    from stommel.analysis.batch import trims_with_modes  # noqa: PLC0415  # the other figures run without it

    vehicle = load_vehicle("zju")
    record, water = pack(vehicle, FULL), reference_water(vehicle)
    speeds, pitches = speeds_and_pitches()
    _, longitudinal, lateral, codes = trims_with_modes(record, speeds, pitches, water)  # compiles
    failed = int(np.count_nonzero(codes))
    if failed or not (np.isfinite(longitudinal).all() and np.isfinite(lateral).all()):
        raise NotTrimmedError(f"{failed} of {GLIDES} glides were not found, or eigenvalues are not finite")
    times = seconds(lambda: trims_with_modes(record, speeds, pitches, water), REPEATS)
    detail = summary(times, 1.0)
    return Measurement(detail["min"], detail | {"glides": GLIDES})
