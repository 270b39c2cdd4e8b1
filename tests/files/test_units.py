"""Oracle: the spelling of a unit, as a table of its own: what a key ends with says the unit, and says it in one way."""

import importlib
import inspect
import pkgutil
import re
from collections.abc import Iterator
from typing import get_args

import pytest
from pydantic import BaseModel

import stommel
from stommel.errors import FileError
from stommel.files.units import UNITS, unit_of
from stommel.vehicle.loading import builtin_text, vehicle_from_text

PURE = {
    # counts and choices
    "format", "runs", "repeat", "seed", "steps", "seconds", "dives_per_surfacing", "per_surfacing", "steady_steps",
    "moving_steps", "guidance_every",
    "rudder_turns_per_dive", "pitch_corrections_per_dive", "fewest_rows", "stuck_rows", "saturated_rows", "longest_gap",
    "corrosion_grade", "machinability_grade",
    # shares, factors, ratios, coefficients of friction
    "axial_safety_factor", "circumferential_safety_factor", "tensile_safety_factor", "yield_safety_factor",
    "static_friction_factor", "battery_share", "cell_share", "friction_share", "derating_fraction", "usable_fraction",
    "knock_down",
    "stock_chord_fraction", "duty", "efficiency", "driver_efficiency", "gearbox_efficiency", "pitch_drive_efficiency",
    "pump_efficiency", "regulator_efficiency", "weld_efficiency", "friction", "guide_friction", "gearbox_ratio",
    "ratio",
    "poisson_ratio", "polytropic_exponent", "soft_iron", "shielding",
    # in the horizontal field of the earth
    "hard_iron", "pitch_drive_field", "pump_field", "steering_field", "valve_field",
    # in the unit of another key, or of a column
    "at_least", "at_most", "from_", "to", "mean", "median", "standard_deviation", "log_standard_deviation", "values",
    "value", "range", "parameters", "open_valves", "changes",
    # in the unit of the table that they are keys of: actuator_ut and decide_every_s
    "pump", "valve", "pitch_drive", "steering",
    "surface", "descent", "inflection", "ascent", "recovery", "drift",
    # of the vehicle's software: a number by which it is called, a count, shares
    "vehicle_id", "samples", "reserve", "speed_error", "correction",
    # of its radio: shares of packets and bits
    "loss", "bit_error_rate",
    # of a station: numbers by which vehicle and port are called, times real time, limits in the unit of a channel
    "vehicle", "port", "speed", "low", "high", "hysteresis",
    # parameters of the nodes by name, each in the unit that its node's table says
    "motion", "acquisition",
}  # fmt: skip
"""Numbers that have no unit of their own."""


def fields() -> Iterator[tuple[str, object]]:
    """Every key of every file that stommel reads, with its type."""
    for module in pkgutil.walk_packages(stommel.__path__, "stommel."):
        if module.name.startswith(("stommel.station.web.", "stommel.plans.kept_preview")):
            continue  # no files: the API's document says the unit of each field, times are [s since 1970], angles [deg]
        for kind in vars(importlib.import_module(module.name)).values():
            if inspect.isclass(kind) and issubclass(kind, BaseModel) and kind.__module__ == module.name:
                yield from ((key, field.annotation) for key, field in kind.model_fields.items())


def holds_numbers(annotation: object) -> bool:
    if annotation in (int, float):
        return True
    return any(holds_numbers(argument) for argument in get_args(annotation))


NUMBERS = sorted({key for key, annotation in fields() if holds_numbers(annotation)})


def spelt(unit: str) -> str:
    """A unit as a key ends with it: lower case, a dash for every sign between."""
    words = {"deg C": "c", "degrees": "deg", "r/min": "rpm", "A h": "ah", "W h": "wh", "min": "minutes", "h": "hours"}
    if unit in words:
        return words[unit]
    if unit in ("mm/deg", "m/rad"):
        return unit.replace("/", "_per_")
    if " per rad" in unit:
        forces, angle = unit.split(" per ")
        return f"per_{angle}_{spelt(forces)}"
    return re.sub(r"[ /]", "_", unit.replace("1/", "per_").replace("(", "").replace(")", "")).lower()


def test_there_are_keys_to_look_at() -> None:
    assert len(NUMBERS) > 250
    assert {"torque_constant_mn_m_a", "capacity_ah", "every_hours", "longest_hold_hours", "period_hours"} <= set(
        NUMBERS
    )


@pytest.mark.parametrize("key", NUMBERS)
def test_every_number_says_its_unit(key: str) -> None:
    unit = unit_of(key)
    if key in PURE:
        assert unit is None
        return
    assert unit is not None, f"{key}: no unit of stommel/files/units.py fits, and it is not in PURE"
    if key == "seconds_per_surfacing":
        assert unit == "s"
        return
    words, ending = key[: -len(spelt(unit))], key[-len(spelt(unit)) :]
    assert ending == spelt(unit)
    assert words.endswith("_") or not words
    # a torque constant in mn_m_a is no current: what stands before the unit is a word, not more of the unit
    symbols = {part for unit in UNITS.values() for part in spelt(unit).split("_")} - {"minutes"}
    assert words.removesuffix("_").rsplit("_", 1)[-1] not in symbols


@pytest.mark.parametrize("key", NUMBERS)
def test_no_unit_has_a_second_spelling(key: str) -> None:
    """As mnm beside mn_m, or h beside hours."""
    spellings = {spelt(unit) for unit in UNITS.values()}
    joined = {spelling.replace("_", "") for spelling in spellings} - spellings
    others = {"h", "hr", "min", "d", "hour", "minute", "day", "degc", "degrees"}
    assert key.endswith("_ml_min") or key.rsplit("_", 1)[-1] not in joined | others


def test_an_index_belongs_to_its_list() -> None:
    assert unit_of("rigid_body.centre_of_mass_m.2") == "m"
    assert unit_of("rigid_body.inertia_kg_m2.0.1") == "kg m2"


@pytest.mark.parametrize(
    ("table", "old", "new", "unit"),
    [
        ("drives.pitch.motor", "torque_constant_mnm_a", "torque_constant_mn_m_a", "mN m/A"),
        ("drives.rudder", "seal_friction_mnm", "seal_friction_mn_m", "mN m"),
        ("drives.rudder.brake", "holding_torque_mnm", "holding_torque_mn_m", "mN m"),
    ],
)
def test_the_former_spelling_is_refused_with_the_new_one(table: str, old: str, new: str, unit: str) -> None:
    text = builtin_text("zju")
    head, tail = text.split(f"[{table}]", 1)
    assert new in tail
    with pytest.raises(FileError) as caught:
        vehicle_from_text(f"{head}[{table}]{tail.replace(new, old, 1)}", "mine.toml")
    (first, *_) = caught.value.problems
    assert str(first).startswith(f"mine.toml: {table}.{old}: unknown key in [{table}]")
    assert f"did you mean {new} (in {unit})?" in str(first)
