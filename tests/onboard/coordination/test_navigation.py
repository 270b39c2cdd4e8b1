"""Oracle: many vehicles whose speed, heading and current err as assumed (Monte Carlo), and closed forms by hand."""

import time
from math import cos, exp, hypot, inf, pi, radians, sin, sqrt

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.stats import chi2

from stommel.control.dead_reckoning import depth_averaged_current, leave_surface, surface, take_fix
from stommel.control.dive_cycle import ASCENT, DESCENT, RECOVERY, SURFACE
from stommel.control.memory import new_memory
from stommel.geometry.earth import metres_per_radian
from stommel.onboard.coordination.navigation import NavigationErrors, Navigator, PositionUncertainty

Array = NDArray[np.float64]
ERRORS = NavigationErrors(
    speed=0.08, speed_time=9000.0, heading=radians(4.0), heading_time=5000.0, current=0.2, current_change=0.06,
    current_time=20000.0, fix=12.0,
)  # fmt: skip
STEP = 60.0
FAST = 0.35
"""Way through the water [m/s]."""


class Fleet:
    """Many vehicles, each with errors of its own, that reckon and fix as control does; no covariance in it."""

    def __init__(self, count: int, seed: int) -> None:
        self.noise, self.count, e = np.random.default_rng(seed), count, ERRORS
        self.speed, self.heading = e.speed * self.draw(), e.heading * self.draw()
        self.current = e.current * self.draw(2)  # the true one; none is assumed
        self.assumed = np.zeros((count, 2))
        self.position_error = e.fix * self.draw(2)
        self.start_error = self.position_error.copy()
        self.way_error, self.drifted, self.under_water = np.zeros((count, 2)), np.zeros((count, 2)), 0.0

    def draw(self, *shape: int) -> Array:
        return self.noise.standard_normal((self.count, *shape))

    def go(self, course: float, seconds: float) -> None:
        e = ERRORS
        kept = exp(-STEP / e.speed_time), exp(-STEP / e.heading_time)
        for _ in range(round(seconds / STEP)):
            way = FAST * STEP
            true = np.array([cos(course), sin(course)]) * way
            turned = course + self.heading
            told = (1.0 + self.speed)[:, None] * way * np.column_stack([np.cos(turned), np.sin(turned)])
            self.way_error += told - true
            self.position_error += told - true + (self.assumed - self.current) * STEP
            self.drifted += self.current * STEP
            self.under_water += STEP
            self.speed = kept[0] * self.speed + sqrt(1 - kept[0] ** 2) * e.speed * self.draw()
            self.heading = kept[1] * self.heading + sqrt(1 - kept[1] ** 2) * e.heading * self.draw()
            self.current = self.current + e.current_change * sqrt(STEP / e.current_time) * self.draw(2)

    def surface(self) -> None:
        """A position, the depth-averaged current from it, and down again."""
        found_error = ERRORS.fix * self.draw(2)
        found = self.drifted + found_error - self.start_error  # beyond the true way
        for k in range(self.count):
            self.assumed[k] = depth_averaged_current(*self.way_error[k], *found[k], self.under_water)
        self.position_error, self.start_error = found_error.copy(), found_error.copy()
        self.way_error, self.drifted, self.under_water = 0.0 * found, 0.0 * found, 0.0


def go(uncertainty: PositionUncertainty, course: float, seconds: float) -> None:
    for _ in range(round(seconds / STEP)):
        uncertainty.grow(FAST * STEP * cos(course), FAST * STEP * sin(course), STEP)


MISSION = [(0.7, 7200.0), (0.7, 10800.0), (0.7 + pi, 7200.0), (0.7 + pi / 2, 14400.0)]
"""Courses and times of dives; a position after each."""


def consistent(errors: Array, covariance: Array) -> None:
    """The normalised error is chi-squared with two degrees of freedom, on the whole and to each side."""
    count = len(errors)
    normalised = np.einsum("ki,ij,kj->k", errors, np.linalg.inv(covariance), errors)
    low, high = (float(chi2.ppf(share, 2 * count)) / count for share in (1e-5, 1.0 - 1e-5))
    # a heading error of some degrees shortens the way a little, which the linear covariance leaves out
    assert 0.97 * low < normalised.mean() < 1.03 * high
    assert np.mean(normalised < chi2.ppf(0.95, 2)) == pytest.approx(0.95, abs=0.02)
    np.testing.assert_allclose(np.cov(errors.T), covariance, atol=0.12 * np.trace(covariance) / 2)


def test_error_is_that_of_many_vehicles() -> None:
    """Of position and current, through dives of several courses with a position after each."""
    fleet, uncertainty = Fleet(3000, 1), PositionUncertainty(ERRORS)
    for course, seconds in MISSION:
        fleet.go(course, seconds)
        go(uncertainty, course, seconds)
        consistent(fleet.position_error, uncertainty.covariance[:2, :2])
        fleet.surface()
        uncertainty.fix(ERRORS.fix)
        uncertainty.find_current(seconds, ERRORS.fix)
        consistent(fleet.assumed - fleet.current, uncertainty.covariance[6:, 6:])


def test_errors_of_the_way_cancel_in_the_current() -> None:
    """On the same course the current takes them up: a second dive goes less astray than one that turns back."""
    far = {}
    for turn in (0.0, pi):
        uncertainty = PositionUncertainty(ERRORS._replace(speed_time=1e9, heading_time=1e9, current_change=0.0))
        go(uncertainty, 0.0, 7200.0)
        uncertainty.fix(0.0)
        uncertainty.find_current(7200.0, 0.0)
        go(uncertainty, turn, 7200.0)
        far[turn] = sqrt(np.trace(uncertainty.covariance[:2, :2]))
    assert far[0.0] == pytest.approx(12.0 * sqrt(2.0), rel=0.01)  # only the error of the position at the very start
    assert far[pi] == pytest.approx(2 * FAST * 7200 * hypot(ERRORS.speed, ERRORS.heading), rel=0.01)


def test_closed_form_of_one_leg() -> None:
    """Errors that keep for ever: of the speed along the way, of the heading across, of the current both ways."""
    uncertainty = PositionUncertainty(
        ERRORS._replace(speed_time=1e12, heading_time=1e12, current_change=0.0), position=5.0
    )
    go(uncertainty, pi / 2, 3600.0)
    P, way = uncertainty.covariance, FAST * 3600.0
    assert P[0, 0] == pytest.approx(25 + (ERRORS.heading * way) ** 2 + (0.2 * 3600) ** 2, rel=1e-6)
    assert P[1, 1] == pytest.approx(25 + (ERRORS.speed * way) ** 2 + (0.2 * 3600) ** 2, rel=1e-6)
    assert P[0, 1] == pytest.approx(0.0, abs=1e-6)


def test_grows_under_water_and_shrinks_at_a_position() -> None:
    uncertainty, before = PositionUncertainty(), 0.0
    for _ in range(600):
        uncertainty.grow(0.3, 0.1, 1.0)
        assert uncertainty.covariance[0, 0] > before
        before = float(uncertainty.covariance[0, 0])
    uncertainty.fix(4.0)
    assert uncertainty.covariance[0, 0] == uncertainty.covariance[1, 1] == 16.0
    assert np.linalg.eigvalsh(uncertainty.covariance)[0] >= -1e-9


def test_interval_of_the_decisions_does_not_matter() -> None:
    """A controller that sleeps for 10 s between decisions knows the same."""
    often, seldom = PositionUncertainty(ERRORS), PositionUncertainty(ERRORS)
    for _ in range(3600):
        often.grow(0.3, 0.1, 1.0)
    for _ in range(360):
        seldom.grow(3.0, 1.0, 10.0)
    np.testing.assert_allclose(seldom.covariance[:2, :2], often.covariance[:2, :2], rtol=0.005)


# beside control


def dive(navigator: Navigator, memory: np.record, t: float, seconds: int, fixed: bool) -> float:
    """Leave the surface, go north-east, come up, and find a position or none, as control's decision does it."""
    leave_surface(memory, t)
    memory.metres_north, memory.metres_east = metres_per_radian(memory.latitude)
    for k in range(seconds):
        memory.phase = DESCENT if k < seconds // 2 else ASCENT
        memory.reckoned_north += 0.2
        memory.reckoned_east += 0.2
        memory.latitude += (0.2 + memory.current_north) / memory.metres_north
        memory.longitude += (0.2 + memory.current_east) / memory.metres_east
        t += 1.0
        navigator.update(memory, t)
    memory.phase = SURFACE
    surface(memory, t)
    navigator.update(memory, t)
    t += 100.0
    if fixed:
        take_fix(memory, t, memory.latitude + 500.0 / memory.metres_north, float(memory.longitude))
    navigator.update(memory, t, 8.0 if fixed else None)
    return t


def started() -> tuple[Navigator, np.record]:
    memory = new_memory(radians(18.0), radians(116.0), 0.0)
    memory.metres_north, memory.metres_east = metres_per_radian(memory.latitude)
    navigator = Navigator(ERRORS, position=500.0)
    assert navigator.update(memory, 0.0).since_fix == inf
    return navigator, memory


def test_follows_control_through_dives() -> None:
    navigator, memory = started()
    take_fix(memory, 50.0, radians(18.0), radians(116.0))
    told = navigator.update(memory, 50.0, 6.0)
    assert (told.sigma_north, told.sigma_east, told.since_fix) == (6.0, 6.0, 0.0)
    t = dive(navigator, memory, 60.0, 3000, fixed=True)
    told = navigator.update(memory, t)
    assert (told.sigma_north, told.since_fix) == (8.0, 0.0)
    assert (told.latitude, told.longitude) == (memory.fix_latitude, memory.fix_longitude)
    before = told.current_sigma
    leave_surface(memory, t + 10.0)
    memory.phase = DESCENT
    told = navigator.update(memory, t + 10.0)
    assert told.current_sigma < 0.3 * before  # the current is known now
    assert told.current_north == pytest.approx(500.0 / 3000.0, abs=0.02)


def test_without_a_position_the_error_goes_on() -> None:
    navigator, memory = started()
    take_fix(memory, 50.0, radians(18.0), radians(116.0))
    navigator.update(memory, 50.0, 6.0)
    t = dive(navigator, memory, 60.0, 3000, fixed=True)
    known = navigator.update(memory, t)
    t = dive(navigator, memory, t, 3000, fixed=False)
    once = navigator.update(memory, t)
    assert once.since_fix == 3100.0
    # afloat it is carried by the current: 100 s at 0.17 m/s
    assert (once.latitude - memory.latitude) * memory.metres_north == pytest.approx(
        100.0 * once.current_north, rel=1e-3
    )
    t = dive(navigator, memory, t, 3000, fixed=False)
    twice = navigator.update(memory, t)
    assert known.sigma_north == 8.0 < once.sigma_north < twice.sigma_north
    assert twice.since_fix == 6200.0


def test_a_position_in_recovery_counts_and_one_under_water_does_not() -> None:
    navigator, memory = started()
    take_fix(memory, 50.0, radians(18.0), radians(116.0))
    navigator.update(memory, 50.0, 6.0)
    memory.phase = DESCENT
    leave_surface(memory, 51.0)
    navigator.update(memory, 51.0)
    take_fix(memory, 52.0, radians(19.0), radians(116.0))
    assert navigator.update(memory, 52.0, 6.0).sigma_north > 6.0
    memory.phase = RECOVERY
    navigator.update(memory, 53.0)
    take_fix(memory, 54.0, radians(18.0), radians(116.0))
    assert navigator.update(memory, 54.0, 6.0).sigma_north == 6.0


def test_an_estimate_costs_little() -> None:
    navigator, memory = started()
    memory.phase, best = DESCENT, inf
    for repeat in range(5):
        began = time.process_time()
        for k in range(1000):
            memory.reckoned_north += 0.3
            navigator.update(memory, 1000.0 * repeat + k)
        best = min(best, (time.process_time() - began) / 1000)
    assert best < 100e-6, f"{best * 1e6:.0f} us"
