"""`stommel simulate`: fly a mission, write its NetCDF file and its pictures."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.finish import finish
from stommel.cli.numbers import seed_option
from stommel.cli.options import JsonOption
from stommel.cli.output import number, show_notes, show_table, show_values, show_warnings
from stommel.cli.paths import PlotsOption, file_parser, refuse_same
from stommel.cli.status import INTERRUPTED
from stommel.cli.vehicle_check import show_vehicle_check, vehicle_check
from stommel.files.units import counted

if TYPE_CHECKING:
    from rich.progress import ProgressColumn

    from stommel.simulation.flight import Flown
    from stommel.simulation.scenario.mission import Mission

_FIRST_DAYS = 0.02
"""Flown once before the time is taken, so that compiling and loading are not in it."""
_SHOWN = 12
"""Waypoints in the table."""
_SHORT_WAIT = 6.0
"""Loading the kept machine code takes less; whoever waits longer sees it being compiled [s]."""


def simulate(
    mission: Annotated[
        str | None, typer.Argument(metavar="MISSION", help="A mission file, or a shipped mission (see --list).")
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output", metavar="FILE", parser=file_parser("--output", ".nc"), help="NetCDF file to write, .nc."
        ),
    ] = None,
    plots: PlotsOption = None,
    track: Annotated[
        Path | None,
        typer.Option(
            "--track",
            metavar="FILE",
            parser=file_parser("--track", ".geojson", ".kml"),
            help="Track with waypoints and surfacings for other maps, .geojson or .kml.",
        ),
    ] = None,
    seed: Annotated[int | None, seed_option("Of every random draw; the mission file's if left out")] = None,
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
    from stommel.simulation.results.summary import summary
    from stommel.simulation.scenario.loading import load_mission
    from stommel.simulation.scenario.remarks import remarks
    from stommel.simulation.scenario.shipped import mission_path

    loaded = load_mission(mission_path(mission))
    if seed is not None:
        loaded = _with_seed(loaded, seed)
    with _interruptible("before the end of the mission; nothing was written"):
        flown, seconds = _fly(loaded, speed_up)
    row = summary(flown)
    row["vehicle_check"] = vehicle_check(loaded.vehicle)
    row["warnings"] = [warning.as_row() for warning in remarks(loaded)]
    row["flight_s"] = seconds
    row["speed_up"] = None if seconds is None else row["days"] * 86400.0 / seconds
    with _interruptible("while writing; the files that are there are whole"):
        written = _write(flown, output, plots, track)
    finish(row, written, as_json, _show)


def _list(as_json: bool) -> None:
    from stommel.simulation.scenario.shipped import shipped_missions

    finish(shipped_missions(), None, as_json, lambda names: show_values("Shipped missions", names))


def _with_seed(mission: "Mission", seed: int) -> "Mission":
    scenario = mission.scenario.model_copy(update={"seed": seed})
    return replace(mission, scenario=scenario, document=dict(mission.document) | {"seed": seed})


@contextmanager
def _interruptible(when: str) -> Iterator[None]:
    """Answer Ctrl-C with one line and the exit status of an interrupted command."""
    try:
        yield
    except KeyboardInterrupt:
        typer.echo(f"interrupted {when}", err=True)
        raise typer.Exit(INTERRUPTED) from None


def _fly(mission: "Mission", timed: bool) -> tuple["Flown", float | None]:
    """Fly the mission; if `timed` also the seconds that it took, without compiling and loading."""
    from time import perf_counter

    from stommel.simulation.flight import fly_mission

    with _progress(mission) as progress:
        if timed:
            first = min(_FIRST_DAYS, mission.scenario.duration_days)
            fly_mission(replace(mission, scenario=mission.scenario.model_copy(update={"duration_days": first})))
        began = perf_counter()
        flown = fly_mission(mission, progress=progress)
        return flown, perf_counter() - began if timed else None


@contextmanager
def _progress(mission: "Mission") -> Iterator[Callable[[float], None]]:
    """Bar with simulated date and speed on the error stream, if that is a terminal."""
    from datetime import timedelta
    from time import monotonic

    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn

    plan = mission.scenario
    console = Console(stderr=True)
    columns = (TextColumn("{task.fields[date]}"), BarColumn(bar_width=None), TextColumn("{task.percentage:>3.0f} %"),
               _speed_column())  # fmt: skip
    began: list[float] = []
    with Progress(*columns, console=console, disable=not console.is_terminal, transient=True, expand=True) as bar:
        task = bar.add_task("", total=1.0, date=f"{plan.start_time:%Y-%m-%d %H:%M}", speed=None)

        def report(share: float) -> None:
            simulated = share * plan.duration_days * 86400.0
            date = plan.start_time + timedelta(seconds=simulated)
            # the first piece may include compilation, which is no speed of flight
            speed = (simulated - began[1]) / max(monotonic() - began[0], 1e-9) if began else 0.0
            if not began:
                began.extend((monotonic(), simulated))
            bar.update(task, completed=share, date=f"{date:%Y-%m-%d %H:%M}", speed=speed)

        yield report


def _speed_column() -> "ProgressColumn":
    """Times real time; before the first piece is flown, what the user waits for."""
    from rich.progress import ProgressColumn, Task
    from rich.table import Column
    from rich.text import Text

    class Speed(ProgressColumn):
        def render(self, task: Task) -> Text:
            speed = task.fields["speed"]
            if speed is None:
                return Text("getting ready" if (task.elapsed or 0.0) < _SHORT_WAIT else "compiling, once")
            return Text(f"{speed:,.0f} x real time" if speed else "")

    return Speed(Column(min_width=21, justify="right"))


def _write(flown: "Flown", output: Path | None, plots: Path | None, track: Path | None) -> list[Path]:
    if output is None and plots is None and track is None:
        return []
    from stommel.simulation.results.dataset import dataset_of, write_netcdf

    dataset, written = dataset_of(flown), []
    if output is not None:
        write_netcdf(dataset, output)
        written.append(output)
    if track is not None:
        from stommel.simulation.results.track import write_track

        write_track(dataset, track)
        written.append(track)
    if plots is not None:
        from stommel.simulation.pictures import save_pictures

        written += save_pictures(dataset, plots, flown.mission.ocean)
    return written


def _show(row: dict[str, Any]) -> None:
    from stommel.simulation.results.verdict import duration

    values = {
        "mission": f"{row['name']}: {row['vehicle']} in {row['ocean']}",
        "outcome": row["outcome"],
        "time": f"{duration(row['days'])}, {counted(row['dives'], 'dive')}, deepest {row['deepest_m']:.1f} m",
        **_speed(row),
        "distance": _distances(row),
        "seed": str(row["seed"]),
    }
    if row["energy_wh"] is not None:
        values["battery"] = (
            f"{row['battery_left_wh']:.4g} of {row['battery_wh']:.4g} Wh left ({row['battery_left_share']:.0%}): "
            f"{counted(number(row['days_left'], 1), 'day')} at the mean {row['mean_power_w']:.2f} W"
        )
        values["voltage"] = f"{row['battery_end_v']:.2f} V at the end, {row['battery_least_v']:.2f} V at least"
    if row["reckoning_error_m"] is not None:
        error, miss = row["reckoning_error_m"], row["current_error_m_s"]
        values["navigation"] = f"off by {error['mean']:.0f} m on surfacing (mean), {error['greatest']:.0f} m at most"
        values["current"] = f"depth mean off by {miss['mean']:.4f} m/s (mean), {miss['greatest']:.4f} m/s at most"
    if row["ctd_samples"]:
        values["CTD"] = counted(row["ctd_samples"], "sample")
    if row["speed_up"] is not None:
        values["speed-up"] = f"{row['speed_up']:,.0f} times real time, flown in {row['flight_s']:.3g} s"
    values["events"] = ", ".join(f"{name}: {count}" for name, count in row["events"].items()) or "none"
    show_values(row["verdict"], values)
    show_warnings(f"{warning['name']}: {warning['message']}" for warning in row["warnings"])
    if row["waypoints"]:
        _show_waypoints(row["waypoints"])
    if row["energy_wh"] is not None:
        _show_energy(row["energy_wh"])
    show_vehicle_check(row["vehicle_check"])


def _speed(row: dict[str, Any]) -> dict[str, str]:
    """How fast the dives were; a mission without any has none."""
    if row["flown_speed_m_s"] is None:
        return {}
    asked = "" if row["asked_speed_m_s"] is None else f"; {row['asked_speed_m_s']:g} m/s asked"
    return {"speed": f"{row['flown_speed_m_s']:.3f} m/s through the water, mean of the dives{asked}"}


def _distances(row: dict[str, Any]) -> str:
    km = [row[f"distance_{way}_km"] for way in ("made_good", "over_ground", "through_water")]
    made, ground, water = (f"{1e3 * d:.0f} m" if max(km) < 3.0 else f"{d:.1f} km" for d in km)
    return f"{made} made good, {ground} over ground, {water} through water"


def _show_waypoints(waypoints: list[dict[str, Any]]) -> None:
    """Waypoints and the legs to them; of a long list the last that were sought and what comes after."""
    first = max(0, min(sum(w["reached"] for w in waypoints) - _SHOWN + 2, len(waypoints) - _SHOWN))
    rows = [
        [
            str(w["number"]),
            w["reached_utc"][5:16].replace("T", " ") if w["reached"] else "no",
            number(w["closest_m"], 0),
            _in_km(w["distance_at_end_m"]),
            number(w["leg_length_km"], 1),
            number(w["leg_time_hours"], 1),
            number(w["leg_made_good_m_s"], 2),
            number(w["beside_line_greatest_m"], 0),
        ]
        for w in waypoints[first : first + _SHOWN]
    ]
    columns = ["no.", "reached\nUTC", "nearest\nm", "to go\nkm", "leg\nkm", "time\nh", "made good\nm/s", "off line\nm"]
    typer.echo()
    show_table("Waypoints, and the legs to them", columns, rows)
    if len(waypoints) > _SHOWN:
        show_notes([f"{len(rows)} of {counted(len(waypoints), 'waypoint')} are shown; --json has all"])


def _in_km(metres: float | None) -> str:
    return number(None if metres is None else metres / 1e3, 1)


def _show_energy(energy: dict[str, float]) -> None:
    total = sum(energy.values())
    rows = [
        [name.replace("_", " "), number(wh, 2), number(100.0 * wh / total, 1)]
        for name, wh in sorted(energy.items(), key=lambda item: -item[1])
    ]
    rows.append(["all", number(total, 2), number(100.0, 1)])
    typer.echo()
    show_table("Energy from the battery", ["part", "energy\nWh", "share\n%"], rows)
