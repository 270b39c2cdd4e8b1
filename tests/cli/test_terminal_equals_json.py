"""Every cell and every named value that a verb prints is the number that `--json` gives under that name.

The oracle is the JSON of the same call; which key belongs below which words is written here, verb by verb. A column or
a value that is not named here fails as well. What the JSON says is held against the library in
`test_json_equals_library`.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from importlib import import_module
from math import cos, radians, sin
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import typer

from stommel.cli.app import app
from stommel.vehicle import load_vehicle
from tests.onboard.coordination.magnetic_vehicle import MagneticVehicle, samples_text
from tests.support.command import run_here
from tests.support.terminal import Shown, numbers_in, same, tables, values

Row = Any
Columns = dict[str, Callable[[Row], Any] | str | None]
"""What stands in a column: a key of the row or what follows from it; None for words that no number stands in."""


@dataclass(frozen=True)
class Told:
    """A call, and what belongs to what it prints."""

    call: str
    tables: dict[str, tuple[Callable[[Any], list[Row]], Columns]] = field(default_factory=dict)
    """By the begin of a title: rows from the JSON, and what each column shows."""
    values: Callable[[Any], dict[str, Any]] = lambda _: {}
    """From the JSON what each named value shows; None where it holds no number."""


def flight(d: Any) -> dict[str, Any]:
    return {
        "speed": d["speed_m_s"],
        "pitch": d["pitch_deg"],
        "glide path": d["glide_path_deg"],
        "angle of attack": d["angle_of_attack_deg"],
        "residual": d["residual"],
    }


def wings_level(d: Any) -> dict[str, Any]:
    path = radians(d["glide_path_deg"])
    return flight(d) | {
        "moving mass position": d["moving_mass_position_mm"],
        "ballast volume": d["ballast_volume_ml"],
        "horizontal speed": d["speed_m_s"] * cos(path),
        "sinking speed": -d["speed_m_s"] * sin(path),
    }


def turning(d: Any) -> dict[str, Any]:
    straight = d["radius_m"] is None
    return flight(d) | {
        "sideslip": d["sideslip_deg"],
        "roll": d["roll_deg"],
        "turn rate": "straight" if straight else d["turn_rate_rad_s"],
        "radius": "straight" if straight else d["radius_m"],
        "moving mass position": d["moving_mass_position_mm"],
        "ballast volume": d["ballast_volume_ml"],
        "stable": None,
    }


def best(d: Any) -> dict[str, Any]:
    glide, fast = d["best_glide"], d["fastest"]
    ratio = glide["horizontal_speed_m_s"] / glide["sinking_speed_m_s"]
    return {
        "best glide": [ratio, glide["glide_path_deg"], glide["pitch_deg"]],
        "fastest": [fast["horizontal_speed_m_s"], fast["speed_m_s"], fast["pitch_deg"]],
    }


def needed(d: Any) -> dict[str, Any]:
    n = d["needs"]
    return {
        "moving mass": [n["moving_mass_travel_mm"], n["moving_mass_travel_choice_mm"]],
        "ballast": [n["ballast_volume_ml"], n["ballast_volume_choice_ml"]],
    }


def upper(modes: Any) -> list[Row]:
    """One of each pair."""
    return [mode for mode in modes if mode["imag"] >= 0.0]


def eigenvalue(mode: Row) -> Any:
    return [mode["real"], mode["imag"]] if mode["imag"] else mode["real"]


MODES: Columns = {
    "mode": "name",
    "eigenvalue 1/s": eigenvalue,
    "damping ratio": "damping_ratio",
    "period s": lambda mode: mode["period_s"] if mode["imag"] else None,
    "time constant s": "time_constant_s",
    "time to half s": "time_to_half_s",
}


def authority(d: Any) -> dict[str, Any]:
    a = d["authority"]
    return {
        "pitch per moving mass": a["pitch_deg_per_mm"],
        "speed per ballast": a["speed_m_s_per_ml"] * 1e3,
        "peak pitch rate": a["peak_pitch_rate_deg_s_per_mm"],
        "initial pitch acceleration": a["initial_pitch_acceleration_deg_s2_per_mm"],
        "turn rate per rudder": a["turn_rate_deg_s_per_rudder_deg"],
    }


def spectrum(found: Any) -> list[float]:
    """Numbers of the eigenvalues below each other, one of each pair."""
    told: list[float] = []
    for value in upper(found):
        told += [value["real"], value["imag"]] if value["imag"] else [value["real"]]
    return told


def hull_values(d: Any) -> dict[str, Any]:
    own, caps = d["own"], d["own"]["end_caps"]
    return {
        "mass of the tube": own["mass_kg"],
        "displaced volume": own["displaced_volume_l"],
        "compressibility": own["compressibility_per_pa"],
        "end caps": [caps["flat_supported_mm"], caps["flat_clamped_mm"], caps["hemisphere_mm"]],
    }


def criterion(row: Row) -> str:
    name = str(row["name"]).replace("circumferential", "circumf.")
    return name + (f" (n = {row['lobes']})" if row["lobes"] else "")


def engine_values(d: Any) -> dict[str, Any]:
    phase = d["phases"][0]
    losses = {f"lost: {name.replace('_', ' ')}": joules for name, joules in phase["losses_j"].items() if joules > 0.0}
    return {
        "from the supply": phase["energy_j"],
        "against the sea": phase["sea_work_j"],
        "on the hull's gas": phase["hull_gas_work_j"],
    } | losses


def drive_values(d: Any) -> dict[str, Any]:
    pitch, rudder, turn = d["pitch"], d["rudder"], d["rudder"]["turn"]
    start = pitch["hardest_start"]
    motor_stalls_at = start["stall_margin"] * start["starting_torque_mn_m"]
    found = {
        "screw": pitch["screw"]["efficiency"],
        "worm": pitch["worm"]["efficiency"],
        "whole drive": pitch["efficiency"],
        f"start at {abs(start['pitch_deg']):g} deg": [
            start["starting_torque_mn_m"], motor_stalls_at, start["stall_margin"],
        ],
        "hinge moment": [
            rudder["hinge_moment_mn_m"], rudder["speed_through_water_m_s"],
            load_vehicle("zju").description.drives.rudder.seal_friction_mn_m,  # type: ignore[union-attr]
        ],
        "full step": [
            rudder["full_step"][key] for key in ("from_deg", "to_deg", "time_s", "greatest_torque_mn_m",
                                                 "greatest_current_a")
        ],
        "brake": rudder["holding_margin"],
        f"turn to {turn['angle_deg']:g} deg": [
            turn["energy_j"], turn["motor_energy_j"], 2, turn["brake_energy_per_release_j"], turn["hold_s"],
            turn["hold_energy_j"],
        ],
    }  # fmt: skip
    for words in ("dive to climb", "climb to dive"):
        change = pitch[words.replace(" ", "_")]
        found[words] = [change[key] for key in ("from_mm", "to_mm", "time_s", "energy_j", "mean_speed_mm_s")]
        found[f"{words}, worst"] = [change["longest_time_s"], change["greatest_energy_j"]]
    for run in pitch["over_runs"]:
        room = abs(run["stop_mm"] - run["switch_mm"])
        found[f"{run['end']} end"] = [run["switch_mm"], run["run_on_mm"], room, run["stall_thrust_n"]]
    return found


def budget_values(d: Any) -> dict[str, Any]:
    body, trimming = d["rigid_body"], d["trimming"]
    inertia, left = body["inertia_kg_m2"], body["left_for_water_kg_m2"]
    found = {
        "m_rb, m_p, m_b": [body["mass_kg"], d["moving_mass_kg"], d["ballast_kg"]],
        "r_rb": body["centre_of_mass_m"],
        "J_rb about origin": [inertia[0][0], inertia[1][1], inertia[2][2], inertia[0][2]],
        "left for the water": [left[k][k] for k in range(3)],
        "spheroid's water": body["spheroid_added_inertia_kg_m2"],
        "centre of buoyancy": d["centre_of_buoyancy_m"],
        "centre of mass": d["stability_arm_mm"],
        "neutral in": d["neutral_density_kg_m3"],
        "as it is": [trimming["surplus_buoyancy_kg"], trimming["moment_kg_m"][0]],
        "trimmed": [trimming["mass_kg"], trimming["stability_arm_mm"]],
    }
    words = {"lead": "add trim weight", "foam": "add foam", "removed": "take out"}
    for body in trimming["added"]:
        found[words[body["material"]]] = [
            abs(body["mass_kg"]), body["volume_ml"] / 1e3, *body["position_m"],
        ]  # fmt: skip
    return found


def endurance_values(d: Any) -> dict[str, Any]:
    cycle, battery, between = d["cycle"], d["battery"], d["interval_days"]
    best_of = {
        words: [
            found["endurance_days"], found["range_km"], found["speed_m_s"], found["pitch_deg"], found["depth_m"],
        ]
        for words, found in (("longest", d["best_for_endurance"]), ("farthest", d["best_for_range"]))
    }  # fmt: skip
    pressure = 1000.0 * 9.81 * d["depth_m"] / 1e6  # of the file's water
    return best_of | {
        "endurance": [d["endurance_days"], d["target_days"]],
        "between": [between[key] for key in ("likely_least", "likely_most", "all_unfavourable", "all_favourable")],
        "range": d["range_km"],
        "dives": [d["dives"], cycle["duration_s"] / 60.0, cycle["surface_s"]],
        "mean power": d["mean_power_w"],
        "battery": [battery["usable_wh"] / 1e3, battery["rated_wh"] / 1e3, battery["temperature_c"]],
        "ballast": [cycle["ballast_swing_ml"], pressure],
    }


def parts(energies: dict[str, float], *, time: float | None = None) -> list[Row]:
    """Parts with the greatest first, and all of them together."""
    total = sum(energies.values())
    ranked = sorted(energies.items(), key=lambda item: -item[1])
    rows = [{"part": name.replace("_", " "), "energy": joules} for name, joules in [*ranked, ("all", total)]]
    return [row | {"mean": row["energy"] / (time or 1.0), "share": 100.0 * row["energy"] / total} for row in rows]


ENERGY: Columns = {"part": "part", "energy J": "energy", "mean W": "mean", "share %": "share"}


def sensitivity_days(row: Row) -> list[float]:
    return [row["endurance_days_at_low"], row["endurance_days_at_high"]]


def value_with_unit(row: Row) -> str:
    return f"{row['value']:.4g}" + ("" if row["unit"] == "1" else f" {row['unit']}")


def design_values(d: Any) -> dict[str, Any]:
    ranges, glide, fast, turn = d["ranges"], d["best_glide"], d["fastest"], d["turns"][-1]
    found: dict[str, Any] = {
        "moving-mass travel": [ranges["moving_mass_travel_mm"], ranges["moving_mass_travel_choice_mm"]],
        "ballast volume": [ranges["ballast_volume_ml"], ranges["ballast_volume_choice_ml"]],
        "best glide": [glide["horizontal_speed_m_s"] / glide["sinking_speed_m_s"], 1, glide["glide_path_deg"]],
        "fastest over ground": [fast["horizontal_speed_m_s"], fast["pitch_deg"]],
        "stability": None,
        "tightest turn computed": [turn["radius_m"], turn["turn_rate_rad_s"] * 57.29577951308232],
    }
    for table in d["tables"]:
        worst = [
            max(abs(row[ours] - row["published"][theirs]) for row in table["rows"])
            for ours, theirs in (
                ("moving_mass_position_mm", "moving_mass_mm"), ("angle_of_attack_deg", "angle_of_attack_deg"),
                ("ballast_volume_ml", "ballast_ml"),
            )
        ]  # fmt: skip
        found[table["title"].split(":")[0]] = worst
    return found


def requirement(row: Row) -> str:
    return f"{row['required']:g} {row['unit']}"


def found_of(row: Row) -> Any:
    if row["found"] is None:
        return "none" if row["met"] is False else None
    return f"{row['found']:.4g} {row['unit']}"


def simulated(d: Any) -> dict[str, Any]:
    km = [d[f"distance_{way}_km"] for way in ("made_good", "over_ground", "through_water")]
    return {
        "mission": None,
        "outcome": d["outcome"],
        "time": [d["days"] * 1440.0, d["dives"], d["deepest_m"]],
        "distance": [1e3 * length for length in km],
        "seed": d["seed"],
        "battery": [d["battery_left_wh"], d["battery_wh"], 100.0 * d["battery_left_share"], d["days_left"],
                    d["mean_power_w"]],
        "voltage": [d["battery_end_v"], d["battery_least_v"]],
        "navigation": [d["reckoning_error_m"]["mean"], d["reckoning_error_m"]["greatest"]],
        "current": [d["current_error_m_s"]["mean"], d["current_error_m_s"]["greatest"]],
        "speed": [d[key] for key in ("flown_speed_m_s", "asked_speed_m_s") if d[key] is not None],
        "CTD": d["ctd_samples"],
        "events": ", ".join(f"{name}: {count}" for name, count in d["events"].items()) or "none",
    }  # fmt: skip


WAYPOINTS: Columns = {
    "no.": "number",
    "reached UTC": lambda w: w["reached_utc"][5:16].replace("T", " ") if w["reached"] else "no",
    "nearest m": "closest_m",
    "to go km": lambda w: w["distance_at_end_m"] / 1e3,
    "leg km": "leg_length_km",
    "time h": "leg_time_hours",
    "made good m/s": "leg_made_good_m_s",
    "off line m": "beside_line_greatest_m",
}


def in_the_loop(d: Any) -> dict[str, Any]:
    return {
        "state": d["state"],
        "alarms": ", ".join(f"{alarm['name']} since {alarm['since_s']:.0f} s" for alarm in d["alarms"]) or "none",
        "nodes": d["nodes"],
        "bus": [
            100.0 * d["bus_load_share"], d["frames_to_coordinator"], d["frames_lost"], d["frames_rejected"],
        ],
        "radio": [
            d["radio"]["sent_bytes"] / 1e3,
            *(d["radio"][f"frames_{what}"] for what in ("heard", "lost", "refused")),
        ],
    }  # fmt: skip


def calibrated(d: Any) -> dict[str, Any]:
    return {
        "hard iron": d["hard_iron_ut"],
        "Earth's field": [d["strength_ut"], d["inclination_deg"]],
        "left over": [d["residual_ut"], d["residual_inclination_deg"]],
        "heading": [d["heading_error_deg"], d["raw_heading_error_deg"]],
        "coverage": [d["heading_gap_deg"], *d["pitch_deg"], *d["roll_deg"]],
        "soft iron's correction": [number for row in d["correction"] for number in row],
    }


CHOICE: Columns = {
    "speed r/min": "motor_speed_rpm",
    "K J/mm": "mean_consumption_j_per_mm",
    "500 ml s": "inflating_time_s",
    "": None,
}


def ocean_values(d: Any) -> dict[str, Any]:
    s = d["sample"]
    return {
        "time": None,
        "latitude": d["latitude_deg"],
        "longitude": d["longitude_deg"],
        "nodes": [*d["nodes"], d["wet_nodes"], d["spacing_km"]],
        "levels": [d["levels"], d["deepest_level_m"]],
        "greatest current": [d["greatest_current_m_s"], d["tidal_constituents"]],
        "outside": None,
        "temperature": s["temperature_c"],
        "salinity": s["absolute_salinity_g_kg"],
        "bottom": s["bottom_m"],
        "density": s["density_kg_m3"],
        "pressure": s["pressure_dbar"],
        "sound speed": s["sound_speed_m_s"],
        "freezes at": s["freezing_temperature_c"],
        "current": [s["current_east_m_s"], s["current_north_m_s"]],
    }


def shown_flights(d: Any) -> list[Row]:
    """Those with the most ballast, of the pitches that are shown."""
    most = max(row["ballast_ml"] for row in d["flights"])
    pitches = sorted({abs(row["pitch_deg"]) for row in d["flights"]})[::4]
    rows = [r for r in d["flights"] if abs(r["ballast_ml"]) == most
            and any(abs(abs(r["pitch_deg"]) - p) < 1e-9 for p in pitches)]  # fmt: skip
    return sorted(rows, key=lambda row: float(row["pitch_deg"]))


FIT_UNITS = {
    "displacement_m3_rev": 1e6, "leakage_m3_s_pa": 1e12, "pump_friction_n_m": 1.0,
}  # fmt: skip


def fitted(key: str, index: int | None = None) -> Callable[[Row], Any]:
    def read(row: Row) -> float:
        value = row[key] if index is None else row[key][index]
        return float(f"{float(value) * FIT_UNITS[row['name']]:.4g}")

    return read


ALL = [
    Told("trim zju --speed 0.43 --pitch -31", values=wings_level),
    Told("trim zju --speed 0.43 --pitch 27 --physics full", values=wings_level),
    Told(
        "table zju --speed 0.3,0.8 --pitch -20,50",
        {
            "ZJU glider: wings-level": (
                lambda d: d["rows"],
                {
                    "speed m/s": "speed_m_s",
                    "pitch deg": "pitch_deg",
                    "moving mass mm": "moving_mass_position_mm",
                    "angle of attack deg": "angle_of_attack_deg",
                    "ballast ml": "ballast_volume_ml",
                    "glide path deg": "glide_path_deg",
                },
            )
        },
    ),
    Told(
        "steady zju --moving-mass-mm 421 --ballast-ml -200 --rudder-deg 12",
        values=lambda d: turning(d) | {"rudder": d["rudder_deg"]},
    ),
    Told(
        "turn seawing --speed 0.4 --pitch -30 --turn-rate -0.005",
        values=lambda d: turning(d) | {"roll of moving mass": d["roll_mass_deg"]},
    ),
    Told(
        "envelope zju",
        {
            "ZJU glider: reachable": (
                lambda d: d["reach"],
                {
                    "pitch deg": "pitch_deg",
                    "slowest m/s": "minimum_speed_m_s",
                    "fastest m/s": "maximum_speed_m_s",
                    "over ground m/s": "maximum_horizontal_speed_m_s",
                    "limited by": "limited_by",
                },
            )
        },
        lambda d: best(d) | needed(d),
    ),
    Told(
        "flight-table zju",
        {
            "ZJU glider: flight table": (
                shown_flights,
                {
                    "pitch deg": "pitch_deg",
                    "speed m/s": "speed_m_s",
                    "angle of attack deg": "angle_of_attack_deg",
                    "moving mass mm": "moving_mass_mm",
                    "turn pole 1/s": "turn_pole_per_s",
                    "turn drive 1/s2": "turn_drive_per_s2",
                },
            )
        },
    ),
    Told(
        "modes zju --speed 0.6 --pitch -25",
        {
            "ZJU glider: longitudinal modes": (lambda d: upper(d["longitudinal"]), MODES),
            "Lateral-directional": (lambda d: upper(d["lateral"]), MODES),
        },
        authority,
    ),
    Told(
        "root-locus zju --over wing_position --from 0 --to 0.2 --points 3",
        {
            "ZJU glider: eigenvalues": (
                lambda d: d["points"],
                {
                    "value hull lengths": "value",
                    "longitudinal 1/s": lambda row: spectrum(row["longitudinal"]),
                    "lateral 1/s": lambda row: spectrum(row["lateral"]),
                    "peak q deg/s/mm": lambda row: row["authority"]["peak_pitch_rate_deg_s_per_mm"],
                    "turn 1/s": lambda row: row["authority"]["turn_rate_deg_s_per_rudder_deg"],
                },
            )
        },
    ),
    Told(
        "hull zju",
        {
            "ZJU glider: pressure hull": (
                lambda d: sorted(d["materials"], key=lambda row: row["rank"]),
                {
                    "#": "rank",
                    "material": "name",
                    "yield mm": "yield_wall_mm",
                    "buckl. mm": "circumferential_wall_mm",
                    "wall mm": "wall_mm",
                    "axial MPa": "axial_critical_stress_mpa",
                    "mass kg": "mass_kg",
                    "collapse m": "collapse_depth_m",
                    "score": None,
                },
            ),
            "TC4, wall 4.2 mm (hull of the vehicle file)": (
                lambda d: d["own"]["criteria"],
                {
                    "criterion": criterion,
                    "": "family",
                    "reached at MPa": "collapse_pressure_mpa",
                    "depth m": "collapse_depth_m",
                    "with safety m": "permissible_depth_m",
                },
            ),
            "Table 4 of the paper": (
                lambda d: d["published"],
                {
                    "material": "material",
                    "quantity": lambda row: f"{row['quantity']}, {row['unit']}",
                    "printed": "printed",
                    "found": "found",
                    "difference": lambda row: 100.0 * (row["found"] / row["printed"] - 1.0),
                },
            ),
        },
        hull_values,
    ),
    Told(
        "engine zju --pressure-mpa 1 --inflate-ml 200 --hold-s 5 --deflate-ml 100",
        {
            "ZJU glider: buoyancy engine at 1 MPa": (
                lambda d: d["phases"],
                {
                    "phase": "phase",
                    "time s": "duration_s",
                    "oil ml": "volume_ml",
                    "piston mm": lambda row: [row["piston_begin_mm"], row["piston_end_mm"]],
                    "energy J": "energy_j",
                    "peak A": "peak_current_a",
                    "eff. %": lambda row: 100.0 * row["pump_efficiency"],
                    "outcome": "outcome",
                },
            )
        },
        engine_values,
    ),
    Told(
        "drives zju --hold 30",
        {
            "At every attitude": (
                lambda d: [row for row in d["pitch"]["points"] if round(row["pitch_deg"], 6) % 10 == 0],
                {
                    "pitch deg": "pitch_deg",
                    "moves": "direction",
                    "load N": "load_n",
                    "torque mN m": "torque_mn_m",
                    "current A": "current_a",
                    "speed mm/s": "speed_mm_s",
                    "power W": "power_w",
                    "energy J/mm": "energy_j_per_mm",
                },
            )
        },
        drive_values,
    ),
    Told(
        "budget zju --density 1002:1003",
        {
            "ZJU glider: mass and volume": (
                lambda d: [
                    *({**bay, "name": bay["name"] + " (flooded)" * bay["flooded"]} for bay in d["bays"]),
                    {
                        "name": "total",
                        "parts": [part for bay in d["bays"] for part in bay["parts"]],
                        "mass_kg": d["total_mass_kg"],
                        "displaced_volume_ml": d["displaced_volume_ml"],
                        "centre_of_mass_m": d["centre_of_mass_m"],
                    },
                ],
                {
                    "bay": "name",
                    "parts": lambda bay: len(bay["parts"]),
                    "mass kg": "mass_kg",
                    "volume l": lambda bay: bay["displaced_volume_ml"] / 1e3,
                    "centre m": lambda bay: bay["centre_of_mass_m"][0],
                },
            ),
            "Reserve of the buoyancy engine": (
                lambda d: d["reserve"]["rows"],
                {
                    "density kg/m3": "density_kg_m3",
                    "neutral at ml": "neutral_ballast_ml",
                    "to sink ml": "to_sink_ml",
                    "to rise ml": "to_rise_ml",
                    "dives at m/s": "dive_speed_m_s",
                    "climbs at m/s": "climb_speed_m_s",
                },
            ),
        },
        budget_values,
    ),
    Told(
        "endurance zju --depth 150 --temperature 8",
        {
            "Energy of a dive": (
                lambda d: parts(d["energy_per_dive_j"], time=d["cycle"]["duration_s"]),
                ENERGY,
            ),
            "20 days allow": (
                lambda d: d["gap"]["favourable_assumptions"],
                {
                    "number": "what",
                    "is": lambda row: f"{row['from']:.4g}",
                    "taken as": lambda row: f"{row['to']:.4g}",
                    "days": "endurance_days",
                },
            ),
            "Sensitivity": (
                lambda d: d["sensitivity"][:12],
                {"number": "what", "value": value_with_unit, "elasticity": "elasticity", "days": sensitivity_days},
            ),
        },
        endurance_values,
    ),
    Told(
        "design zju --no-report",
        {
            "Specification": (
                lambda d: d["specification"],
                {
                    "requirement": "name",
                    "required": requirement,
                    "found": found_of,
                    "": lambda row: {True: "met", False: "NOT MET", None: "not known"}[row["met"]],
                },
            ),
            "Modes at 0.4 m/s, pitch -35 deg": (
                lambda d: upper(d["longitudinal"]) + upper(d["lateral"]),
                {
                    "mode": "name",
                    "real 1/s": "real",
                    "imaginary 1/s": "imag",
                    "time to half s": "time_to_half_s",
                },
            ),
        },
        design_values,
    ),
    Told(
        "simulate pool_trial",
        {
            "Waypoints": (lambda d: d["waypoints"], WAYPOINTS),
            "Energy from the battery": (
                lambda d: parts(d["energy_wh"]),
                {"part": "part", "energy Wh": "energy", "share %": "share"},
            ),
        },
        simulated,
    ),
    Told(
        "bench pressure fan2013-table5",
        {
            "Pressure tests of the ZJU hull": (
                lambda d: d["holds"],
                {
                    "hold": "hold",
                    "time": lambda row: f"{row['from']}-{row['to']}",
                    "from MPa": "begin_pressure_mpa",
                    "to MPa": "end_pressure_mpa",
                    "loss MPa": "loss_mpa",
                    "rate MPa/h": "rate_mpa_per_h",
                    "leak ml/h": "leak_ml_per_h",
                    "passed": lambda row: "yes" if row["passed"] else "NO",
                },
            )
        },
        lambda d: {
            "verdict": "passed" if d["passed"] else "FAILED",
            "asked": [d["limits"]["largest_loss_mpa"], d["limits"]["lowest_pressure_mpa"]],
        },
    ),
    Told("bench speed zju", {"Motor speed": (lambda d: d["choice"]["candidates"], CHOICE)}),
    Told(
        "bench analyse bench.csv",
        {
            "Motor speed": (lambda d: d["choice"]["candidates"], CHOICE),
            "4 runs": (
                lambda d: d["runs"],
                {
                    "pressure MPa": "pressure_mpa",
                    "speed r/min": "motor_speed_rpm",
                    "current A": "average_current_a",
                    "K J/mm": "consumption_j_per_mm",
                    "efficiency": "efficiency",
                    "500 ml s": "inflating_time_s",
                },
            ),
        },
    ),
    Told(
        "bench fit bench.csv --parameter displacement_m3_rev --parameter pump_friction_n_m",
        {
            "Fit to 4 runs": (
                lambda d: d["parameters"],
                {
                    "constant": None,
                    "value": fitted("value"),
                    "low": fitted("interval_95", 0),
                    "high": fitted("interval_95", 1),
                    "vehicle file": fitted("start"),
                    "true": fitted("true"),
                },
            )
        },
    ),
    Told("ocean show east_china_sea --at 28.2,126.6 --depth 50", values=ocean_values),
    Told(
        "vehicles",
        {
            "Built-in vehicles": (
                lambda d: d,
                {"name": "name", "mass kg": "mass_kg", "planes": "planes", "what it is": "summary"},
            )
        },
    ),
    Told(
        "orders pool_trial",
        values=lambda d: {
            "mission": None,
            "vehicle": None,
            "dives": [d["depth_m"], d["turns_early_m"]],
            "pitch": d["pitch_deg"],
            "ballast": None,
            "waypoints": d["waypoints"],
            "CTD": d["sample_every_s"],
            "ends by": d["alarm_energy_wh"],
            "dive ends": [d["abort_depth_m"], d["abort_hours"]],
            "expires": d["expires_hours"],
            "flight table": d["flights"],
        },
    ),
    Told(
        "sitl fly pool_trial",
        {
            "Waypoints": (lambda d: d["waypoints"], WAYPOINTS),
            "Energy from the battery": (
                lambda d: parts(d["energy_wh"]),
                {"part": "part", "energy Wh": "energy", "share %": "share"},
            ),
        },
        lambda d: simulated(d) | in_the_loop(d),
    ),
    Told(
        "vehicle calibrate-compass turned.csv",
        {
            "Fields of what runs": (
                lambda d: d["actuators"],
                {
                    "actuator": lambda row: row["actuator"].replace("_", " "),
                    **{f"b{k + 1} uT": lambda row, k=k: row["field_ut"][k] for k in range(3)},
                    "error uT": "error_ut",
                    "runs": "runs",
                },
            )
        },
        calibrated,
    ),
    Told(
        "vehicle check zju",
        values=lambda d: {
            "mass": d["mass_kg"],
            "numbers": [d[key] for key in ("numbers", "sourced", "derived", "assumptions", "not_stated")],
            "planes": None,
        },
    ),
]

ELSEWHERE = {
    "derivative": "prints JSON always",
    "study": "tests/studies/test_sweeps and test_running hold its tables against its statistics",
    "sitl campaign": "tests/sitl/test_campaign_command, with sitl replay",
    "sitl replay": "as sitl campaign",
    "sitl stand-in": "below",
    "station serve": "prints the address of its page",
    "station import": "tests/archive/logs/test_import_command",
    **{f"station {verb}": "tests/archive/test_commands" for verb in ("backup", "check", "export", "migrate")},
    **{
        f"station user {verb}": "tests/cli/test_station_people"
        for verb in ("add", "list", "change", "password", "remove")
    },
    **{f"station token {verb}": "tests/cli/test_station_people" for verb in ("add", "list", "remove")},
    "vehicle run": "below",
    "vehicle show": "below",
    "vehicle new": "prints a path",
    "vehicle config": "prints a path",
    "vehicle log": "tests/onboard/coordination/test_log_command holds what it shows against what was logged",
    "bench generate": "prints a count",
    "ocean list": "below",
    "link status": "tests/cli/test_link_story, which has a vehicle to speak to",
    **{f"link params {verb}": "as link status" for verb in ("list", "get", "set")},
    **{f"link mission {verb}": "as link status" for verb in ("show", "upload", "download", "roll-back")},
    **{f"link files {verb}": "as link status" for verb in ("list", "get", "put")},
    **{f"link command {verb}": "as link status" for verb in ("list", "send", "follow")},
    "link key new": "tests/link/signing/test_key_command.py, with link key show and link key check",
    "link key show": "as link key new",
    "link key check": "as link key new",
    **{f"plan {verb}": "tests/cli/test_plan.py" for verb in ("check", "preview", "open")},
    "can dump": "tests/messages/test_can_command.py, with can decode and can send",
    "can decode": "as can dump",
    "can send": "as can dump",
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where a small log of the engine lies."""
    path = tmp_path_factory.mktemp("told")
    made = run_here(path, "bench", "generate", "zju", "--output", "bench.csv", "--pressure-mpa", "0.5,2",
                    "--speed-rpm", "5250,7000")  # fmt: skip
    assert made.status == 0, made.err
    (path / "turned.csv").write_text(samples_text(MagneticVehicle(60.0), np.random.default_rng(1)))
    return path


def rows_hold(table: Shown, rows: list[Row], columns: Columns) -> None:
    assert set(table.columns) == set(columns), table.title
    assert len(table.rows) == len(rows), table.title
    for shown, row in zip(table.rows, rows, strict=True):
        for name, what in columns.items():
            if what is None:
                continue
            expected = row[what] if isinstance(what, str) else what(row)
            told = shown[name].rstrip("*!+") if not isinstance(expected, str) else shown[name]
            assert same(told, expected), f"{table.title}: {name}: {shown[name]!r} is not {expected!r}"


@pytest.mark.parametrize("told", ALL, ids=lambda told: told.call)
def test_every_cell_is_the_number_of_the_json(folder: Path, told: Told) -> None:
    words, data = (run_here(folder, *told.call.split(), *more) for more in ((), ("--json",)))
    assert (words.status, data.status) == (0, 0), words.err + data.err
    shown, answer = tables(words.out), data.json
    assert len(shown) == len(told.tables), [table.title for table in shown]
    for begin, (rows, columns) in told.tables.items():
        (table,) = (table for table in shown if begin in table.title)
        rows_hold(table, rows(answer), columns)
    plain = re.sub(r"(?m)^ ?.*─{3,}(?:.*\n)+?\s*$", "", words.out)  # rows are no named values
    found = {name: value for name, value in values(plain).items() if name not in told.tables}
    expected = told.values(answer)
    cells = {cell for table in shown for row in table.rows for cell in row.values()}
    unnamed = {name for name in found if name not in expected and numbers_in(found[name]) and name not in cells}
    assert not unnamed
    for name, value in expected.items():
        assert name in found, (name, found)
        if value is not None:
            assert same(found[name], value), f"{name}: {found[name]!r} is not {value!r}"


def leaves(command: Any, path: tuple[str, ...] = ()) -> list[tuple[tuple[str, ...], Any]]:
    """Every verb with its name."""
    inner = getattr(command, "commands", None)
    if inner is None:
        return [(path, command)]
    return [leaf for name, one in inner.items() for leaf in leaves(one, (*path, name))]


def test_every_verb_is_looked_at() -> None:
    verbs = {" ".join(path) for path, _ in leaves(typer.main.get_command(app))}
    looked_at = {verb for verb in verbs for told in ALL if f"{told.call} ".startswith(f"{verb} ")}
    assert verbs == looked_at | set(ELSEWHERE)


@pytest.mark.parametrize(
    ("verb", "row", "shown"),
    [
        (
            "vehicle_run",
            {
                "decisions": 3599,
                "mean_step_ms": 1.26,
                "longest_step_ms": 8.74,
                "late_steps": 2,
                "failed_steps": 1,
                "link_failures": 3,
                "start_again": True,
            },
            {
                "decisions": 3599,
                "one decision": [1.3, 8.7],
                "late": 2,
                "failed": 1,
                "link failures": 3,
                "restart": "asked for by the shore",
            },
        ),
        (
            "sitl_stand_in",
            {
                "time_s": 61.0,
                "depth_m": 12.34,
                "nodes": {"motion": "safe", "acquisition": "operational"},
                "radio": {"sent_bytes": 5120, "heard_bytes": 77},
            },
            {"depth": 12.3, "radio": [5120, 77], "nodes": "motion safe, acquisition operational"},
        ),
    ],
)
def test_what_runs_until_it_is_stopped_tells_its_numbers(
    capsys: pytest.CaptureFixture[str], verb: str, row: Row, shown: dict[str, Any]
) -> None:
    """Real ports and real time: the calls themselves are in tests/sitl/test_real_ports."""
    import_module(f"stommel.cli.{verb}")._show(row)
    found = values(capsys.readouterr().out)
    assert set(found) == set(shown)
    for name, value in shown.items():
        assert same(found[name], value), f"{name}: {found[name]!r} is not {value!r}"


def test_a_vehicle_is_shown_number_by_number(folder: Path) -> None:
    shown, answer = (
        run_here(folder, "vehicle", "show", "seawing"),
        run_here(folder, "vehicle", "show", "seawing", "--json"),
    )
    lines = [line.strip() for line in shown.out.splitlines() if re.match(r"^  ?(?! )\S+ = ", line) or " = " in line]
    told = {name: rest for line in lines for name, _, rest in [line.partition(" = ")]}
    for row in answer.json["numbers"]:
        wanted = ", ".join(map(str, row["value"])) if isinstance(row["value"], list) else str(row["value"])
        assert told[row["key"]].split("; ")[0] == f"{wanted} {row['unit'] or ''}".rstrip()


def test_oceans_are_listed_with_their_parameters(folder: Path) -> None:
    shown, answer = run_here(folder, "ocean", "list"), run_here(folder, "ocean", "list", "--json").json
    told = [line.split(maxsplit=1) for line in shown.out.splitlines() if line.startswith("  ")]
    wanted = [
        [name, "none" if value is None else f"{value:g}"]
        for ocean in answer.values()
        for name, value in ocean["parameters"].items()
    ]
    assert [[name, rest.split()[0]] for name, rest in told] == wanted


def waypoint(number: int, *, reached: bool) -> Row:
    row = dict.fromkeys(("closest_m", "distance_at_end_m", "leg_length_km", "leg_time_hours", "leg_made_good_m_s",
                         "beside_line_greatest_m"), 1000.0 + number)  # fmt: skip
    return row | {"number": number, "reached": reached, "reached_utc": "2026-07-02T03:04:05Z" if reached else None}


@pytest.mark.parametrize(
    ("planned", "reached", "first"),
    [(5, 2, 1), (12, 12, 1), (30, 0, 1), (30, 10, 1), (30, 11, 2), (30, 20, 11), (30, 30, 19)],
)
def test_of_many_waypoints_the_last_that_were_reached_and_the_next_are_shown(
    capsys: pytest.CaptureFixture[str], planned: int, reached: int, first: int
) -> None:
    """Twelve rows: among them always the one that was sought at the end, and the one after it."""
    from stommel.cli.flown import _show_waypoints

    rows = [waypoint(k + 1, reached=k < reached) for k in range(planned)]
    _show_waypoints(rows)
    text = capsys.readouterr().out
    (table,) = tables(text)
    shown = rows[first - 1 : first + 11]
    assert [row["no."] for row in table.rows] == [str(row["number"]) for row in shown]
    rows_hold(table, shown, WAYPOINTS)
    sought = min(reached + 1, planned)
    assert str(sought) in [row["no."] for row in table.rows]
    assert (f"12 of {planned} waypoints are shown" in text) is (planned > 12)
