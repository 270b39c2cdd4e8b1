"""Every cell of the report's tables is the number that the study's own JSON gives under that name.

Which key belongs below which heading is written here; a heading or a table that is not named fails. The trim tables,
matrices, modes and requirements are held against the paper and the study in `test_report` and `test_verdicts`.
"""

from collections.abc import Callable
from math import degrees
from typing import Any

import pytest

from stommel.design.study import DesignStudy
from tests.report.test_report import Page
from tests.support.reports import report_without_pictures
from tests.support.terminal import same

Rows = list[list[Any]]
"""What each cell shows, row by row: a number, numbers in order, or a text; None for a dash."""


def _envelope(study: DesignStudy) -> Rows:
    keys = ("minimum_speed_m_s", "maximum_speed_m_s", "maximum_horizontal_speed_m_s", "moving_mass_position_mm",
            "ballast_volume_ml", "limited_by")  # fmt: skip
    return [[row["pitch_deg"], *(row[key] for key in keys)] for row in study.as_json()["envelope"]]


def _best(study: DesignStudy) -> Rows:
    told = study.as_json()
    glide, fast = told["best_glide"], told["fastest"]
    keys = {
        "Speed along the path": "speed_m_s", "Horizontal speed": "horizontal_speed_m_s", "Pitch": "pitch_deg",
        "Sinking speed": "sinking_speed_m_s", "Glide path": "glide_path_deg", "Angle of attack": "angle_of_attack_deg",
        "Moving mass position": "moving_mass_position_mm", "Ballast volume": "ballast_volume_ml",
    }  # fmt: skip
    rows: Rows = [[name, glide[key], fast[key], ...] for name, key in keys.items()]
    ratios = [flight["horizontal_speed_m_s"] / flight["sinking_speed_m_s"] for flight in (glide, fast)]
    return [*rows, ["Glide ratio: distance per depth", *ratios, ...], ["Remark", ..., ..., ...]]


def _authority(study: DesignStudy) -> Rows:
    told = study.as_json()["authority"]
    return [
        ["Pitch per moving mass", told["pitch_deg_per_mm"], ...],
        ["Speed per ballast volume", told["speed_m_s_per_ml"], ...],
        ["Turn rate per angle of rudder", told["turn_rate_deg_s_per_rudder_deg"], ...],
        ["Turn rate per angle of rolled mass", None, ...],
        ["Peak pitch rate after a step of the moving mass", told["peak_pitch_rate_deg_s_per_mm"], ...],
        ["Pitch acceleration at once per moving mass", told["initial_pitch_acceleration_deg_s2_per_mm"], ...],
    ]


def _turns(study: DesignStudy) -> Rows:
    return [
        [row["turn_rate_rad_s"], degrees(row["turn_rate_rad_s"]), row["radius_m"], row["roll_deg"], row["sideslip_deg"],
         row["rudder_deg"], row["roll_mass_deg"], row["moving_mass_position_mm"], row["ballast_volume_ml"]]
        for row in study.as_json()["turns"]
    ]  # fmt: skip


def _hull(study: DesignStudy) -> Rows:
    assert study.hull is not None
    rows = sorted(study.hull.as_json()["materials"], key=lambda row: row["rank"])
    return [
        [row["rank"], row["title"], row["yield_wall_mm"], row["circumferential_wall_mm"], row["wall_mm"],
         row["axial_critical_stress_mpa"], row["mass_kg"], row["collapse_depth_m"], ...]
        for row in rows
    ]  # fmt: skip


def _criteria(study: DesignStudy) -> Rows:
    assert study.hull is not None
    return [
        [row["name"] + (f" (n = {row['lobes']})" if row["lobes"] else ""), row["family"], row["collapse_pressure_mpa"],
         row["collapse_depth_m"], row["permissible_depth_m"]]
        for row in study.hull.as_json()["own"]["criteria"]
    ]  # fmt: skip


def _published(study: DesignStudy) -> Rows:
    assert study.hull is not None
    return [
        [row["material"], row["quantity"], row["printed"], row["found"], 100.0 * (row["found"] / row["printed"] - 1.0),
         row["unit"], ...]
        for row in study.hull.as_json()["published"]
    ]  # fmt: skip


def _engine(study: DesignStudy) -> Rows:
    assert study.engine is not None
    rows: Rows = []
    for place, run in study.engine.runs:
        for phase in run.as_json()["phases"]:
            piston = [phase["piston_begin_mm"], phase["piston_end_mm"]]
            rows.append([
                f"{phase['phase']} {place}", phase["duration_s"], phase["volume_ml"], piston, phase["energy_j"],
                phase["peak_current_a"], 100.0 * phase["pump_efficiency"], phase["outcome"],
            ])  # fmt: skip
    return rows


def _losses(study: DesignStudy) -> Rows:
    assert study.engine is not None
    deep = study.engine.deep.as_json()["phases"][0]
    known = {"work against the sea": deep["sea_work_j"],
             **{name.replace("_", " "): joules for name, joules in deep["losses_j"].items()}}  # fmt: skip
    return [[name, 100.0 * joules / deep["energy_j"]] for name, joules in known.items()]


def _motor(study: DesignStudy) -> Rows:
    assert study.motor_speed is not None
    return [
        [row["motor_speed_rpm"], row["mean_consumption_j_per_mm"], row["inflating_time_s"], ...]
        for row in study.motor_speed.choice.as_row()["candidates"]
    ]


def _drives(study: DesignStudy) -> Rows:
    assert study.drives is not None
    told = study.drives.as_json()
    keys = ("from_mm", "to_mm", "time_s", "energy_j", "longest_time_s", "greatest_energy_j")
    changes: Rows = [
        [f"Trim, {way}", *(told["pitch"][way.replace(" ", "_")][key] for key in keys)]
        for way in ("dive to climb", "climb to dive")
    ]
    turn, step = told["rudder"]["turn"], told["rudder"]["full_step"]
    both = 2.0 * step["time_s"]  # over and back alike
    return [*changes, [..., 0, turn["angle_deg"], both, turn["energy_j"], "–", "–"]]


def _switches(study: DesignStudy) -> Rows:
    assert study.drives is not None
    return [
        [row["end"], row["switch_mm"], row["stop_mm"], row["run_on_mm"], row["stall_thrust_n"]]
        for row in study.drives.as_json()["pitch"]["over_runs"]
    ]


def _budget(study: DesignStudy) -> Rows:
    assert study.budget is not None
    told = study.budget.as_json()
    rows: Rows = [
        [bay["name"] + " (flooded)" * bay["flooded"], len(bay["parts"]), bay["mass_kg"],
         bay["displaced_volume_ml"] / 1e3, bay["centre_of_mass_m"][0]]
        for bay in told["bays"]
    ]  # fmt: skip
    count = sum(len(bay["parts"]) for bay in told["bays"])
    total = [told["total_mass_kg"], told["displaced_volume_ml"] / 1e3, told["centre_of_mass_m"][0]]
    return [*rows, ["Total", count, *total]]


def _parts(study: DesignStudy) -> Rows:
    return [
        [part.name, part.bay, "moving mass" if part.moving else "ballast" if part.ballast else "rigid body",
         part.mass_kg, part.volume_ml, *part.position_m]
        for part in study.vehicle.description.parts
    ]  # fmt: skip


def _gap(study: DesignStudy) -> Rows:
    assert study.energy is not None
    rows = study.energy.as_json()["gap"]["favourable_assumptions"]
    return [[row["what"], row["from"], row["to"], row["unit"], row["endurance_days"]] for row in rows]


def _best_dives(study: DesignStudy) -> Rows:
    assert study.energy is not None
    told = study.energy.as_json()
    keys = ("speed_m_s", "pitch_deg", "depth_m", "endurance_days", "range_km")
    return [
        [name, *(found[key] for key in keys), ", ".join(found["limited_by"])]
        for name, found in (("Longest", told["best_for_endurance"]), ("Farthest", told["best_for_range"]))
    ]


def _assumptions(study: DesignStudy) -> Rows:
    assert study.energy is not None
    return [
        [row["what"], row["value"], row["unit"], row["elasticity"], ...]
        for row in study.energy.as_json()["sensitivity"]
    ]


TABLES: dict[str, Callable[[DesignStudy], Rows]] = {
    "envelope-table": _envelope, "best-table": _best, "authority-table": _authority, "turns-table": _turns,
    "hull-table": _hull, "hull-criteria": _criteria, "hull-published": _published, "engine-table": _engine,
    "engine-losses": _losses, "motor-speed-table": _motor, "drives-table": _drives, "switches-table": _switches,
    "budget-table": _budget, "parts-table": _parts, "endurance-gap": _gap, "endurance-best": _best_dives,
    "endurance-assumptions": _assumptions,
}  # fmt: skip

ELSEWHERE = {"specification-table", "trim-table-1", "trim-table-2", "modes-table"}


@pytest.fixture(scope="module")
def page(zju: DesignStudy) -> Page:
    return Page(report_without_pictures(zju))


def told_by(cell: str, expected: Any) -> bool:
    """A cell, with the proper minus and dash of the report."""
    plain = " ".join(cell.replace("−", "-").split())
    if expected is None:
        return plain == "–"
    if isinstance(expected, str):
        return " ".join(cell.split()) == " ".join(expected.split())
    return same(plain.rstrip("!+°").removesuffix(" mm"), expected)


@pytest.mark.parametrize("name", TABLES)
def test_cells_of_a_table(page: Page, zju: DesignStudy, name: str) -> None:
    shown, expected = page.tables[name][1:], TABLES[name](zju)
    if name in ("best-table", "authority-table", "engine-losses"):  # by name, in an order of their own
        rows = {" ".join(str(row[0]).split()): row for row in expected}
        assert {" ".join(row[0].split()) for row in shown} <= set(rows), [row[0] for row in shown]
        expected = [rows[" ".join(row[0].split())] for row in shown]
    assert len(shown) == len(expected)
    for cells, wanted in zip(shown, expected, strict=True):
        assert len(cells) == len(wanted)
        for heading, cell, value in zip(page.tables[name][0], cells, wanted, strict=True):
            assert value is ... or told_by(cell, value), f"{heading}: {cell!r} is not {value!r}"


def test_every_table_with_a_name_is_looked_at(page: Page) -> None:
    assert {name for name in page.tables if not name.startswith("table ")} == set(TABLES) | ELSEWHERE
