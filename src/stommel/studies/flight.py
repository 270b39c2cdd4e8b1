"""One run of a study, as a worker flies it: what it needs is built once in each process."""

import json
from collections.abc import Mapping, Sequence
from typing import Any

import stommel
from stommel.errors import StommelError
from stommel.ocean.ocean import Ocean
from stommel.simulation.flight import Flown, fly_mission
from stommel.simulation.scenario.loading import mission_from
from stommel.studies.kit import RunKit
from stommel.studies.study_file import Value

Record = dict[str, Any]
"""A finished run: `run`, `seed`, and either `outcome` with `numbers` or `failure`."""

_oceans: dict[str, Ocean] = {}
"""The last ocean of this process: most studies fly all runs in one."""


def fly_run(kit: RunKit, run: int, values: Sequence[Value]) -> Record:
    """Fly one run; one that cannot be flown is a record with the reason."""
    if kit.version != stommel.__version__:
        raise StommelError(f"a worker has stommel {stommel.__version__}, the study is of version {kit.version}")
    document = kit.document_of(run, values)
    record: Record = {"run": run, "seed": document["seed"]}
    try:
        flown = _fly(kit, document)
    except StommelError as error:
        return record | {"failure": " ".join(str(error).split())}
    except (MemoryError, OSError):
        raise  # the machine's trouble, not the run's
    except Exception as error:  # noqa: BLE001 - one defect must not cost the study
        return record | {"failure": f"defect of stommel: {type(error).__name__}: {error}"}
    return record | {"outcome": flown.outcome, "numbers": numbers_of(flown)}


def numbers_of(flown: Flown) -> dict[str, float]:
    """Every number of the summary of a mission but the seed; those of a table inside it are called TABLE_NAME."""
    from stommel.simulation.results.summary import summary  # noqa: PLC0415 - loads xarray

    return {name: value for name, value in _numbers(summary(flown)) if name != "seed"}


def _numbers(table: Mapping[str, Any], prefix: str = "") -> list[tuple[str, float]]:
    found: list[tuple[str, float]] = []
    for key, value in table.items():
        if isinstance(value, Mapping):
            found += _numbers(value, f"{prefix}{key}_")
        elif isinstance(value, bool | int | float):
            found.append((f"{prefix}{key}".replace(" ", "_"), float(value)))
    return found


def _fly(kit: RunKit, document: dict[str, Any]) -> Flown:
    # of a file only the time of the mission is read
    time = [document["start_time"], document["duration_days"]] if document["ocean"]["file"] is not None else []
    choice = json.dumps([document["ocean"], str(kit.folder), time], sort_keys=True, default=str)
    known = _oceans.get(choice)
    mission = mission_from(document, kit.origin, kit.folder, kit.vehicle, known)
    if known is None:
        _oceans.clear()
        _oceans[choice] = mission.ocean
    return fly_mission(mission)
