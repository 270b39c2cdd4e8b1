"""`stommel sitl`: fly a mission with the vehicle's own software in the loop."""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from math import isnan
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from typer.core import TyperGroup

from stommel.cli.finish import finish
from stommel.cli.flown import OutputOption, SeedOption, TrackOption, described, show, with_seed, write
from stommel.cli.flown import interruptible as writing
from stommel.cli.options import JsonOption
from stommel.cli.output import show_values
from stommel.cli.paths import PlotsOption, folder_parser, refuse_same
from stommel.cli.sitl_campaign import campaign, replay
from stommel.cli.sitl_radio import KeyOption, LinkOption, radio_at_the_end, radio_words, shore_at
from stommel.cli.sitl_stand_in import stand_in
from stommel.cli.status import INTERRUPTED
from stommel.files.units import counted

if TYPE_CHECKING:
    from stommel.onboard.coordination.health import SourceHealth
    from stommel.simulation.flight import Flown
    from stommel.simulation.scenario.mission import Mission
    from stommel.sitl.flight import Watcher
    from stommel.sitl.real_time import Pace
    from stommel.sitl.system import System

FLY = "fly"
"""The verb that `stommel sitl SCENARIO` stands for."""
MAX = "max"
SPEEDS = (0.1, 100.0)
"""Times real time that can be asked for."""
_EVERY = 50
"""Steps from one report of the progress to the next."""


class _FliesByDefault(TyperGroup):
    """What is no verb of the group is a scenario to fly."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        if args and args[0] not in self.commands and args[0] not in ctx.help_option_names:
            args = [FLY, *args]
        return super().parse_args(ctx, args)


sitl_app = typer.Typer(
    cls=_FliesByDefault,
    no_args_is_help=True,
    rich_markup_mode="markdown",
    help="The vehicle's own software in the loop; `stommel sitl SCENARIO` is short for `stommel sitl fly SCENARIO`.",
)
sitl_app.command("stand-in")(stand_in)
sitl_app.command("campaign")(campaign)
sitl_app.command("replay")(replay)


def _speed(text: str) -> float | None:
    """Times real time; None as fast as it goes."""
    if text == MAX:
        return None
    try:
        speed = float(text)
    except ValueError:
        speed = float("nan")
    if not SPEEDS[0] <= speed <= SPEEDS[1]:
        raise typer.BadParameter(
            f"{text!r} is neither {MAX} nor a number from {SPEEDS[0]:g} to {SPEEDS[1]:g}", param_hint="--speed"
        )
    return speed


@sitl_app.command(FLY)
def fly(
    scenario: Annotated[str, typer.Argument(metavar="SCENARIO", help="A mission file, or a shipped mission.")],
    output: OutputOption = None,
    log: Annotated[
        Path | None,
        typer.Option(
            "--log", metavar="FOLDER", parser=folder_parser("--log"), help="Folder for the log that the vehicle writes."
        ),
    ] = None,
    plots: PlotsOption = None,
    track: TrackOption = None,
    seed: SeedOption = None,
    speed: Annotated[str, typer.Option("--speed", metavar="1|20|max", help="Times real time.")] = MAX,
    separate_nodes: Annotated[
        bool, typer.Option("--separate-nodes", help="Run both nodes in processes of their own.")
    ] = False,
    parameters: Annotated[
        Path | None,
        typer.Option(
            "--parameters",
            metavar="FOLDER",
            parser=folder_parser("--parameters"),
            help="Folder in which the nodes keep their parameters from flight to flight.",
        ),
    ] = None,
    live: Annotated[
        bool | None, typer.Option("--live/--no-live", help="Show the flight; if left out, where there is a terminal.")
    ] = None,
    link: LinkOption = None,
    key: KeyOption = None,
    as_json: JsonOption = False,
) -> None:
    """Fly a mission with coordinator, nodes, bus and instruments in the loop; the same seed gives the same bytes.

    Example: stommel sitl pool_trial --log log --output pool.nc
    """
    times = _speed(speed)
    refuse_same("--output", output, plots)
    refuse_same("--track", track, plots)
    refuse_same("--log", log, plots)
    from stommel.simulation.scenario.shipped import mission_path
    from stommel.sitl.faults.injector import Injector
    from stommel.sitl.log_folder import logbook_in
    from stommel.sitl.scenario import load_scenario
    from stommel.sitl.system import System

    mission, faults, air = load_scenario(mission_path(scenario))
    if seed is not None:
        mission = with_seed(mission, seed)
    if faults and separate_nodes:
        raise typer.BadParameter("a scenario with faults flies in one process", param_hint="--separate-nodes")
    with shore_at(link, key) as (shore, guard):
        system = System(
            mission, None if log is None else logbook_in(log, mission), Injector(faults, mission.scenario.seed),
            radio=air, shore=shore, guard=guard, parameters=parameters,
        )  # fmt: skip
        for note in system.notes:
            _say(note)
        flown, about = _flown(system, log, times, separate_nodes, live)
    row = described(flown, None) | about
    with writing("while writing; the files that are there are whole"):
        written = write(flown, output, plots, track)
    finish(row, written, as_json, _show)


def _flown(
    system: "System", log: Path | None, speed: float | None, separate: bool, live: bool | None
) -> tuple["Flown", dict[str, Any]]:
    """Fly, and say what the software was doing at the end."""
    from stommel.sitl.flight import fly as fly_in_the_loop
    from stommel.sitl.interruption import Interruption
    from stommel.sitl.real_time import Pace

    mission, logbook = system.mission, system.coordinator.recorder.logbook
    pace = None if speed is None else Pace(speed)
    with ExitStack() as around, _told(system, log):
        stop = around.enter_context(Interruption())
        watchers: list[Watcher] = [*around.enter_context(_watched(mission, pace, live)), stop]
        nodes = around.enter_context(_nodes(system, separate, in_real_time=pace is not None))
        flown = fly_in_the_loop(system, logbook=logbook, watchers=watchers, pace=pace)
    return flown, _about(system, nodes, log, pace)


@contextmanager
def _told(system: "System", log: Path | None) -> Iterator[None]:
    """Answer Ctrl-C with one line and the exit status of an interrupted command."""
    from stommel.sitl.shown import clock

    try:
        yield
    except KeyboardInterrupt:
        kept = "nothing was written" if log is None else f"the log in {log} is whole up to there"
        typer.echo(f"interrupted at {clock(system.plant.time)} of the mission; {kept}", err=True)
        raise typer.Exit(INTERRUPTED) from None


@contextmanager
def _nodes(system: "System", separate: bool, *, in_real_time: bool) -> Iterator[str]:
    """Put the nodes where they shall run, and say where that is."""
    if not separate:
        yield "in one process"
        return
    from stommel.sitl.multicast import own_bus, works
    from stommel.sitl.separate_nodes import SeparateNodes

    multicast = own_bus() if in_real_time else None
    if multicast is not None:
        objection = works(multicast)
        if objection:
            _say(f"{objection}; frames go in lockstep instead")
            multicast = None
    with SeparateNodes(system, multicast, _say):
        yield "in separate processes, " + (
            "in lockstep" if multicast is None else f"over multicast {multicast.channel}"
        )


@contextmanager
def _watched(mission: "Mission", pace: "Pace | None", live: bool | None) -> Iterator[list["Watcher"]]:
    """Show the flight on the error stream: live, or as a bar."""
    from rich.console import Console

    from stommel.cli.flight_progress import flight_progress

    console = Console(stderr=True, force_terminal=True if live else None)
    watchers: list[Watcher] = [] if pace is None else [_LateNote(pace)]
    if live or (live is None and console.is_terminal):
        from stommel.sitl.live_view import LiveView

        with LiveView(console, pace) as view:
            yield [view, *watchers]
        return
    with flight_progress(mission) as report:
        yield [_Share(report, mission.scenario.duration_days * 86400.0), *watchers]


class _Share:
    """Reports the share that is flown, now and then."""

    def __init__(self, report: Any, whole: float) -> None:
        self._report, self._whole, self._until = report, whole, 1

    def __call__(self, system: "System") -> None:
        self._until -= 1
        if self._until <= 0:
            self._until = _EVERY
            self._report(system.plant.time / self._whole)


class _LateNote:
    """Says once that the machine cannot keep up."""

    def __init__(self, pace: "Pace") -> None:
        self._pace, self._told = pace, False

    def __call__(self, system: "System") -> None:
        if self._pace.lost > 0.0 and not self._told and system.plant.tick > 1:
            self._told = True
            _say(f"this machine cannot keep up with {self._pace.speed:g} times real time; the mission falls behind")


def _say(words: str) -> None:
    typer.echo(f"note: {words}", err=True)


def _about(system: "System", nodes: str, log: Path | None, pace: "Pace | None") -> dict[str, Any]:
    """What the vehicle's software was doing at the end, and what went over the bus."""
    coordinator, view = system.coordinator, system.coordinator.view
    decoder = coordinator.perception.decoder
    return {
        "state": "switched on" if view is None else view.executive.words,
        "alarms": [] if view is None else [{"name": a.name, "since_s": a.since} for a in view.safety.active],
        "sources": [] if view is None else [_source(source) for source in view.health.sources],
        "nodes": nodes,
        "bus_load_share": system.bus.load(system.plant.time),
        "frames_to_coordinator": decoder.received.total(),
        "frames_lost": decoder.lost.total(),
        "frames_rejected": decoder.rejected.total(),
        "log": None if log is None else str(log),
        "fell_behind_s": None if pace is None else pace.lost,
        "radio": radio_at_the_end(system),
    }


def _source(source: "SourceHealth") -> dict[str, Any]:
    """How a node or an instrument did; the age is unknown of one that was never heard."""
    row = source._asdict() | {"condition": source.condition.value}
    age = row.pop("age")
    return row | {"age_s": None if isnan(age) else age}


def _health(sources: list[dict[str, Any]]) -> str:
    """Sources whose condition is other than well."""
    odd = [
        f"{source['name']} {source['condition']}" for source in sources if source["condition"] not in ("well", "off")
    ]
    return ", ".join(odd) or "all that is on is well"


def _show(row: dict[str, Any]) -> None:
    show(row)
    values = {
        "state": row["state"],
        "alarms": ", ".join(f"{a['name']} since {a['since_s']:.0f} s" for a in row["alarms"]) or "none",
        "health": _health(row["sources"]),
        "nodes": row["nodes"],
        "bus": (
            f"{row['bus_load_share']:.1%} busy, {counted(row['frames_to_coordinator'], 'frame')} to the coordinator, "
            f"{row['frames_lost']} lost, {row['frames_rejected']} rejected"
        ),
    }
    values["radio"] = radio_words(row["radio"])
    if row["log"] is not None:
        values["log"] = row["log"]
    if row["fell_behind_s"]:
        values["pace"] = f"fell {row['fell_behind_s']:.1f} s behind the clock"
    typer.echo()
    show_values("The vehicle's software at the end", values)
