"""A flown mission, from the fast simulator or from the loop: its files, its summary, how it is interrupted."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.numbers import seed_option
from stommel.cli.output import number, show_notes, show_table, show_values, show_warnings
from stommel.cli.paths import file_parser
from stommel.cli.status import INTERRUPTED
from stommel.cli.vehicle_check import show_vehicle_check, vehicle_check
from stommel.files.units import counted

if TYPE_CHECKING:
    from stommel.simulation.flight import Flown
    from stommel.simulation.scenario.mission import Mission

_SHOWN = 12
"""Waypoints in the table."""

MissionArgument = Annotated[
    str | None, typer.Argument(metavar="MISSION", help="A mission file, or a shipped mission (see --list).")
]
OutputOption = Annotated[
    Path | None,
    typer.Option("--output", metavar="FILE", parser=file_parser("--output", ".nc"), help="NetCDF file to write, .nc."),
]
TrackOption = Annotated[
    Path | None,
    typer.Option(
        "--track",
        metavar="FILE",
        parser=file_parser("--track", ".geojson", ".kml"),
        help="Track with waypoints and surfacings for other maps, .geojson or .kml.",
    ),
]
SeedOption = Annotated[int | None, seed_option("Of every random draw; the mission file's if left out")]


def with_seed(mission: "Mission", seed: int) -> "Mission":
    """Return a mission with another seed."""
    scenario = mission.scenario.model_copy(update={"seed": seed})
    return replace(mission, scenario=scenario, document=dict(mission.document) | {"seed": seed})


@contextmanager
def interruptible(when: str) -> Iterator[None]:
    """Answer Ctrl-C with one line and the exit status of an interrupted command."""
    try:
        yield
    except KeyboardInterrupt:
        typer.echo(f"interrupted {when}", err=True)
        raise typer.Exit(INTERRUPTED) from None


def described(flown: "Flown", seconds: float | None) -> dict[str, Any]:
    """Return the answer of a verb that flew: summary, what is odd about vehicle and mission, the time it took [s]."""
    from stommel.simulation.results.summary import summary
    from stommel.simulation.scenario.remarks import remarks

    row = summary(flown)
    row["vehicle_check"] = vehicle_check(flown.mission.vehicle)
    row["warnings"] = [warning.as_row() for warning in remarks(flown.mission)]
    row["flight_s"] = seconds
    row["speed_up"] = None if seconds is None else row["days"] * 86400.0 / seconds
    return row


def write(flown: "Flown", output: Path | None, plots: Path | None, track: Path | None) -> list[Path]:
    """Write the files that were asked for, and return their paths."""
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


def show(row: dict[str, Any]) -> None:
    """Lay the answer out for a terminal."""
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
