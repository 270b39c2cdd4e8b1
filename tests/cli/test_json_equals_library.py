"""What `--json` says is what the library answers to the same question; every option is handed on as what it is."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import stommel
from stommel.analysis import specified_flights
from stommel.design.budget import budget_study
from stommel.design.drives import drive_study
from stommel.design.endurance import energy_study
from stommel.design.hull.study import hull_study
from stommel.design.study import design_study
from stommel.machinery.engine import engine_of, simulate
from stommel.simulation.flight import fly_mission
from stommel.simulation.results.summary import summary
from stommel.simulation.scenario.loading import load_mission
from stommel.simulation.scenario.shipped import mission_path
from stommel.vehicle import FULL, load_vehicle
from tests.support.command import run_here

ZJU = load_vehicle("zju")


def _engine() -> Any:
    return simulate(
        engine_of(ZJU).engine, pressure_pa=1.2e6, inflate_m3=150e-6, deflate_m3=60e-6, hold_s=4.0,
        motor_speed_rpm=6000.0, ideal=False, name="ZJU glider",
    ).as_json()  # fmt: skip


def _flown() -> Any:
    return summary(fly_mission(load_mission(mission_path("pool_trial"))))


QUESTIONS: dict[str, Callable[[], Any]] = {
    "trim zju --speed 0.37 --pitch -24 --physics full": lambda: stommel.trim(
        ZJU, speed_m_s=0.37, pitch_deg=-24.0, physics=FULL
    ).as_row(),
    "trim zju --speed 0.37 --glide-path -29": lambda: stommel.trim(ZJU, speed_m_s=0.37, glide_path_deg=-29.0).as_row(),
    "table zju --speed 0.3,0.5 --pitch -20,-30": lambda: {
        "rows": [row.as_row() for row in stommel.trim_table(ZJU, speeds_m_s=[0.3, 0.5], pitches_deg=[-20.0, -30.0])]
    },
    "steady zju --moving-mass-mm 400 --ballast-ml -150 --rudder-deg 8 --physics full": lambda: stommel.steady_flight(
        ZJU, moving_mass_mm=400.0, ballast_ml=-150.0, rudder_deg=8.0, physics=FULL
    ).as_turn(),
    "turn zju --speed 0.37 --pitch -24 --turn-rate 0.004 --physics full": lambda: stommel.turn(
        ZJU, speed_m_s=0.37, pitch_deg=-24.0, turn_rate_rad_s=0.004, physics=FULL
    ).as_turn(),
    "turn zju --speed 0.37 --pitch -24 --radius -70": lambda: stommel.turn(
        ZJU, speed_m_s=0.37, pitch_deg=-24.0, radius_m=-70.0
    ).as_turn(),
    "modes zju --speed 0.37 --pitch -24 --physics full": lambda: stommel.modes(
        stommel.linearise(ZJU, stommel.trim(ZJU, speed_m_s=0.37, pitch_deg=-24.0, physics=FULL), physics=FULL)
    ).as_row(),
    "envelope zju --physics full": lambda: {
        "reach": [row.as_row() for row in stommel.flight_envelope(ZJU, physics=FULL)],
        "needs": stommel.ranges_needed(ZJU, specified_flights(ZJU), physics=FULL).as_row(),
    },
    "root-locus zju --over wing_position --from 0.1 --to 0.18 --points 3 --speed 0.37 --pitch -24 --physics full": (
        lambda: stommel.root_locus(
            ZJU, "wing_position", 0.1, 0.18, points=3, speed_m_s=0.37, pitch_deg=-24.0, physics=FULL
        ).as_json()
    ),
    "hull zju --material TC4 --material LY12 --depth 260 --knock-down 0.8": lambda: hull_study(
        ZJU, materials=["TC4", "LY12"], depth_m=260.0, knock_down=0.8
    ).as_json(),
    "hull zju --material TC4 --pressure-mpa 3.3 --wall 6": lambda: hull_study(
        ZJU, materials=["TC4"], pressure_mpa=3.3, wall_mm=6.0
    ).as_json(),
    "drives zju --steepest 33 --speed 0.6 --rudder 25 --hold 17": lambda: drive_study(
        ZJU, steepest_deg=33.0, speed_m_s=0.6, rudder_deg=25.0, hold_s=17.0
    ).as_json(),
    "engine zju --pressure-mpa 1.2 --inflate-ml 150 --deflate-ml 60 --hold-s 4 --motor-speed-rpm 6000": _engine,
    "endurance zju --depth 120 --speed 0.33 --pitch -28 --temperature 6 --physics full": lambda: energy_study(
        ZJU, speed_m_s=0.33, pitch_deg=-28.0, depth_m=120.0, temperature_c=6.0, physics=FULL
    ).as_json(),
    "budget zju --density 1001:1004 --foam-density 300": lambda: budget_study(
        ZJU, (1001.0, 1004.0), foam_density_kg_m3=300.0
    ).as_json(),
    "design seawing --no-report --physics full": lambda: design_study(load_vehicle("seawing"), physics=FULL).as_json(),
    "simulate pool_trial": _flown,
}


def plain(answer: Any) -> Any:
    """As JSON writes it."""
    return json.loads(json.dumps(answer))


def alike(found: Any, expected: Any, key: str = "") -> None:
    """The same keys, words and numbers; equilibria of two processes may differ in their last bits."""
    if isinstance(expected, dict):
        assert set(expected) <= set(found), key
        for name, value in expected.items():
            alike(found[name], value, f"{key}.{name}")
    elif isinstance(expected, list):
        assert len(found) == len(expected), key
        for index, (one, other) in enumerate(zip(found, expected, strict=True)):
            alike(one, other, f"{key}.{index}")
    elif isinstance(expected, float) and not key.endswith("residual"):
        assert found == pytest.approx(expected, rel=1e-7, abs=1e-9), key
    elif not key.endswith("residual"):
        assert found == expected, key


@pytest.mark.parametrize("question", QUESTIONS)
def test_json_is_the_librarys_answer(tmp_path: Path, question: str) -> None:
    done = run_here(tmp_path, *question.split(), "--json")
    assert done.status == 0, done.err
    alike(done.json, plain(QUESTIONS[question]()))
