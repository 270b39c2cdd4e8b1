"""Time that a turn costs; oracle: the vertical equation of motion integrated, m w' = rho g (V_n - V_b) - k w |w|."""

from math import pi, sqrt

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from stommel.analysis.reversal import Inertia, departure, reversal

WEIGHT = 1025.0 * 9.81


def cost(mass: float, flow_s: float, before: float, after: float, w_before: float, w_after: float) -> float:
    """How much later it climbs along its last straight line than if it had turned at once at full speed.

    The drag of either way is what balances its drive at its speed.
    """
    k_down, k_up = WEIGHT * before / w_before**2, WEIGHT * after / w_after**2

    def drive(t: float) -> float:
        share = 1.0 if flow_s == 0.0 else min(t / flow_s, 1.0)
        return before - share * (before + after)

    def rates(t: float, y: np.ndarray) -> list[float]:
        k = k_down if y[1] > 0.0 else k_up
        return [y[1], (WEIGHT * drive(t) - k * y[1] * abs(y[1])) / mass]

    settled = flow_s + 60.0 * mass * max(w_before, w_after) / (WEIGHT * after)
    end = solve_ivp(rates, (0.0, settled), [0.0, w_before], rtol=1e-9, atol=1e-10, max_step=settled / 2000).y[:, -1]
    assert end[1] == pytest.approx(-w_after, rel=1e-6)
    return float(settled + end[0] / w_after)


@pytest.mark.parametrize(("before", "after", "speeds"), [(50e-6, 50e-6, (0.2, 0.2)), (80e-6, 30e-6, (0.3, 0.18))])
@pytest.mark.parametrize("flow_s", [20.0, 300.0])
def test_slow_oil_costs_time_by_the_root_of_the_drive(
    before: float, after: float, speeds: tuple[float, float], flow_s: float
) -> None:
    """Without inertia the speed follows the oil."""
    found = float(reversal(flow_s, before, after, *speeds, Inertia(1e-3, WEIGHT)))
    assert found == pytest.approx(cost(2e-2, flow_s, before, after, *speeds), rel=0.01)


@pytest.mark.parametrize("w", [0.1, 0.35])
def test_oil_at_once_costs_what_inertia_does(w: float) -> None:
    """Stopping, winning back the overrun, and starting: pi / 4, ln(2) / 2 and ln(2), of m w / F."""
    mass, drive = 70.0, 60e-6
    found = float(reversal(0.0, drive, drive, w, w, Inertia(mass, WEIGHT)))
    assert found == pytest.approx(cost(mass, 0.0, drive, drive, w, w), rel=1e-3)
    assert found == pytest.approx((pi / 4.0 + 1.5 * np.log(2.0)) * mass * w / (WEIGHT * drive))


def test_oil_and_inertia_add_up_for_a_glider() -> None:
    """The sum of both is no more than a tenth off where neither is small."""
    flow_s, before, after, w = 15.0, 50e-6, 50e-6, 0.2
    found = float(reversal(flow_s, before, after, w, w, Inertia(70.0, WEIGHT)))
    assert found == pytest.approx(cost(70.0, flow_s, before, after, w, w), rel=0.1)


def test_departure_waits_for_neutral_and_gathers_way() -> None:
    """Afloat until the oil is neutral, then as the root of the drive; against an integration from there on."""
    flow_s, afloat, after, w = 60.0, 100e-6, 50e-6, 0.2
    neutral_at = flow_s * afloat / (afloat + after)

    def speed(t: float) -> float:
        return w * sqrt(min(max((t - neutral_at) / (flow_s - neutral_at), 0.0), 1.0))

    t = np.linspace(0.0, flow_s, 20_001)
    lost = flow_s - np.trapezoid([speed(x) for x in t], t) / w
    assert float(departure(flow_s, afloat, after, w, Inertia(0.0, WEIGHT))) == pytest.approx(lost, rel=1e-4)
    started = float(departure(0.0, afloat, after, w, Inertia(70.0, WEIGHT)))
    assert started == pytest.approx(np.log(2.0) * 70.0 * w / (WEIGHT * after))
