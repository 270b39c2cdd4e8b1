"""`stommel ocean show`: what an ocean covers, its water at one point, a map."""

from typing import Annotated, Any

import typer

from stommel.cli.finish import finish
from stommel.cli.numbers import number_option
from stommel.cli.ocean.choice import between, bounds, open_ocean, pairs, place
from stommel.cli.options import JsonOption
from stommel.cli.output import number, show_values
from stommel.cli.paths import PlotOption
from stommel.files.units import counted


def show(
    ocean: Annotated[
        list[str],
        typer.Argument(
            metavar="OCEAN", help="CF NetCDF file or files, a profile (.csv), or the name of an analytic ocean."
        ),
    ],
    at: Annotated[str | None, typer.Option("--at", metavar="LAT,LON", help="Place to ask for [deg].")] = None,
    time: Annotated[
        str | None, typer.Option("--time", help="ISO 8601 time, UTC; the ocean's first if left out.")
    ] = None,
    depth: Annotated[float, number_option("--depth", 0, 11300, "m", "Depth")] = 0.0,
    parameter: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="NAME=VALUE", help="Parameter of an analytic ocean or of a profile's."),
    ] = None,
    names: Annotated[
        list[str] | None,
        typer.Option("--name", metavar="WHAT=VARIABLE", help="Variable of a file, or column of a profile."),
    ] = None,
    region: Annotated[
        str | None, typer.Option("--bounds", metavar="S,N,W,E", help="Region of a file to read [deg].")
    ] = None,
    period: Annotated[
        str | None, typer.Option("--between", metavar="FIRST,LAST", help="Times of a file to read.")
    ] = None,
    outside: Annotated[str, typer.Option("--outside", help="Beyond the data: error, hold or climatology.")] = "error",
    outside_time: Annotated[
        str | None, typer.Option("--outside-time", help="The same for times, if different.")
    ] = None,
    climatology: Annotated[
        str | None,
        typer.Option("--climatology", metavar="OCEAN", help="What climatology is; the mean of the data if left out."),
    ] = None,
    at_rest: Annotated[
        bool, typer.Option("--at-rest", help="Read no currents: a file of temperature and salinity alone.")
    ] = False,
    plot: PlotOption = None,
    as_json: JsonOption = False,
) -> None:
    """Show extent, resolution and ranges of an ocean; with --at the water at one point; with --plot a map.

    Example: stommel ocean show east_china_sea --at 28.2,126.6 --depth 50 --plot build/sea.png
    """
    from stommel.ocean.times import seconds

    where, when = place(at), seconds(time) if time is not None else None
    choice = {
        "names": pairs(names, "--name"),
        "parameters": pairs(parameter, "--set"),
        "bounds": bounds(region),
        "between": between(period),
        "at_rest": at_rest,
    }
    policies = {"outside": outside, "outside_time": outside_time, "climatology": climatology}
    found = open_ocean(ocean, choice, policies)
    when = float(found.data.nodes.times[0]) if when is None else when
    sample = found.at(when, *where, depth) if where is not None else None
    written = []
    if plot is not None:
        from stommel.figures.saving import save_figure_as
        from stommel.ocean.pictures.drawing import ocean_figure

        written.append(save_figure_as(ocean_figure(found, when, depth, where), plot))
    answer = found.summary() | {"sample": sample.as_row() if sample is not None else None}
    finish(answer, written, as_json, lambda answer: _show(answer, where, depth))


def _show(answer: dict[str, Any], where: tuple[float, float] | None, depth: float) -> None:
    _show_summary(answer)
    if where is not None:
        typer.echo()
        _show_sample(answer["sample"], where, depth)


def _show_sample(row: dict[str, Any], where: tuple[float, float], depth: float) -> None:
    values = {
        "density": number(row["density_kg_m3"], 4, "kg/m3"),
        "pressure": number(row["pressure_dbar"], 3, "dbar"),
        "temperature": number(row["temperature_c"], 4, "deg C in situ"),
        "salinity": number(row["absolute_salinity_g_kg"], 4, "g/kg"),
        "sound speed": number(row["sound_speed_m_s"], 2, "m/s"),
        "freezes at": number(row["freezing_temperature_c"], 3, "deg C in situ"),
        "current": f"{number(row['current_east_m_s'], 4)} m/s east, {number(row['current_north_m_s'], 4)} m/s north",
        "bottom": "none" if row["bottom_m"] is None else number(row["bottom_m"], 1, "m"),
    }
    notes = ["outside the data: answered by the ocean's policy"] if row["held"] else []
    show_values(f"At {where[0]:g}, {where[1]:g}, {depth:g} m", values, notes)


def _show_summary(row: dict[str, Any]) -> None:
    def span(key: str, digits: int, unit: str) -> str:
        pair = row[key]
        return "everywhere the same" if pair is None else f"{pair[0]:.{digits}f} to {pair[1]:.{digits}f} {unit}"

    values = {
        "time": f"{row['first_time']} to {row['last_time']}, {counted(row['times'], 'slot')}"
        if row["first_time"] != "always"
        else (f"every year the same, {counted(row['times'], 'slot')}" if row["every_year"] else "always"),
        "latitude": span("latitude_deg", 3, "deg"),
        "longitude": span("longitude_deg", 3, "deg"),
        "nodes": f"{row['nodes'][0]} x {row['nodes'][1]}, {row['wet_nodes']} with water"
        + (f", {row['spacing_km']:.3g} km apart" if row["spacing_km"] else ""),
        "levels": f"{row['levels']} down to {row['deepest_level_m']:g} m",
        "bottom": "none" if row["bottom_m"] is None else span("bottom_m", 1, "m"),
        "temperature": span("temperature_c", 2, "deg C in situ"),
        "salinity": span("absolute_salinity_g_kg", 2, "g/kg"),
        "greatest current": number(row["greatest_current_m_s"], 3, "m/s")
        + (f", beside {row['tidal_constituents']} tide" if row["tidal_constituents"] else ""),
        "outside": f"{row['outside']} in space, {row['outside_time']} in time",
        "density": "given directly"
        if row["density_error_kg_m3"] is None
        else f"TEOS-10 within {row['density_error_kg_m3']:.1e} kg/m3",
    }
    show_values(row["name"], values, [f"{key}: {text}" for key, text in row["notes"].items()])
