"""`stommel sitl campaign` and `stommel sitl replay`: missions on which things break, and one of them again."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.count_progress import count_progress
from stommel.cli.finish import finish
from stommel.cli.numbers import count_option, seed_option
from stommel.cli.options import JsonOption
from stommel.cli.output import show_table, show_values
from stommel.cli.paths import folder_parser
from stommel.cli.status import INTERRUPTED
from stommel.files.units import counted

if TYPE_CHECKING:
    from stommel.sitl.campaign.run import Campaign

_MOST = 1_000_000


def campaign(
    scenario: Annotated[
        Path | None, typer.Argument(metavar="SCENARIO.toml", help="What is flown; short dives if left out.")
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output",
            metavar="FOLDER",
            parser=folder_parser("--output"),
            help="Journal, and the scenario files of flights that fail; `campaign` if left out.",
        ),
    ] = None,
    runs: Annotated[int, count_option("--runs", 1, _MOST, "Flights")] = 500,
    seed: Annotated[int, seed_option("Of the first flight; the others follow")] = 1,
    workers: Annotated[int | None, count_option("--workers", 1, 1024, "Processes; all cores if left out")] = None,
    scheduler: Annotated[
        str | None, typer.Option("--scheduler", help="Fly on a Dask cluster instead, such as tcp://host:8786.")
    ] = None,
    restart: Annotated[bool, typer.Option("--restart", help="Forget finished flights and fly all anew.")] = False,
    as_json: JsonOption = False,
) -> None:
    """Fly many missions with random faults through the whole software; failing ones are shrunk to the fewest faults.

    Interrupted or killed, the same command goes on where it stopped. The exit status is 1 if a flight failed.

    Example: stommel sitl campaign --runs 20 --output trials
    """
    from stommel.sitl.campaign.run import TRIAL, load_kit, run_campaign
    from stommel.studies.errors import StudyInterruptedError

    kit = load_kit(TRIAL if scenario is None else scenario)
    seeds, folder = range(seed, seed + runs), output or Path("campaign")
    try:
        with count_progress("flights") as progress:
            done = run_campaign(
                kit, folder, seeds, workers=workers, scheduler=scheduler, restart=restart, progress=progress
            )
    except StudyInterruptedError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(INTERRUPTED) from None
    finish(done, done.written, as_json, _show)
    if done.as_json()["failed"]:
        raise typer.Exit(1)


def _show(done: "Campaign") -> None:
    row = done.as_json()
    apart = sum(row["unsurvivable"].values())
    show_values(
        f"{counted(row['flights'], 'flight')} with faults: {len(row['failed'])} failed",
        {
            "scenario": row["scenario"],
            "passed": str(row["passed"]),
            "failed": str(len(row["failed"])),
            "unsurvivable": f"{apart}, counted apart: no pilot could have brought the vehicle up",
        },
    )
    if row["unsurvivable"]:
        show_table("Unsurvivable combinations", ("faults", "flights"), _counts(row["unsurvivable"]))
    if row["failed"]:
        rows = [[str(one["seed"]), one["why"], "; ".join(one["fewest"]) or "none at all"] for one in row["failed"]]
        show_table("Failed, with the fewest faults that still do", ("seed", "why", "fewest faults"), rows)


def _counts(counts: dict[str, int]) -> list[list[str]]:
    return [[name, str(count)] for name, count in counts.items()]


def replay(
    scenario: Annotated[
        Path | None, typer.Argument(metavar="SCENARIO.toml", help="A scenario file, as campaigns write them.")
    ] = None,
    seed: Annotated[
        int | None, seed_option("Of a flight of a campaign with this scenario; its own faults if left out")
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """Fly one flight of a campaign again, to the same bytes, and say what becomes of it.

    Example: stommel sitl replay --seed 3
    """
    from stommel.sitl.campaign.replay import replay as again
    from stommel.sitl.campaign.run import TRIAL

    finish(again(TRIAL if scenario is None else scenario, seed).as_json(), None, as_json, _show_replay)


def _show_replay(row: dict[str, Any]) -> None:
    values = {f"fault {k}": words for k, words in enumerate(row["faults"], 1)}
    title = f"Seed {row['seed']}: {row['verdict']}"
    show_values(title, {**values, "why": row["why"] or "-", "ending": row["ending"], "sha256": row["sha256"]})
