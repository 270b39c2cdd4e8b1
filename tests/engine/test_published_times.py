"""Oracle: sections 4.3.2 and 5.1.2 of Fan et al. (2013)."""

import numpy as np
import pytest

from stommel.machinery.engine import Outcome, simulate
from stommel.vehicle.schema import Engine

ML = 1e-6


def duration(engine: Engine, pressure_mpa: float, **options: object) -> float:
    phase = simulate(engine, pressure_pa=pressure_mpa * 1e6, inflate_m3=500 * ML, **options).phases[0]  # type: ignore[arg-type]
    assert phase.outcome is Outcome.REACHED
    return phase.duration_s


@pytest.mark.parametrize("pressure_mpa", [0.0, 2.0])
def test_ideal_case_takes_58_s_at_any_pressure(zju: Engine, pressure_mpa: float) -> None:
    """500 ml at 1.1 ml/r and 470 r/min: 58.03 s."""
    assert duration(zju, pressure_mpa, ideal=True) == pytest.approx(500 / (1.1 * 470 / 60), rel=0.01)


@pytest.mark.parametrize(("pressure_mpa", "seconds"), [(0.0, 60.0), (2.0, 80.0)])
def test_bench_times_at_7000_rpm(zju: Engine, pressure_mpa: float, seconds: float) -> None:
    """Leakage and line loss are fitted to these two times; the fit is to 0.1 s."""
    assert duration(zju, pressure_mpa) == pytest.approx(seconds, abs=0.1)


def test_deeper_and_slower_take_longer(zju: Engine) -> None:
    """Fig. 15 and section 5.1.2: more time at every higher pressure, and at every lower speed."""
    by_pressure = [duration(zju, p) for p in np.arange(0.0, 2.6, 0.5)]
    by_speed = [duration(zju, 2.0, motor_speed_rpm=n) for n in (8750.0, 7000.0, 5250.0, 3500.0)]
    assert by_pressure == sorted(by_pressure)
    assert by_speed == sorted(by_speed)
    assert by_pressure[-1] > 80.0


def test_piston_of_figure_8b(zju: Engine) -> None:
    """The whole range: 277.5 to 22.5 mm and back, 500.7 ml of oil."""
    full = zju.measured_piston.working_volume_ml
    assert full == pytest.approx(500.7, abs=0.05)
    run = simulate(zju, pressure_pa=2e6, inflate_m3=full * ML, deflate_m3=full * ML, ideal=True)
    inflate, deflate = run.phases
    assert inflate.piston_m == pytest.approx((0.2775, 0.0225), abs=5e-5)
    assert deflate.piston_m[1] == pytest.approx(0.2775, abs=2e-4)
    # a straight line, as printed
    c = run.courses
    pumping = (c.t_s > 0.5) & (c.t_s < inflate.duration_s - 0.5)
    line = np.polyfit(c.t_s[pumping], c.piston_mm[pumping], 1)
    assert np.abs(np.polyval(line, c.t_s[pumping]) - c.piston_mm[pumping]).max() < 0.05


def test_paper_efficiency_and_k_are_the_definitions(zju: Engine) -> None:
    """eta = P S l / (U I t) and K = U I t / l, from the courses of current and power themselves."""
    run = simulate(zju, pressure_pa=2e6, inflate_m3=500 * ML)
    phase, c = run.phases[0], run.courses
    energy = np.trapezoid(c.power_w, c.t_s)
    travel = phase.piston_m[0] - phase.piston_m[1]
    S = np.pi / 4 * 0.05**2
    assert phase.efficiency == pytest.approx(2e6 * S * travel / energy, rel=1e-3)
    assert phase.energy_per_mm == pytest.approx(energy / (travel * 1e3), rel=1e-3)
