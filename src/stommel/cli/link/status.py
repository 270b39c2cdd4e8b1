"""`stommel link status`: what the vehicle tells of itself, and how the link to it is."""

import math
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.finish import finish
from stommel.cli.link.line import KeyOption, StateOption, ToOption, UnsignedOption, VehicleOption, WithinOption, line_to
from stommel.cli.numbers import number_option
from stommel.cli.options import JsonOption
from stommel.cli.output import show_notes, show_values

if TYPE_CHECKING:
    from stommel.cli.link.line import Line


def status(
    to: ToOption,
    key: KeyOption = None,
    unsigned: UnsignedOption = False,
    vehicle: VehicleOption = None,
    state: StateOption = None,
    seconds: Annotated[float, number_option("--seconds", 0.5, 3600.0, "s", "How long to listen")] = 6.0,
    within: WithinOption = 30.0,
    as_json: JsonOption = False,
) -> None:
    """Listen to a vehicle: mission, position, attitude, battery, alarms, its last words, and how the link is.

    Example: stommel link status --to serial:/dev/ttyUSB0:57600 --key zju-1.key
    """
    with line_to(to, key, unsigned, vehicle, state) as line:
        line.require_vehicle(within)
        line.until(lambda: False, seconds)
        row = _row(line)
    finish(row, None, as_json, _show)


def _row(line: "Line") -> dict[str, Any]:
    from stommel.link.shore.status import status_of

    end, now = line.end, line.now()
    offset = end.time_sync.offset(end.vehicle, now)
    told = end.statistics.told.get(end.vehicle)
    return {
        "vehicle": end.vehicle[0],
        "status": status_of(end.heard),
        "clock_offset_s": None if offset is None else [offset.low, offset.high],
        "link": link_row(end.link(now)),
        "link_of_the_vehicle": None if told is None else _told(told[1]),
        "signing": end.guard.mode.value,
        "notes": [*end.guard.status, *end.session.notes, *end.commands.notes, *end.parameters.known.notes],
        "texts": [{"severity": text.severity, "words": text.words} for text in end.heard.texts],
    }


def link_row(link: Any) -> dict[str, Any]:
    """Statistics of a link; None for what was not measured."""
    row = {name: value for name, value in link._asdict().items() if name != "refusals"} | {
        f"refused_{name}": value for name, value in link.refusals._asdict().items()
    }
    return {name: None if isinstance(value, float) and math.isnan(value) else value for name, value in row.items()}


def _told(values: dict[str, Any]) -> dict[str, Any]:
    return {name: None if isinstance(value, float) and math.isnan(value) else value for name, value in values.items()}


def _show(row: dict[str, Any]) -> None:
    from stommel.link.shore.status import status_words

    show_values(f"Vehicle {row['vehicle']}", status_words(row["status"]) or {"status": "nothing was told"})
    link, offset = row["link"], row["clock_offset_s"]
    values = {
        "frames": f"{link['good']} good, {link['lost']} lost, {link['bad']} spoilt, {link['duplicate']} twice",
        "signatures": row["signing"],
    }
    if link["round_trip_time"] is not None:
        values["round trip"] = f"{link['round_trip_time']:.2f} s, asked again after {link['time_out']:.2f} s"
    if offset is not None:
        values["vehicle's clock"] = f"{sum(offset) / 2:+.2f} s from ours, known to {(offset[1] - offset[0]) / 2:.2f} s"
    typer.echo()
    show_values("The link", values)
    if row["texts"]:
        typer.echo()
        show_notes(text["words"] for text in row["texts"])
    show_notes(row["notes"], "note")
