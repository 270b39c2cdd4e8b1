"""Section 5.1.2 of the paper: eta = P S l / (U I t), K = U I t / l, Fig. 14, and the choice of 7000 r/min."""

from dataclasses import replace
from math import pi
from pathlib import Path

import numpy as np
import pytest

from stommel.bench import (
    MARKER,
    BenchPlan,
    BenchRequestError,
    EngineLog,
    EngineRun,
    SensorNoise,
    bench_engine,
    choose_speed,
    generate_log,
    model_points,
    performance,
    read_engine_log,
    time_limit_of,
)
from stommel.bench.bench_engine import piston_area_of
from stommel.machinery.engine.steady_state import EngineParameters, steady_state
from stommel.vehicle import load_vehicle
from tests.bench.conftest import edited

RPM = 2 * pi / 60
AREA = pi / 4 * 0.05**2
PAPER_SPEEDS = [3500 * RPM, 5250 * RPM, 7000 * RPM, 8750 * RPM]
PAPER_PRESSURES = [0.0, 0.5e6, 1e6, 1.5e6, 2e6, 2.5e6]


def by_hand() -> EngineRun:
    """2 MPa, 24 V, 1.5 A, 250 mm in 80 s."""
    n = 41
    return EngineRun(
        "by hand",
        time=10.0 + np.linspace(0.0, 80.0, n),
        pressure=np.full(n, 2e6),
        motor_speed=np.full(n, 7000 * RPM),
        voltage=np.full(n, 24.0),
        current=1.5 + 0.1 * (-1.0) ** np.arange(n) * (np.arange(n) > 0),
        piston_travel=np.linspace(0.27, 0.02, n),
    )


def test_definitions_by_hand() -> None:
    (run,) = performance(EngineLog("by hand", (by_hand(),)), AREA)
    assert run.duration == pytest.approx(80.0)
    assert run.travel == pytest.approx(0.25)
    assert pytest.approx(24 * 1.5 * 80 / 250, rel=1e-12) == run.point.K / 1e3  # J/mm
    assert run.point.efficiency == pytest.approx(2e6 * 1.9634954e-3 * 0.25 / (24 * 1.5 * 80), rel=1e-7)
    assert run.point.efficiency == pytest.approx(2e6 * AREA / run.point.K, rel=1e-12)
    row = run.as_row(AREA, 500e-6)
    assert row["inflating_time_s"] == pytest.approx(500e-6 / (AREA * 0.25 / 80))
    assert row["energy_j"] == pytest.approx(24 * 1.5 * 80)
    assert row["consumption_j_per_mm"] == pytest.approx(11.52)


def test_units_of_a_column_map_do_not_change_the_result(log_file: Path, engine: EngineParameters) -> None:
    """The same bench in bar, r/s, mV, mA, min and cm."""
    area = engine.piston_area_m2
    first = performance(read_engine_log(log_file), area)
    factors = [("s", "min", 1 / 60), ("MPa", "bar", 10), ("r/min", "r/s", 1 / 60), ("V", "mV", 1e3), ("A", "mA", 1e3)]
    factors.append(("mm", "cm", 0.1))

    def convert(cells: list[list[str]]) -> None:
        cells[0] = ["run", "t", "p", "n", "u", "i", "x"]
        for row in cells[1:]:
            row[1:] = [repr(float(cell) * factor) for cell, (_, _, factor) in zip(row[1:], factors, strict=True)]

    edited(log_file, convert)
    beside = log_file.with_suffix(".toml")
    text = beside.read_text()
    names = ["time_s", "pressure_mpa", "motor_speed_rpm", "voltage_v", "current_a", "piston_travel_mm"]
    for (old, new, _), name, short in zip(factors, names, "tpnuix", strict=True):
        text = text.replace(f'column = "{name}", unit = "{old}"', f'column = "{short}", unit = "{new}"')
    beside.write_text(
        text.replace("[-0.1, 10.0]", "[-1.0, 100.0]")
        .replace("[-1.0, 30.0]", "[-1e3, 30e3]")
        .replace("[0.0, 300.0]", "[0.0, 30.0]")
    )
    again = performance(read_engine_log(log_file), area)
    for one, other in zip(first, again, strict=True):
        assert pytest.approx(one.point.K, rel=1e-9) == other.point.K
        assert other.point.efficiency == pytest.approx(one.point.efficiency, rel=1e-9)
        assert other.point.pressure == pytest.approx(one.point.pressure, rel=1e-9)
        assert other.point.motor_speed == pytest.approx(one.point.motor_speed, rel=1e-9)


def test_a_noiseless_log_gives_the_model_back(engine: EngineParameters) -> None:
    log = generate_log(engine, 0, BenchPlan(pressures=(2e6,), motor_speeds=(700.0,)), SensorNoise().times(0.0))
    (run,) = performance(log, engine.piston_area_m2, engine)
    steady = steady_state(engine, 2e6, 700.0)
    assert run.point.efficiency == pytest.approx(float(steady.total_efficiency), rel=2e-4)  # rounded as in the file
    assert run.point.current == pytest.approx(float(steady.supply_current_a), rel=1e-4)
    assert run.point.piston_speed * engine.piston_area_m2 == pytest.approx(float(steady.flow_m3_s), rel=2e-5)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"pressure": 20e6}, "efficiency 3.41 is more than 1"),
        ({"current": -1.5}, "takes no power"),
    ],
)
def test_what_physics_forbids_is_refused(change: dict[str, float], words: str) -> None:
    run = replace(by_hand(), **{name: np.full(41, value) for name, value in change.items()})
    with pytest.raises(BenchRequestError, match=words):
        performance(EngineLog("by hand", (run,)), AREA)


def test_a_piston_faster_than_its_pump_is_refused(engine: EngineParameters) -> None:
    run = replace(by_hand(), time=np.linspace(0.0, 40.0, 41), pressure=np.zeros(41))
    with pytest.raises(BenchRequestError, match="unit of travel, time or motor speed is wrong"):
        performance(EngineLog("by hand", (run,)), AREA, engine)


def test_the_piston_of_another_cylinder_is_refused(engine: EngineParameters) -> None:
    with pytest.raises(BenchRequestError, match=r"40 in the column map, 50 in the vehicle file"):
        piston_area_of(EngineLog("measured", (), 0.04), engine)
    assert piston_area_of(EngineLog("measured", ()), engine) == engine.piston_area_m2


def test_curves_of_figure_14(engine: EngineParameters) -> None:
    """Current rises with speed and with pressure; at high pressure a slow pump loses most to leakage."""
    table = np.array([(p.current, p.K) for p in model_points(engine, PAPER_PRESSURES, PAPER_SPEEDS)]).reshape(6, 4, 2)
    assert np.all(np.diff(table[:, :, 0], axis=0) > 0.0)
    assert np.all(np.diff(table[:, :, 0], axis=1) > 0.0)
    assert np.all(np.diff(table[:, :, 1], axis=0) > 0.0)
    assert table[5, 0, 1] > 1.3 * table[5, 2, 1]


@pytest.mark.parametrize("limit_s", [82.0, 90.0, 100.0])
def test_the_paper_s_speed_by_the_model(engine: EngineParameters, limit_s: float) -> None:
    limit = time_limit_of(longest_s=limit_s, volume_ml=500.0, pressure_mpa=2.0)
    choice = choose_speed(model_points(engine, PAPER_PRESSURES, PAPER_SPEEDS), limit, engine.piston_area_m2)
    assert choice.chosen is not None
    assert choice.chosen.motor_speed / RPM == pytest.approx(7000.0)
    slow = {round(one.motor_speed / RPM): one.refused_because for one in choice.candidates}
    assert "it needs" in slow[3500]
    assert "it needs" in slow[5250]


@pytest.mark.parametrize("seed", range(8))
def test_the_paper_s_speed_by_a_noisy_log(engine: EngineParameters, seed: int) -> None:
    runs = performance(generate_log(engine, seed), engine.piston_area_m2, engine)
    limit = time_limit_of(longest_s=90.0, volume_ml=500.0, pressure_mpa=2.0)
    choice = choose_speed([run.point for run in runs], limit, engine.piston_area_m2)
    assert choice.chosen is not None
    assert choice.chosen.motor_speed / RPM == pytest.approx(7000.0, rel=0.002)


def test_no_speed_is_chosen_where_none_is_quick_enough(engine: EngineParameters) -> None:
    limit = time_limit_of(longest_s=20.0, volume_ml=500.0, pressure_mpa=2.0)
    choice = choose_speed(model_points(engine, PAPER_PRESSURES, PAPER_SPEEDS), limit, engine.piston_area_m2)
    assert choice.chosen is None
    assert "no speed inflates 500 ml at 2 MPa within 20 s" in choice.reason()


def test_without_a_margin_consumption_alone_decides(engine: EngineParameters) -> None:
    slow = model_points(engine, [0.0], [3500 * RPM, 5250 * RPM])
    limit = time_limit_of(longest_s=1e4, volume_ml=500.0, pressure_mpa=0.0)
    choice = choose_speed(slow, limit, engine.piston_area_m2, margin=0.0)
    assert choice.chosen is not None
    assert min(point.K for point in slow) == choice.chosen.K


def test_speeds_are_compared_at_shared_pressures_only(engine: EngineParameters) -> None:
    points = model_points(engine, [0.0, 2e6], [500.0, 700.0]) + model_points(engine, [1e6], [500.0])
    limit = time_limit_of(longest_s=1e3, volume_ml=500.0, pressure_mpa=2.0)
    assert choose_speed(points, limit, AREA).pressures == (0.0, 2e6)
    with pytest.raises(BenchRequestError, match="every motor speed was run at 0, 2 MPa"):
        choose_speed(points, time_limit_of(longest_s=1e3, volume_ml=500.0, pressure_mpa=1.0), AREA)
    apart = model_points(engine, [0.0], [500.0]) + model_points(engine, [2e6], [700.0])
    with pytest.raises(BenchRequestError, match="no pressure was run at every motor speed"):
        choose_speed(apart, limit, AREA)


@pytest.mark.parametrize("wrong", [{"longest_s": 0.0}, {"volume_ml": -1.0}, {"pressure_mpa": float("nan")}])
def test_impossible_limits_are_refused(wrong: dict[str, float]) -> None:
    with pytest.raises(BenchRequestError, match="must be"):
        time_limit_of(**({"longest_s": 90.0, "volume_ml": 500.0, "pressure_mpa": 2.0} | wrong))


def test_vehicles_without_such_an_engine_are_refused() -> None:
    with pytest.raises(BenchRequestError, match=r"no table \[engine\]"):
        bench_engine(load_vehicle("rogue"))


def test_generated_logs_are_marked(engine: EngineParameters, log_file: Path) -> None:
    assert log_file.read_text().splitlines()[0] == f"# {MARKER}"
    beside = log_file.with_suffix(".toml")
    assert f'origin = "{MARKER}"' in beside.read_text()
    beside.write_text(beside.read_text().replace(MARKER, "measured").partition("[generated]")[0])
    assert read_engine_log(log_file).generated, "the mark in the log itself must count"
