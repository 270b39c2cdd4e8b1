"""How well a study uses two workers."""

import os
import tempfile
import tomllib
from pathlib import Path
from statistics import median
from threading import Event
from time import perf_counter

from figures.registry import Measurement, figure
from stommel.simulation.loading import mission_from
from stommel.simulation.shipped import mission_path
from stommel.simulation.studies.flight import fly_run
from stommel.simulation.studies.journal import Journal
from stommel.simulation.studies.running import cores, fly_here
from stommel.simulation.studies.study import Study, study_of
from stommel.simulation.studies.study_file import StudyFile

STATED, FLOWN, REPEATS = 1000, 100, 3


def _one_day_missions() -> Study:
    path = mission_path("still_20_days")
    document = tomllib.loads(path.read_text(encoding="utf-8")) | {"duration_days": 1}
    file = StudyFile.model_validate(
        {
            "name": "one-day missions",
            "mission": "still_20_days",
            "kind": "monte_carlo",
            "runs": FLOWN,
            "parameters": [{"key": "mission.dives.pitch_deg", "distribution": "uniform", "from": 30, "to": 40}],
        }
    )
    return study_of(file, "bench", mission_from(document, str(path), path.parent))


def _times(study: Study, workers: int, folder: Path) -> tuple[float, float]:
    """Seconds until the first record is kept, and seconds a run from there on."""
    tasks = list(enumerate(study.values))
    begin = perf_counter()
    with Journal(folder, study.fingerprint()) as journal:
        marks = []
        for record in fly_here(study.kit, tasks, workers, Event()):
            journal.keep(record)
            marks.append(perf_counter())
    first = workers  # the first of each worker comes with its start
    return marks[first - 1] - begin, (marks[-1] - marks[first - 1]) / (len(marks) - first)


@figure(unit="1", bar=0.9, at_least=True)
def study_efficiency_2() -> Measurement:
    """Share of twice the speed of one worker that two reach in a study of 1000 one-day missions.

    Fewer missions are flown: start-up and time a run are measured apart, and 1000 runs are counted from them.
    """
    if cores() < 2:
        return Measurement(None, {"skipped": "needs two cores"})
    study = _one_day_missions()
    fly_run(study.kit, 0, study.values[0])  # compiles
    one, two = [], []
    with tempfile.TemporaryDirectory() as folder:
        for repeat in range(REPEATS):
            one.append(_times(study, 1, Path(folder) / f"one{repeat}"))
            two.append(_times(study, 2, Path(folder) / f"two{repeat}"))
    # the least of the repeats: neighbours on the machine only add
    (start_1, each_1), (start_2, each_2) = (tuple(min(column) for column in zip(*t, strict=True)) for t in (one, two))
    total_1, total_2 = start_1 + STATED * each_1, start_2 + STATED * each_2
    detail = {
        "missions_flown": FLOWN,
        "missions_stated": STATED,
        "start_s": [start_1, start_2],
        "each_s": [each_1, each_2],
        "median_each_s": [median(t[1] for t in one), median(t[1] for t in two)],
        "load_average": os.getloadavg()[0],
    }
    return Measurement(total_1 / (2.0 * total_2), detail)
