"""`stommel vehicle run`: the vehicle's coordination software on real ports."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.finish import finish
from stommel.cli.numbers import number_option
from stommel.cli.options import JsonOption
from stommel.cli.output import show_values
from stommel.cli.status import START_AGAIN

if TYPE_CHECKING:
    from stommel.onboard.coordination.stores.missions import MissionStore
    from stommel.onboard.running.vehicle_software import Figures

LONGEST = 366.0 * 86400.0


def run(
    configuration: Annotated[Path, typer.Argument(metavar="CONFIG", help="From `stommel vehicle config`.")],
    mission: Annotated[
        Path | None,
        typer.Option(
            "--mission", metavar="ORDERS.toml", help="Orders to take first (`stommel orders`), if they fit the vehicle."
        ),
    ] = None,
    start: Annotated[
        bool, typer.Option("--start", help="Begin the mission once the start checks have passed.")
    ] = False,
    supervised: Annotated[
        bool,
        typer.Option(
            "--supervised",
            help="Something starts this program again when it ends: the shore may ask for it (status 75).",
        ),
    ] = False,
    seconds: Annotated[
        float | None, number_option("--seconds", 1.0, LONGEST, "s", "Stop after this time; without it, never")
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """Run the vehicle's coordination software on its real CAN bus and serial ports.

    The nodes of the bus come up by themselves if this program stops: they stop and brake, then blow ballast.
    """
    from stommel.compilation import without_compiler
    from stommel.onboard.coordination.config import read_configuration
    from stommel.onboard.running.folders import claimed
    from stommel.onboard.running.ports import open_ports
    from stommel.onboard.running.vehicle_software import VehicleSoftware

    settings = read_configuration(configuration)
    ports = open_ports(settings, str(configuration))
    try:
        with claimed(settings):
            software = VehicleSoftware(
                settings, ports, lambda words: typer.echo(words, err=True), supervised=supervised
            )
            if mission is not None:
                _load(software.missions, mission)
            software.take_mission(software.clock.monotonic())
            if start:
                software.start()
            # a small board has no compiler, and a vehicle flies what was tested
            with without_compiler(), until_asked() as asked:
                figures = software.run(LONGEST if seconds is None else seconds, asked)
    finally:
        ports.close()
    finish(_answer(figures), None, as_json, _show)
    if figures.restart:
        raise typer.Exit(START_AGAIN)


@contextmanager
def until_asked() -> Iterator[Callable[[], bool]]:
    """Tell whether Ctrl-C or SIGTERM has come, which end nothing by themselves meanwhile."""
    import signal

    asked: list[int] = []
    before = {number: signal.signal(number, lambda n, _: asked.append(n)) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield lambda: bool(asked)
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _load(store: "MissionStore", path: Path) -> None:
    from stommel.files.opening import TOML_MIB, read_bytes

    store.take_whole(read_bytes(path, TOML_MIB))


def _answer(figures: "Figures") -> dict[str, Any]:
    return {
        "decisions": figures.decisions,
        "mean_step_ms": figures.mean_step_ms,
        "longest_step_ms": figures.longest_step_ms,
        "late_steps": figures.late,
        "failed_steps": figures.exceptions,
        "link_failures": figures.link_failures,
        "start_again": figures.restart,
    }


def _show(row: dict[str, Any]) -> None:
    show_values(
        "The vehicle's software has stopped",
        {
            "decisions": str(row["decisions"]),
            "one decision": f"{row['mean_step_ms']:.1f} ms (mean), {row['longest_step_ms']:.1f} ms at most",
            "late": str(row["late_steps"]),
            "failed": str(row["failed_steps"]),
            "link failures": str(row["link_failures"]),
            **({"restart": "asked for by the shore"} if row["start_again"] else {}),
        },
    )
