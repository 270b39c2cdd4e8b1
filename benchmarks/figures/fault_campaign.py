"""How fast missions with random faults are flown through the whole software."""

import tempfile
from dataclasses import replace
from pathlib import Path
from time import perf_counter

from figures.registry import Measurement, figure
from stommel.sitl.campaign.kit import fly_seed
from stommel.sitl.campaign.run import TRIAL, load_kit, run_campaign
from stommel.studies.running import cores

SEEDS = range(1, 9)


@figure(unit="1/min", bar=8.0, at_least=True)
def sitl_campaign_missions_per_minute() -> Measurement:
    """Missions of two hours with random faults a minute, on all cores, shrinking of failures included.

    At a thousand times real time on each of two cores it would be 17; workers' start is counted, compiling is not.
    """
    kit = load_kit(TRIAL)
    fly_seed(replace(kit, document={**kit.document, "duration_days": 0.001}, origin="first"), 0, (1,))  # compiles
    with tempfile.TemporaryDirectory() as folder:
        began = perf_counter()
        done = run_campaign(kit, Path(folder) / "campaign", SEEDS)
        seconds = perf_counter() - began
    verdicts = [record["verdict"] for record in done.records]
    detail = {"missions": len(verdicts), "cores": cores(), "wall_s": seconds}
    counts = {verdict: verdicts.count(verdict) for verdict in sorted(set(verdicts))}
    return Measurement(60.0 * len(verdicts) / seconds, detail | {"verdicts": counts})
