"""A campaign from its first to its last seed, with a journal between, and scenario files of the flights that fail."""

import hashlib
import json
from collections import Counter
from collections.abc import Generator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import stommel
from stommel.files.toml_reader import read_toml
from stommel.files.units import counted
from stommel.files.whole import write_whole
from stommel.sitl.campaign.kit import CampaignKit, faults_in, fly_seed
from stommel.sitl.campaign.verdict import FAILED, PASSED, UNSURVIVABLE
from stommel.sitl.faults.fault import Fault
from stommel.sitl.scenario import load_scenario
from stommel.studies.errors import StudyError, StudyInterruptedError
from stommel.studies.journal import Journal
from stommel.studies.run import Progress, interruptible, silent
from stommel.studies.running import cores, fly_here, fly_on_cluster

TRIAL = Path(__file__).with_name("trial.toml")
"""Scenario that is flown where none is given."""
FAILING = "failing"
"""Folder of the scenario files of flights that fail, in a campaign's output."""


@dataclass(frozen=True)
class Campaign:
    """A campaign that has been flown."""

    origin: str
    """Scenario file."""
    records: tuple[Mapping[str, Any], ...]
    """One for each seed, as `stommel.sitl.campaign.kit.fly_seed` makes them."""
    kept: int
    """Of them, those that the journal had from before."""
    written: tuple[Path, ...]
    """Scenario files of the flights that failed: as flown, and with the fewest faults."""

    def of(self, verdict: str) -> list[Mapping[str, Any]]:
        """Records with a verdict."""
        return [record for record in self.records if record["verdict"] == verdict]

    def combinations(self) -> dict[str, int]:
        """Unsurvivable combinations by name, and how many flights met them."""
        return dict(Counter(str(record["why"]).partition(":")[0] for record in self.of(UNSURVIVABLE)).most_common())

    def as_json(self) -> dict[str, Any]:
        """The campaign in words and numbers."""
        return {
            "scenario": self.origin,
            "flights": len(self.records),
            "kept": self.kept,
            "passed": len(self.of(PASSED)),
            "failed": [
                {
                    "seed": record["seed"],
                    "why": record["why"],
                    "ending": record["ending"],
                    "faults": [fault.words for fault in faults_in(record)],
                    "fewest": [fault.words for fault in faults_in(record, "fewest")],
                }
                for record in self.of(FAILED)
            ],
            "unsurvivable": self.combinations(),
            "unsurvivable_seeds": [record["seed"] for record in self.of(UNSURVIVABLE)],
        }


def load_kit(scenario: Path) -> CampaignKit:
    """Read and check the scenario of a campaign.

    Raises
    ------
    FileError
        The file cannot be read, or something in it is impossible.
    """
    found = load_scenario(scenario)
    document = {name: value for name, value in read_toml(scenario).items() if name != "faults"}
    return CampaignKit(document, found.faults, scenario.parent.resolve(), str(scenario), stommel.__version__)


def run_campaign(
    kit: CampaignKit,
    output: Path,
    seeds: Sequence[int],
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    restart: bool = False,
    progress: Progress = silent,
) -> Campaign:
    """Fly the seeds that the journal in a folder does not hold yet, and write scenario files of those that fail.

    Parameters
    ----------
    kit
        From `load_kit`.
    output
        Folder of the journal and of the failing scenarios.
    seeds
        Each is a flight: its faults and all its random draws follow from it.
    workers
        Processes; all cores if left out.
    scheduler
        Address of a Dask scheduler, whose workers fly the runs instead.
    restart
        Forget the flights of the journal.
    progress
        Called after each flight with the finished flights and all flights.

    Raises
    ------
    StudyInterruptedError
        Ctrl-C; the flights that are finished are kept.
    StudyError
        The campaign cannot go on.
    OutputError
        The folder cannot be written.
    """
    if workers is not None and workers < 1:
        raise StudyError(f"--workers {workers}: must be at least 1")
    with Journal(output, _fingerprint(kit), restart=restart) as journal:
        known = journal.finished()
        tasks = [(seed, (seed,)) for seed in seeds if seed not in known]
        finished = len(seeds) - len(tasks)
        kept = finished
        progress(finished, len(seeds))
        with interruptible() as stop, closing(_flights(kit, tasks, workers, scheduler, stop)) as flights:
            for record in flights:
                journal.keep(record)
                known[record["run"]] = record
                finished += 1
                progress(finished, len(seeds))
        if finished < len(seeds):
            raise StudyInterruptedError(
                f"interrupted: {finished} of {counted(len(seeds), 'flight is', 'flights are')} kept in {output}; "
                "the same command goes on"
            )
    records = tuple(known[seed] for seed in seeds)
    return Campaign(kit.origin, records, kept, tuple(_write_failing(kit, output, records)))


def _flights(
    kit: CampaignKit, tasks: list[Any], workers: int | None, scheduler: str | None, stop: Any
) -> Generator[dict[str, Any], None, None]:
    if not tasks:
        return
    if scheduler is not None:
        yield from fly_on_cluster(kit, tasks, scheduler, stop, fly=fly_seed)
    else:
        yield from fly_here(kit, tasks, workers or cores(), stop, fly=fly_seed)


def _fingerprint(kit: CampaignKit) -> dict[str, str]:
    said = json.dumps([kit.document, [fault.as_table() for fault in kit.faults]], sort_keys=True, default=str)
    return {"scenario": hashlib.sha256(said.encode()).hexdigest(), "version of stommel": kit.version}


def _write_failing(kit: CampaignKit, output: Path, records: Sequence[Mapping[str, Any]]) -> list[Path]:
    written = []
    folder = output / FAILING
    for record in records:
        if record["verdict"] != FAILED:
            continue
        folder.mkdir(exist_ok=True)
        for name, key in (("", "faults"), ("_fewest", "fewest")):
            path = folder / f"seed_{record['seed']}{name}.toml"
            write_whole(path, scenario_text(kit, int(record["seed"]), faults_in(record, key), str(record["why"])))
            written.append(path)
    return written


def scenario_text(kit: CampaignKit, seed: int, faults: Sequence[Fault], why: str = "") -> str:
    """Return the scenario file of one flight, which `stommel sitl replay` flies again to the same bytes."""
    import tomlkit  # noqa: PLC0415 - only who writes one needs it

    document = {**kit.document, "seed": seed, "faults": [fault.as_table() for fault in faults]}
    comment = f"# {' '.join(why.split())}\n" if why else ""
    return comment + tomlkit.dumps(document)
