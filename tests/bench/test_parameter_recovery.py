"""A fit must give back the constants that made a log, within the intervals that it states."""

from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
import pytest

from stommel.bench import (
    DEFAULT_PARAMETERS,
    BenchPlan,
    BenchRequestError,
    EngineFit,
    SensorNoise,
    fit_engine,
    generate_log,
    log_text,
    map_text,
    performance,
    read_engine_log,
)
from stommel.machinery.engine.steady_state import EngineParameters
from tests.bench.conftest import SMALL

SEEDS = 60


@pytest.fixture(scope="module")
def fits(engine: EngineParameters) -> list[EngineFit]:
    """Fits that begin from a wrong vehicle file, as on a real bench."""
    start = replace(
        engine, leakage_m3_s_pa=0.5 * engine.leakage_m3_s_pa, pump_friction_n_m=2.0 * engine.pump_friction_n_m
    )
    found = []
    for seed in range(1000, 1000 + SEEDS):
        log = generate_log(engine, seed)
        found.append(fit_engine(performance(log, engine.piston_area_m2), start, true=log.true_parameters))
    return found


def test_intervals_hold_all_true_values_in_nine_of_ten_seeds(fits: list[EngineFit]) -> None:
    held = [all(p.true is not None and p.low <= p.true <= p.high for p in fit.parameters) for fit in fits]
    assert np.mean(held) >= 0.9


def test_intervals_of_one_constant_are_neither_too_narrow_nor_too_wide(fits: list[EngineFit]) -> None:
    """95 % of 300 intervals, give or take 4 standard deviations of a binomial share."""
    held = [p.alone[0] <= (p.true or 0.0) <= p.alone[1] for fit in fits for p in fit.parameters]
    assert 0.95 - 4 * np.sqrt(0.95 * 0.05 / len(held)) < np.mean(held) < 0.995


def test_estimates_are_unbiased(fits: list[EngineFit]) -> None:
    """The mean of the deviations in standard errors is normal with 1/sqrt(seeds)."""
    pulls = np.array([[(p.value - (p.true or 0.0)) / p.standard_error for p in fit.parameters] for fit in fits])
    assert np.abs(pulls.mean(axis=0)).max() < 4 / np.sqrt(SEEDS)
    assert np.abs(pulls.std(axis=0) - 1.0).max() < 0.4


def test_without_noise_the_constants_come_back(engine: EngineParameters) -> None:
    log = generate_log(engine, 0, BenchPlan(period=0.1), SensorNoise().times(0.0))
    start = replace(engine, leakage_m3_s_pa=2.0 * engine.leakage_m3_s_pa, pump_friction_share=0.5)
    fit = fit_engine(performance(log, engine.piston_area_m2), start)
    for one in fit.parameters:
        assert one.value == pytest.approx(getattr(engine, one.name), rel=5e-3), one.name  # the file's digits
    assert fit.engine.leakage_m3_s_pa == fit.parameters[1].value


def test_constants_that_the_bench_cannot_tell_apart_are_refused(engine: EngineParameters) -> None:
    runs = performance(generate_log(engine, 1), engine.piston_area_m2)
    with pytest.raises(BenchRequestError, match=r"pump_friction_n_m, no_load_current_a: .*cannot tell them apart"):
        fit_engine(runs, engine, ("leakage_m3_s_pa", "pump_friction_n_m", "no_load_current_a"))
    with pytest.raises(BenchRequestError, match="stribeck_velocity_m_s: these runs do not depend on it"):
        fit_engine(runs, replace(engine, cylinder_stribeck_n=0.0), ("leakage_m3_s_pa", "stribeck_velocity_m_s"))


def test_constants_that_hang_together_are_named(engine: EngineParameters) -> None:
    runs = performance(generate_log(engine, 1), engine.piston_area_m2)
    fit = fit_engine(
        runs, engine, ("displacement_m3_rev", "pump_friction_share", "cylinder_coulomb_n", "pump_friction_n_m")
    )
    assert any("hang together" in words or "hardly determined" in words for words in fit.warnings)


@pytest.mark.parametrize(
    ("names", "words"),
    [
        (("leakage",), "parameter 'leakage': unknown; there are: .*leakage_m3_s_pa"),
        ((), "at least one"),
        (("leakage_m3_s_pa", "leakage_m3_s_pa"), "none twice"),
    ],
)
def test_wrong_names_are_refused(engine: EngineParameters, names: tuple[str, ...], words: str) -> None:
    runs = performance(generate_log(engine, 1, SMALL), engine.piston_area_m2)
    with pytest.raises(BenchRequestError, match=words):
        fit_engine(runs, engine, names)


def test_too_few_runs_are_refused(engine: EngineParameters) -> None:
    runs = performance(generate_log(engine, 1, SMALL), engine.piston_area_m2)
    with pytest.raises(BenchRequestError, match=r"4 runs give 8 numbers, too few for 5 parameters.*at least 5 runs"):
        fit_engine(runs, engine, DEFAULT_PARAMETERS)


def test_the_log_of_another_engine_does_not_fit(engine: EngineParameters) -> None:
    """Half of the runs with a fifth of the leakage and much friction: no constants explain both."""
    one, other = (
        performance(generate_log(e, 1), engine.piston_area_m2)
        for e in (engine, replace(engine, leakage_m3_s_pa=0.2 * engine.leakage_m3_s_pa, pump_friction_n_m=0.6))
    )
    with pytest.raises(BenchRequestError, match="the model does not fit"):
        fit_engine([*one[::2], *other[1::2]], engine)


def test_the_same_seed_gives_the_same_bytes(engine: EngineParameters) -> None:
    texts = [
        (log_text(log, 7, "zju"), map_text(log, 7, "zju")) for log in (generate_log(engine, 7, SMALL) for _ in "ab")
    ]
    assert texts[0] == texts[1]
    assert log_text(generate_log(engine, 8, SMALL), 7, "zju") != texts[0][0]


def test_a_log_survives_its_file(engine: EngineParameters, log_file: Path) -> None:
    written, read = generate_log(engine, 3, SMALL), read_engine_log(log_file)
    assert read.true_parameters == {name: value for name, value in asdict(engine).items() if np.isfinite(value)}
    for one, other in zip(written.runs, read.runs, strict=True):
        assert one.name == other.name
        for name in ("time", "pressure", "motor_speed", "voltage", "current", "piston_travel"):
            np.testing.assert_allclose(getattr(other, name), getattr(one, name), rtol=1e-12)


def test_a_motor_at_the_end_of_its_supply_runs_slower(engine: EngineParameters) -> None:
    plan = BenchPlan(
        pressures=(0.0, 2.5e6), motor_speeds=(1.1 * engine.supply_voltage_v / engine.torque_constant_n_m_a,)
    )
    free, loaded = performance(generate_log(engine, 1, plan), engine.piston_area_m2)
    assert loaded.point.motor_speed < 0.98 * free.point.motor_speed < plan.motor_speeds[0]
    with pytest.raises(BenchRequestError, match="pumps nothing against 40 MPa"):
        generate_log(engine, 1, BenchPlan(pressures=(40e6,)))
