"""Samples have the moments and strata they should; indices of functions whose indices are known."""

from math import pi

import numpy as np
import pytest
from scipy import stats

from stommel.studies.sampling import run_seed, run_values
from stommel.studies.sensitivity import sensitivity_of
from stommel.studies.study_file import StudyFile

ANGLE = {"distribution": "uniform", "from": -pi, "to": pi}


def study(kind: str, runs: int, *parameters: dict[str, object], seed: int = 5) -> StudyFile:
    numbered = [{"key": f"mission.x{i}"} | parameter for i, parameter in enumerate(parameters)]
    return StudyFile.model_validate(
        {"name": "s", "mission": "m", "kind": kind, "runs": runs, "seed": seed, "parameters": numbered}
    )


def table(file: StudyFile) -> np.ndarray:
    return np.array(run_values(file), dtype=float)


def test_latin_hypercube_has_one_run_in_every_stratum() -> None:
    normal = {"distribution": "normal", "mean": 3.0, "standard_deviation": 2.0}
    values = table(study("latin_hypercube", 64, {"distribution": "uniform", "from": 2.0, "to": 10.0}, normal))
    strata = np.floor((values[:, 0] - 2.0) / 8.0 * 64).astype(int)
    assert sorted(strata) == list(range(64))
    assert sorted(np.floor(stats.norm(3.0, 2.0).cdf(values[:, 1]) * 64).astype(int)) == list(range(64))


def test_monte_carlo_moments() -> None:
    n = 20_000
    values = table(
        study(
            "monte_carlo",
            n,
            {"distribution": "uniform", "from": 1.0, "to": 5.0},
            {"distribution": "normal", "mean": -2.0, "standard_deviation": 0.5},
            {"distribution": "lognormal", "median": 45.0, "log_standard_deviation": 0.2},
        )
    )
    four_errors = 4.0 / np.sqrt(n)
    assert values[:, 0].mean() == pytest.approx(3.0, abs=four_errors * 4 / np.sqrt(12))
    assert values[:, 0].std() == pytest.approx(4 / np.sqrt(12), rel=0.02)
    assert values[:, 1].mean() == pytest.approx(-2.0, abs=four_errors * 0.5)
    assert values[:, 1].std() == pytest.approx(0.5, rel=0.03)
    assert np.log(values[:, 2]).mean() == pytest.approx(np.log(45.0), abs=four_errors * 0.2)
    assert np.log(values[:, 2]).std() == pytest.approx(0.2, rel=0.03)
    assert abs(np.corrcoef(values.T)[0, 1]) < four_errors


def test_a_distribution_that_is_cut_off_keeps_its_shape_inside() -> None:
    cut = {"distribution": "normal", "mean": 0.0, "standard_deviation": 1.0, "at_least": -0.5, "at_most": 2.0}
    values = table(study("monte_carlo", 5000, cut))[:, 0]
    assert values.min() >= -0.5
    assert values.max() <= 2.0
    assert stats.kstest(values, stats.truncnorm(-0.5, 2.0).cdf).pvalue > 0.01


def test_sweep_runs_through_all_combinations_the_last_fastest() -> None:
    file = study("sweep", 2, {"from": 0.0, "to": 1.0, "steps": 3}, {"values": ["a", "b"]})
    values = run_values(file)
    assert file.count == len(values) == 12
    assert values[:5] == [(0.0, "a"), (0.0, "a"), (0.0, "b"), (0.0, "b"), (0.5, "a")]


def test_seeds_of_runs_differ_and_do_not_change() -> None:
    seeds = {run_seed(3, run) for run in range(10_000)}
    assert len(seeds) == 10_000
    assert run_seed(3, 17) == run_seed(3, 17) != run_seed(4, 17)
    assert max(seeds) < 2**63


def test_sobol_indices_of_the_ishigami_function() -> None:
    # Ishigami and Homma (1990), a = 7, b = 0.1; the indices are known in closed form
    a, b = 7.0, 0.1
    file = study("sobol", 4096, ANGLE, ANGLE, ANGLE)
    x = table(file)
    y = np.sin(x[:, 0]) + a * np.sin(x[:, 1]) ** 2 + b * x[:, 2] ** 4 * np.sin(x[:, 0])
    v1, v2, v13 = 0.5 * (1 + b * pi**4 / 5) ** 2, a**2 / 8, 8 * b**2 * pi**8 / 225
    v = v1 + v2 + v13
    found = sensitivity_of("sobol", ("x1", "x2", "x3"), x, {"y": y}, 1)
    assert found is not None
    assert found.measures["first_order"][0] == pytest.approx([v1 / v, v2 / v, 0.0], abs=0.02)
    assert found.measures["total"][0] == pytest.approx([(v1 + v13) / v, v2 / v, v13 / v], abs=0.02)
    # a failed run takes its base point with it, and no more
    y[7] = np.nan
    again = sensitivity_of("sobol", ("x1", "x2", "x3"), x, {"y": y}, 1)
    assert again is not None
    assert again.runs == len(y) - 5
    assert again.measures["total"][0] == pytest.approx(found.measures["total"][0], abs=0.01)


def test_regression_of_a_linear_function() -> None:
    normal = {"distribution": "normal", "mean": 4.0, "standard_deviation": 2.0}
    x = table(study("latin_hypercube", 2000, normal, {"distribution": "uniform", "from": 0.0, "to": 1.0}))
    y = 3.0 * x[:, 0] - 10.0 * x[:, 1]
    parts = np.array([3.0 * 2.0, -10.0 / np.sqrt(12)])
    found = sensitivity_of("latin_hypercube", ("p", "q"), x, {"y": y, "constant": np.ones(2000)}, 1)
    assert found is not None
    assert found.measures["coefficient"][0] == pytest.approx(parts / np.hypot(*parts), abs=0.03)
    assert found.explained[0] == pytest.approx(1.0, abs=1e-12)
    assert np.isnan(found.explained[1])
