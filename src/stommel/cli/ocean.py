"""`stommel ocean`: what an ocean covers, its water at one point, a map."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.options import JsonOption
from stommel.cli.output import number, show_json, show_values
from stommel.errors import StommelError
from stommel.files.opening import names_file

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from stommel.ocean import Ocean, Sample

ocean_app = typer.Typer(no_args_is_help=True, help="The ocean around a mission: what it covers, values, maps.")


_DEEPEST_M = 11300.0
"""As `stommel.ocean.answers.DEEPEST`, which is not imported at the start."""


class OceanOptionError(StommelError):
    """An option that does not say what it should."""


@ocean_app.command("show")
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
    depth: Annotated[float, typer.Option("--depth", help="Depth [m].")] = 0.0,
    parameter: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="NAME=VALUE", help="Parameter of an analytic ocean or of a profile's."),
    ] = None,
    names: Annotated[
        list[str] | None,
        typer.Option("--name", metavar="WHAT=VARIABLE", help="Variable of a file, or column of a profile."),
    ] = None,
    bounds: Annotated[
        str | None, typer.Option("--bounds", metavar="S,N,W,E", help="Region of a file to read [deg].")
    ] = None,
    between: Annotated[
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
    plot: Annotated[
        Path | None, typer.Option("--plot", metavar="STEM", help="Map to write as PNG and SVG, without its ending.")
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """Show extent, resolution and ranges of an ocean; with --at the water at one point; with --plot a map.

    Example: stommel ocean show east_china_sea --at 28.2,126.6 --depth 50 --plot build/sea
    """
    from stommel.ocean.times import seconds

    place = _place(at) if at is not None else None
    when = seconds(time) if time is not None else None
    if not 0.0 <= depth <= _DEEPEST_M:
        raise OceanOptionError(f"--depth {depth:g}: must be between 0 and {_DEEPEST_M:g} m")
    if plot is not None and not plot.name:
        raise OceanOptionError(f"--plot {str(plot)!r}: must name a picture, as build/sea")
    choice = {
        "names": _pairs(names or [], "--name"),
        "parameters": _pairs(parameter or [], "--set"),
        "bounds": _bounds(bounds),
        "between": _between(between),
        "at_rest": at_rest,
    }
    policies = {"outside": outside, "outside_time": outside_time, "climatology": climatology}
    found = _open(ocean, choice, policies)
    when = float(found.data.nodes.times[0]) if when is None else when
    sample = found.at(when, *place, depth) if place is not None else None
    summary = found.summary()
    plots: list[Path] = []
    if plot is not None:
        from stommel.figures.saving import save_figure

        plots = save_figure(_figure(found, when, depth, place), plot)
    if as_json:
        show_json(summary | {"sample": _as_row(sample) if sample else None, "plots": [str(path) for path in plots]})
        return
    _show_summary(summary)
    if sample is not None and place is not None:
        typer.echo()
        _show_sample(sample, place, depth)
    for path in plots:
        typer.echo(f"wrote {path}")


@ocean_app.command("list")
def list_oceans(as_json: JsonOption = False) -> None:
    """List the analytic oceans with their parameters and defaults.

    Example: stommel ocean list
    """
    from stommel.ocean.analytic.catalogue import ANALYTIC

    rows: dict[str, dict[str, Any]] = {
        name: {"summary": (kind.__doc__ or "").strip(), "parameters": _defaults(kind)}
        for name, kind in ANALYTIC.items()
    }
    if as_json:
        show_json(rows)
        return
    for name, row in rows.items():
        values = {key: "none" if value is None else f"{value:g}" for key, value in row["parameters"].items()}
        show_values(f"{name}: {row['summary']}", values)


def _defaults(kind: Any) -> dict[str, float | None]:
    return {key: field.default for key, field in kind.model_fields.items()}


def _open(given: list[str], choice: dict[str, Any], policies: dict[str, Any]) -> "Ocean":
    """Open the ocean of that name, or else the files."""
    from stommel.ocean import Ocean
    from stommel.ocean.analytic.catalogue import ANALYTIC

    if given[0] in ANALYTIC:
        if len(given) > 1:
            raise OceanOptionError(f"{given[0]}: an analytic ocean stands alone; {given[1]} is too much")
        unfit = [key for key in ("names", "bounds", "between", "at_rest") if choice[key]]
        if unfit:
            option = "--" + unfit[0].removesuffix("s" if unfit[0] == "names" else "").replace("_", "-")
            raise OceanOptionError(f"{option}: {given[0]} is an analytic ocean; only a file has this option")
        return Ocean.analytic(given[0], **choice["parameters"]).with_outside(**policies)
    if len(given) == 1 and not _looks_like_a_file(given[0]):
        raise OceanOptionError(
            f"ocean {given[0]!r} is neither an analytic ocean nor a file; analytic: {', '.join(ANALYTIC)}"
        )
    return Ocean.open(given, **choice, **policies)


def _looks_like_a_file(name: str) -> bool:
    return names_file(name) or any(mark in name for mark in "*?[")


def _pairs(texts: list[str], option: str) -> dict[str, str]:
    wrong = [text for text in texts if not text.partition("=")[0].strip() or "=" not in text]
    if wrong:
        raise OceanOptionError(f"{option} {wrong[0]}: must be like NAME=VALUE")
    return {key.strip(): value.strip() for key, value in (text.split("=", 1) for text in texts)}


def _place(text: str) -> tuple[float, float]:
    latitude, longitude = _numbers(text, 2, f"--at {text!r}: must be a latitude and a longitude like 28.2,126.6")
    return latitude, longitude


def _bounds(text: str | None) -> tuple[float, float, float, float] | None:
    if text is None:
        return None
    south, north, west, east = _numbers(
        text, 4, f"--bounds {text!r}: must be south, north, west, east like 25,32,120,130"
    )
    return south, north, west, east


def _numbers(text: str, count: int, refusal: str) -> list[float]:
    try:
        found = [float(part) for part in text.split(",")]
    except ValueError:
        raise OceanOptionError(refusal) from None
    if len(found) != count or not all(abs(value) <= 720.0 for value in found):
        raise OceanOptionError(refusal)
    return found


def _between(text: str | None) -> tuple[str, str] | None:
    if text is None:
        return None
    parts = text.split(",")
    if len(parts) != 2:
        raise OceanOptionError(f"--between {text!r}: must be two times like 2016-02-01,2016-02-05T12:00")
    return parts[0], parts[1]


def _figure(found: "Ocean", when: float, depth: float, place: tuple[float, float] | None) -> "Figure":
    from stommel.figures.style import new_figure, styled
    from stommel.ocean.pictures.drawing import draw_ocean

    @styled
    def figure_of() -> "Figure":
        figure = new_figure(11.0, 6.0) if found.grid().x.size > 1 else new_figure(5.0, 6.0)
        draw_ocean(figure, found, when, depth, place)
        return figure

    return figure_of()


def _as_row(sample: "Sample") -> dict[str, Any]:
    bottom = sample.bottom_depth
    return {
        "density_kg_m3": sample.density,
        "pressure_dbar": sample.pressure / 1e4,
        "temperature_c": sample.temperature,
        "conservative_temperature_c": sample.conservative_temperature,
        "absolute_salinity_g_kg": sample.absolute_salinity,
        "sound_speed_m_s": sample.sound_speed,
        "freezing_temperature_c": sample.freezing_temperature,
        "current_east_m_s": sample.current_east,
        "current_north_m_s": sample.current_north,
        "bottom_m": None if bottom == float("inf") else bottom,
        "held": sample.held,
    }


def _show_sample(sample: "Sample", place: tuple[float, float], depth: float) -> None:
    row = _as_row(sample)
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
    notes = ["outside the data: answered by the ocean's policy"] if sample.held else []
    show_values(f"At {place[0]:g}, {place[1]:g}, {depth:g} m", values, notes)


def _show_summary(row: dict[str, Any]) -> None:
    def span(key: str, digits: int, unit: str) -> str:
        pair = row[key]
        return "everywhere the same" if pair is None else f"{pair[0]:.{digits}f} to {pair[1]:.{digits}f} {unit}"

    values = {
        "time": f"{row['first_time']} to {row['last_time']}, {row['times']} slots"
        if row["first_time"] != "always"
        else (f"every year the same, {row['times']} slots" if row["every_year"] else "always"),
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
