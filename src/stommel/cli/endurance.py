"""`stommel endurance`: how long and how far one charge lasts, and what it rests on."""

from typing import TYPE_CHECKING, Annotated

import typer

from stommel.cli.finish import finish
from stommel.cli.numbers import number_option
from stommel.cli.options import (
    ANGLES,
    DEPTHS,
    SPEEDS,
    JsonOption,
    PhysicsChoice,
    PhysicsOption,
    VehicleArgument,
    load,
    physics_of,
)
from stommel.cli.output import number, show_entries, show_notes, show_table, show_values
from stommel.cli.paths import PlotOption
from stommel.files.units import counted

if TYPE_CHECKING:
    from stommel.design.endurance import BestFlight, Endurance, EnergyStudy, Gap, Interval, Sensitivity
    from stommel.design.endurance.sea import Sea

MOST_SHOWN = 12


def endurance(
    vehicle: VehicleArgument,
    depth: Annotated[
        float | None, number_option("--depth", *DEPTHS, "m", "Depth of dives; as specified if left out")
    ] = None,
    speed: Annotated[
        float | None, number_option("--speed", *SPEEDS, "m/s", "Speed along the path; as specified if left out")
    ] = None,
    pitch: Annotated[
        float | None,
        number_option("--pitch", *ANGLES, "deg", "Pitch of the dives, negative; as specified if left out"),
    ] = None,
    temperature: Annotated[
        float | None,
        number_option("--temperature", -3, 45, "deg C", "Temperature of the water; the file's if left out"),
    ] = None,
    ocean: Annotated[
        str | None,
        typer.Option("--ocean", help="Analytic ocean, ocean file or profile, for stratification and temperature."),
    ] = None,
    at: Annotated[str | None, typer.Option("--at", metavar="LAT,LON", help="Place in the ocean [deg].")] = None,
    time: Annotated[
        str | None, typer.Option("--time", help="ISO 8601 time, UTC; the ocean's first if left out.")
    ] = None,
    physics: PhysicsOption = PhysicsChoice.paper,
    plot: PlotOption = None,
    as_json: JsonOption = False,
) -> None:
    """Energy of a dive by part, endurance, range, best flights, and what each assumption is worth.

    Example: stommel endurance zju --depth 200 --speed 0.4 --pitch -35
    """
    from stommel.design.endurance import energy_study

    study = energy_study(
        load(vehicle),
        speed_m_s=speed,
        pitch_deg=pitch,
        depth_m=depth,
        temperature_c=temperature,
        sea=_sea(ocean, at, time),
        physics=physics_of(physics),
    )
    written = []
    if plot is not None:
        from stommel.design.endurance.figure import endurance_figure
        from stommel.figures.saving import save_figure_as

        written.append(save_figure_as(endurance_figure(study), plot))
    finish(study, written, as_json, _show)


def _sea(ocean: str | None, at: str | None, time: str | None) -> "Sea | None":
    """The ocean that the options choose."""
    from stommel.cli.ocean.choice import OceanOptionError, open_ocean, place

    if ocean is None:
        if at is not None or time is not None:
            raise OceanOptionError(f"{'--at' if at is not None else '--time'}: needs --ocean")
        return None
    where = place(at)
    if where is None:
        raise OceanOptionError("--ocean: needs a place, --at LATITUDE,LONGITUDE like 28.2,126.6")
    from stommel.design.endurance.sea import Sea
    from stommel.ocean.times import seconds

    found = open_ocean(
        [ocean],
        {"names": {}, "units": {}, "parameters": {}, "bounds": None, "between": None, "at_rest": False},
        {"outside": "error"},
    )
    when = float(found.data.nodes.times[0]) if time is None else seconds(time)
    return Sea(found, when, *where)


def _show(study: "EnergyStudy") -> None:
    _show_answer(study)
    _show_parts(study)
    _show_best(study)
    if study.gap is not None:
        _show_gap(study.gap)
    _show_sensitivity(study)
    _show_assumptions(study)


def _show_answer(study: "EnergyStudy") -> None:
    result, cycle, stored = study.result, study.result.cycle, study.result.stored
    wanted = result.wanted
    asked = ""
    if study.target_days is not None:
        asked = f"; {counted(study.target_days, 'day')} asked: {'met' if study.gap is None else 'NOT MET'}"
    minutes = float(cycle.duration_s) / 60.0
    sea = {"sea": _sea_in_words(result)} if result.sea is not None else {}
    show_values(
        f"{study.vehicle.name}: dives to {wanted.depth_m:g} m at {wanted.speed_m_s:g} m/s, "
        f"pitch {wanted.pitch_deg:g} deg",
        sea
        | {
            "endurance": f"{counted(number(result.days, 1), 'day')}{asked}",
            "between": _interval_in_words(study.interval),
            "range": f"{result.range_m / 1e3:.0f} km in still water",
            "dives": f"{result.dives:.0f} of {minutes:.1f} minutes, {float(cycle.surface_s):.0f} s at the surface",
            "mean power": f"{result.mean_power_w:.2f} W",
            "battery": f"{stored.usable_j / 3.6e6:.3f} of {stored.rated_j / 3.6e6:.3f} kWh usable, at "
            f"{result.model.temperature_c:g} deg C",
            "ballast": f"{result.ballast_swing_m3 * 1e6:.0f} ml from dive to climb, "
            f"{_pressure_mpa(study):.2f} MPa at depth",
        },
    )


def _sea_in_words(result: "Endurance") -> str:
    """Where it dives, and whether the water lets it fly as slowly as wanted."""
    sea = result.sea
    assert sea is not None
    place = f"{sea.ocean.name} at {sea.latitude_deg:g}, {sea.longitude_deg:g}"
    if result.flown_speed_m_s > 1.01 * result.wanted.speed_m_s:
        return f"{place}; its stratification makes the dives {result.flown_speed_m_s:.3g} m/s on average"
    return place


def _interval_in_words(interval: "Interval") -> str:
    """How sure the endurance is."""
    least = "none" if interval.least is None else number(interval.least, 1)
    most = "none" if interval.most is None else number(interval.most, 1)
    return (
        f"{number(interval.likely_least, 1)} and {number(interval.likely_most, 1)} days with every uncertain number in "
        f"its range; {least} and {most} with all of them at one end"
    )


def _pressure_mpa(study: "EnergyStudy") -> float:
    """Pressure at the depth of the dive [MPa]."""
    return float(study.result.model.pressure(study.result.wanted.depth_m)) / 1e6


def _show_parts(study: "EnergyStudy") -> None:
    energies = study.result.energy_per_dive_j
    total, time = sum(energies.values()), float(study.result.cycle.duration_s)
    rows = [
        [name, number(energy, 0), number(energy / time, 3), number(100.0 * energy / total, 1)]
        for name, energy in sorted(energies.items(), key=lambda item: -item[1])
    ]
    rows.append(["all", number(total, 0), number(total / time, 3), number(100.0, 1)])
    show_table("Energy of a dive, from the battery", ["part", "energy\nJ", "mean\nW", "share\n%"], rows)


def _show_best(study: "EnergyStudy") -> None:
    def words(best: "BestFlight") -> str:
        at = f"{best.speed_m_s:.3f} m/s, pitch {best.pitch_deg:.1f} deg, {best.depth_m:.0f} m"
        return f"{best.endurance_s / 86400.0:.1f} days, {best.range_m / 1e3:.0f} km: {at}"

    def limits(best: "BestFlight") -> str:
        return "limited by " + (", ".join(best.limits) or "nothing: an optimum inside the envelope")

    longest, farthest = study.best.longest, study.best.farthest
    show_values(
        "Best dives within the vehicle's limits",
        {
            "longest": words(longest),
            "": limits(longest),
            "farthest": words(farthest),
            " ": limits(farthest),
        },
    )


def _show_gap(gap: "Gap") -> None:
    rows = [
        [f"{step.sensitivity.assumption.what}", f"{step.sensitivity.assumption.value:.4g}", f"{step.value:.4g}",
         number(step.days, 1)]
        for step in gap.steps
    ]  # fmt: skip
    alone = [
        f"Alone would do: {one.assumption.key} = {one.needed:.4g} instead of {one.assumption.value:.4g}"
        for one in gap.alone
        if one.needed is not None
    ]
    end = f"Only the {len(gap.steps)} together reach it." if gap.closed else "All of them together do not reach it."
    show_table(
        f"{counted(gap.target_days, 'day allows', 'days allow')} {gap.allowed_power_w:.2f} W: "
        f"{gap.missing_power_w:.2f} W too much\n"
        "Uncertain numbers at the favourable ends of their ranges, one upon the other",
        ["number", "is", "taken as", "days"],
        rows,
        [end, *alone],
    )


def _show_sensitivity(study: "EnergyStudy") -> None:
    def row(one: "Sensitivity") -> list[str]:
        a = one.assumption
        unit = "" if a.unit == "1" else f" {a.unit}"
        return [
            a.what,
            f"{a.value:.4g}{unit}",
            f"{one.elasticity:+.3f}",
            f"{number(one.days_at_low, 1)} to {number(one.days_at_high, 1)}",
        ]

    show_table(
        "Sensitivity: each number over its range, 30 % where none is stated; with a source 10 %",
        ["number", "value", "elasticity", "days"],
        [row(one) for one in study.sensitivities[:MOST_SHOWN]],
        [f"{len(study.sensitivities) - MOST_SHOWN} more with --json."] if len(study.sensitivities) > MOST_SHOWN else [],
    )


def _show_assumptions(study: "EnergyStudy") -> None:
    """Key, value and span on one line; what kind of number it is, and why, below."""
    from stommel.design.endurance.study import MODEL_ASSUMPTIONS

    assumed = [one for one in study.sensitivities if one.assumption.origin.kind not in ("source", "chosen")]
    entries = []
    for one in sorted(assumed, key=lambda one: one.assumption.key):
        a = one.assumption
        unit = "" if a.unit == "1" else f" {a.unit}"
        span = f"{one.low:.4g} to {one.high:.4g}"
        stated = "" if a.origin.range is not None else " (no range is stated)"
        entries.append(
            (f"{a.key} = {a.value:.4g}{unit}; {span}{stated}", f"{a.origin.kind}: {a.origin.text}".removesuffix(": "))
        )
    show_entries("What has no source, and between what it is taken to lie", entries)
    show_notes(MODEL_ASSUMPTIONS, "assumption of the balance")
