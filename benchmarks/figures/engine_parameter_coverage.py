"""Whether the stated intervals of a fit to a bench log hold what they promise."""

import math

from figures.registry import Measurement, figure
from stommel.vehicle import load_vehicle

SEEDS = 200


@figure(unit="share", bar=0.9, at_least=True)
def engine_parameter_coverage() -> Measurement:
    """Measure in which share of logs from `SEEDS` seeds all true constants lie inside their stated 95 % intervals.

    The detail has the share of each constant, and of its interval for one constant alone, which should be 0.95.
    """
    from stommel.bench import bench_engine, fit_engine, generate_log, performance  # noqa: PLC0415  # noqa: PLC0415

    engine = bench_engine(load_vehicle("zju"))
    inside: dict[str, int] = {}
    alone: dict[str, int] = {}
    together = 0
    for seed in range(SEEDS):
        log = generate_log(engine, seed)
        fit = fit_engine(performance(log, engine.piston_area_m2, engine), engine, true=log.true_parameters)
        hits = []
        for one in fit.parameters:
            true = one.true if one.true is not None else math.nan
            hits.append(one.low <= true <= one.high)
            inside[one.name] = inside.get(one.name, 0) + hits[-1]
            alone[one.name] = alone.get(one.name, 0) + (one.alone[0] <= true <= one.alone[1])
        together += all(hits)
    detail = {
        "seeds": SEEDS,
        "inside": {name: count / SEEDS for name, count in inside.items()},
        "inside_alone": {name: count / SEEDS for name, count in alone.items()},
        "of_all_intervals": sum(inside.values()) / (SEEDS * len(inside)),
    }
    return Measurement(together / SEEDS, detail)
