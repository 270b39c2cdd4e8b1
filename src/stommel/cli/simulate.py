"""`stommel simulate`: fly a mission, write its NetCDF file and its pictures."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.options import JsonOption
from stommel.cli.output import number, show_json, show_table, show_values

if TYPE_CHECKING:
    from stommel.simulation.flight import Flown
    from stommel.simulation.mission import Mission


def simulate(
    mission: Annotated[
        str | None, typer.Argument(metavar="MISSION", help="A mission file, or a shipped mission (see --list).")
    ] = None,
    output: Annotated[Path | None, typer.Option("--output", metavar="FILE.nc", help="NetCDF file to write.")] = None,
    plots: Annotated[
        Path | None,
        typer.Option("--plots", metavar="FOLDER", help="Folder for pictures (PNG, SVG) and an interactive page."),
    ] = None,
    seed: Annotated[
        int | None, typer.Option("--seed", min=0, help="Of every random draw; the mission file's if left out.")
    ] = None,
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
    from stommel.simulation.flight import fly_mission
    from stommel.simulation.loading import load_mission
    from stommel.simulation.shipped import mission_path
    from stommel.simulation.summary import summary

    loaded = load_mission(mission_path(mission))
    if seed is not None:
        loaded = _with_seed(loaded, seed)
    with _progress(loaded) as progress:
        flown = fly_mission(loaded, progress=progress)
    row = summary(flown)
    written = _write(flown, output, plots)
    if as_json:
        show_json(row | {"written": [str(path) for path in written]})
        return
    _show(row)
    for path in written:
        typer.echo(f"wrote {path}")


def _list(as_json: bool) -> None:
    from stommel.simulation.shipped import shipped_missions

    names = shipped_missions()
    if as_json:
        show_json(names)
        return
    show_values("Shipped missions", names)


def _with_seed(mission: "Mission", seed: int) -> "Mission":
    plan = mission.plan.model_copy(update={"seed": seed})
    return replace(mission, plan=plan, document=dict(mission.document) | {"seed": seed})


@contextmanager
def _progress(mission: "Mission") -> Iterator[Callable[[float], None]]:
    """Bar with simulated date and speed on the error stream, if that is a terminal."""
    from datetime import timedelta
    from time import monotonic

    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn

    plan = mission.plan
    console = Console(stderr=True)
    columns = (TextColumn("{task.fields[date]}"), BarColumn(), TextColumn("{task.percentage:>3.0f} %"),
               TextColumn("{task.fields[speed]}"))  # fmt: skip
    began: list[float] = []
    with Progress(*columns, console=console, disable=not console.is_terminal, transient=True) as bar:
        task = bar.add_task("", total=1.0, date=f"{plan.start_time:%Y-%m-%d %H:%M}", speed="compiling")

        def report(share: float) -> None:
            simulated = share * plan.duration_days * 86400.0
            date = plan.start_time + timedelta(seconds=simulated)
            # the first piece may include compilation, which is no speed of flight
            speed = (
                "" if not began else f"{(simulated - began[1]) / max(monotonic() - began[0], 1e-9):,.0f} x real time"
            )
            if not began:
                began.extend((monotonic(), simulated))
            bar.update(task, completed=share, date=f"{date:%Y-%m-%d %H:%M}", speed=speed)

        yield report


def _write(flown: "Flown", output: Path | None, plots: Path | None) -> list[Path]:
    if output is None and plots is None:
        return []
    from stommel.simulation.results import dataset_of, write_netcdf

    dataset, written = dataset_of(flown), []
    if output is not None:
        write_netcdf(dataset, output)
        written.append(output)
    if plots is not None:
        from stommel.simulation.pictures import save_pictures

        written += save_pictures(dataset, plots, flown.mission.ocean)
    return written


def _show(row: dict[str, Any]) -> None:
    values = {
        "outcome": row["outcome"],
        "time": f"{row['days']:.3g} days, {row['dives']} dives, deepest {row['deepest_m']:.1f} m",
        "distance": f"{row['distance_made_good_km']:.4g} km made good, {row['distance_over_ground_km']:.4g} km over "
        f"ground, {row['distance_through_water_km']:.4g} km along the path through the water",
        "seed": str(row["seed"]),
    }
    if row["energy_wh"] is not None:
        values["battery"] = (
            f"{row['battery_left_wh']:.4g} of {row['battery_wh']:.4g} Wh left ({row['battery_left_share']:.0%}): "
            f"{row['days_left']:.1f} days at the mean {row['mean_power_w']:.2f} W"
        )
    if row["reckoning_error_m"] is not None:
        error, miss = row["reckoning_error_m"], row["current_error_m_s"]
        values["navigation"] = f"off by {error['mean']:.0f} m on surfacing (mean), {error['greatest']:.0f} m at most"
        values["current"] = f"depth mean off by {miss['mean']:.4f} m/s (mean), {miss['greatest']:.4f} m/s at most"
    values["events"] = ", ".join(f"{name}: {count}" for name, count in row["events"].items()) or "none"
    show_values(f"{row['name']}: {row['vehicle']} in {row['ocean']}", values)
    if row["energy_wh"] is not None:
        _show_energy(row["energy_wh"])


def _show_energy(energy: dict[str, float]) -> None:
    total = sum(energy.values())
    rows = [
        [name.replace("_", " "), number(wh, 2), number(100.0 * wh / total, 1)]
        for name, wh in sorted(energy.items(), key=lambda item: -item[1])
    ]
    rows.append(["all", number(total, 2), number(100.0, 1)])
    typer.echo()
    show_table("Energy from the battery", ["part", "energy\nWh", "share\n%"], rows)
