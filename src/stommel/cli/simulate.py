"""`stommel simulate`: fly a mission, write its NetCDF file and its pictures."""

from dataclasses import replace
from typing import TYPE_CHECKING, Annotated

import typer

from stommel.cli.finish import finish
from stommel.cli.flight_progress import flight_progress
from stommel.cli.flown import (
    MissionArgument,
    OutputOption,
    SeedOption,
    TrackOption,
    described,
    interruptible,
    show,
    with_seed,
    write,
)
from stommel.cli.options import JsonOption
from stommel.cli.output import show_values
from stommel.cli.paths import PlotsOption, refuse_same

if TYPE_CHECKING:
    from stommel.simulation.flight import Flown
    from stommel.simulation.scenario.mission import Mission

_FIRST_DAYS = 0.02
"""Flown once before the time is taken, so that compiling and loading are not in it."""


def simulate(
    mission: MissionArgument = None,
    output: OutputOption = None,
    plots: PlotsOption = None,
    track: TrackOption = None,
    seed: SeedOption = None,
    speed_up: Annotated[
        bool, typer.Option("--speed-up", help="Also tell how many times faster than real time it was flown.")
    ] = False,
    list_missions: Annotated[bool, typer.Option("--list", help="List the shipped missions and stop.")] = False,
    as_json: JsonOption = False,
) -> None:
    """Fly a mission with full dynamics, actuators, sensors and control; the same seed gives the same bytes.

    Example: stommel simulate pool_trial --output pool.nc --plots pool
    """
    if list_missions:
        _list(as_json)
        return
    if mission is None:
        raise typer.BadParameter("give a mission file or a shipped mission; --list shows these", param_hint="MISSION")
    refuse_same("--output", output, plots)
    refuse_same("--track", track, plots)
    from stommel.simulation.scenario.loading import load_mission
    from stommel.simulation.scenario.shipped import mission_path

    loaded = load_mission(mission_path(mission))
    if seed is not None:
        loaded = with_seed(loaded, seed)
    with interruptible("before the end of the mission; nothing was written"):
        flown, seconds = _fly(loaded, speed_up)
    row = described(flown, seconds)
    with interruptible("while writing; the files that are there are whole"):
        written = write(flown, output, plots, track)
    finish(row, written, as_json, show)


def _list(as_json: bool) -> None:
    from stommel.simulation.scenario.shipped import shipped_missions

    finish(shipped_missions(), None, as_json, lambda names: show_values("Shipped missions", names))


def _fly(mission: "Mission", timed: bool) -> tuple["Flown", float | None]:
    """Fly the mission; if `timed` also the seconds that it took, without compiling and loading."""
    from time import perf_counter

    from stommel.simulation.flight import fly_mission

    with flight_progress(mission) as progress:
        if timed:
            first = min(_FIRST_DAYS, mission.scenario.duration_days)
            fly_mission(replace(mission, scenario=mission.scenario.model_copy(update={"duration_days": first})))
        began = perf_counter()
        flown = fly_mission(mission, progress=progress)
        return flown, perf_counter() - began if timed else None
