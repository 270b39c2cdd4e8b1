"""How far the vehicle's own position may be wrong, beside the dead reckoning of control.

Control reckons the position (`stommel.control.dead_reckoning`); this module follows what it does with the covariance of
its errors, and changes nothing. The errors are of the speed through the water (a share of it), of the heading, and of
the current that is assumed; each keeps for its correlation time. The reckoned position runs away with them, a position
by GPS sets it back, and the depth-averaged current that follows from both brings the errors of the way into the next
dive, where they partly cancel. docs/theory/guidance-and-control has the equations.
"""

import math
from operator import itemgetter
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stommel.control.dive_cycle import RECOVERY, SURFACE
from stommel.control.memory import MEMORY
from stommel.geometry.attitude import wrapped
from stommel.geometry.earth import metres_per_radian

POSITION, WAY, SPEED, HEADING, CURRENT = slice(0, 2), slice(2, 4), 4, 5, slice(6, 8)
"""Errors: reckoned less true position [m], the same of the way through the water since the position of submerging [m],
of the speed (a share of it), of the heading [rad], assumed less true current [m/s]."""
_SIZE = 8
_AFLOAT = (SURFACE, RECOVERY)


class NavigationErrors(NamedTuple):
    """What is assumed of the errors of dead reckoning; standard deviations."""

    speed: float = 0.08
    """Of the speed through the water, a share of it."""
    speed_time: float = 14400.0
    """How long it keeps [s]: trim and load stay the same for some dives."""
    heading: float = math.radians(3.0)
    """[rad]"""
    heading_time: float = 7200.0
    """How long it keeps [s]: iron errs by the course."""
    current: float = 0.25
    """Of a current of which nothing is known yet, each of north and east [m/s]."""
    current_change: float = 0.08
    """By how much a current has changed after `current_time`, each of north and east [m/s]."""
    current_time: float = 21600.0
    """[s]"""
    fix: float = 10.0
    """Of a position by GPS that does not say so itself, each of north and east [m]."""


class NavigationEstimate(NamedTuple):
    """Where the vehicle thinks it is, and how well it knows; for the log and for telemetry."""

    t: float
    """[s]"""
    latitude: float
    """[rad]"""
    longitude: float
    """[rad]"""
    sigma_north: float
    """Standard error [m]."""
    sigma_east: float
    """Standard error [m]."""
    correlation: float
    """Of both, -1 to 1."""
    current_north: float
    """Depth-averaged current of the last dive, with which it reckons [m/s]."""
    current_east: float
    """The same [m/s]."""
    current_sigma: float
    """Standard error of each, against the current there now [m/s]."""
    since_fix: float
    """Time since the last position by GPS [s]; infinite if there was none."""


class PositionUncertainty:
    """The covariance of the errors of dead reckoning.

    Parameters
    ----------
    errors
        What is assumed.
    position
        Standard error of the position at the start, each of north and east [m].
    """

    def __init__(self, errors: NavigationErrors | None = None, position: float | None = None) -> None:
        self.errors = e = errors or NavigationErrors()
        self.covariance = np.zeros((_SIZE, _SIZE))
        at_start = (e.fix if position is None else position) ** 2
        self.covariance[np.diag_indices(_SIZE)] = (
            [at_start] * 2 + [0.0] * 2 + [e.speed**2, e.heading**2] + [e.current**2] * 2
        )
        self.submerged_sigma = math.sqrt(at_start)
        self._step: NDArray[np.float64] = np.eye(_SIZE)
        self._noise: NDArray[np.float64] = np.zeros(_SIZE)
        self._interval = 0.0

    def grow(self, north: float, east: float, interval: float) -> None:
        """Reckon on for an interval [s] in which the way through the water was `north` and `east` [m]."""
        if interval <= 0.0:
            return
        if interval != self._interval:
            self._prepare(interval)
        step = self._step
        step[:4, SPEED : HEADING + 1] = ((north, -east), (east, north), (north, -east), (east, north))
        P = step @ self.covariance @ step.T
        P.flat[:: _SIZE + 1] += self._noise
        self.covariance = P

    def _prepare(self, interval: float) -> None:
        """What a step of this length does whatever the way is."""
        e, step = self.errors, np.eye(_SIZE)
        kept_speed, kept_heading = math.exp(-interval / e.speed_time), math.exp(-interval / e.heading_time)
        step[SPEED, SPEED], step[HEADING, HEADING] = kept_speed, kept_heading
        step[0, 6] = step[1, 7] = interval
        new = [(1.0 - kept_speed**2) * e.speed**2, (1.0 - kept_heading**2) * e.heading**2]
        walk = e.current_change**2 / e.current_time * interval
        self._noise = np.array([0.0, 0.0, 0.0, 0.0, *new, walk, walk])
        self._step, self._interval = step, interval

    def fix(self, sigma: float) -> None:
        """Take a position by GPS of this standard error [m]: it replaces the reckoned one."""
        P = self.covariance
        P[POSITION, :] = P[:, POSITION] = 0.0
        P[0, 0] = P[1, 1] = sigma * sigma

    def find_current(self, under_water: float, sigma: float) -> None:
        """Submerge after a dive whose mean current was found from two positions and the way between.

        Parameters
        ----------
        under_water
            Time that the current is the mean of [s].
        sigma
            Standard error of the position after the dive [m].
        """
        P, e = self.covariance, self.errors
        # assumed less true current: less the error of the way over the time, with what the current has changed since
        P[CURRENT, :] = -P[WAY, :] / under_water
        P[:, CURRENT] = -P[:, WAY] / under_water
        P[CURRENT, CURRENT] = P[WAY, WAY] / under_water**2
        of_positions = (sigma**2 + self.submerged_sigma**2) / under_water**2
        walked = e.current_change**2 / e.current_time * under_water / 3.0
        P[6, 6] += of_positions + walked
        P[7, 7] += of_positions + walked
        self.submerge(sigma)

    def submerge(self, sigma: float) -> None:
        """Begin a way from a position by GPS of this standard error [m]."""
        P = self.covariance
        P[WAY, :] = P[:, WAY] = 0.0
        self.submerged_sigma = sigma


class _Seen(NamedTuple):
    """What is read of the memory of control; all at once, since each look into a record takes its time."""

    phase: float
    reckoned_north: float
    reckoned_east: float
    latitude: float
    longitude: float
    first_fix_at: float
    fix_at: float
    fix_latitude: float
    fix_longitude: float
    current_north: float
    current_east: float
    averaged_over: float


_pick = itemgetter(*(list(MEMORY.names or ()).index(name) for name in _Seen._fields))


class Navigator:
    """Follows the memory of control from decision to decision.

    Parameters
    ----------
    errors
        What is assumed of the errors.
    position
        Standard error of the position at the start, each of north and east [m].
    """

    def __init__(self, errors: NavigationErrors | None = None, position: float | None = None) -> None:
        self.uncertainty = PositionUncertainty(errors, position)
        self._t: float | None = None
        self._phase, self._afloat_since, self._reckoned = float(SURFACE), 0.0, (0.0, 0.0)
        self._fix_at, self._sigma, self._fixed = -math.inf, self.uncertainty.errors.fix, False

    def update(self, memory: np.record, t: float, fix_sigma: float | None = None) -> NavigationEstimate:
        """Tell position and error after a decision.

        Parameters
        ----------
        memory
            Of control, after its decision.
        t
            Time of the decision [s].
        fix_sigma
            Standard error of each of north and east [m] of a position that this decision took; None if it took none or
            the receiver did not say.
        """
        seen = _Seen(*_pick(memory.item()))
        phase, before, interval = seen.phase, self._phase, 0.0 if self._t is None else t - self._t
        self._t, self._phase = t, phase
        fixed = seen.fix_at > self._fix_at and seen.first_fix_at >= 0.0 and before in _AFLOAT
        if before == SURFACE and phase not in _AFLOAT and (fixed or self._fixed):
            self._take(seen, fixed, fix_sigma)
            self._submerge(seen.averaged_over)
            self._grow(seen, interval)  # control reckons from its new position already
            return self._estimate(seen, t)
        self._grow(seen, interval)
        self._take(seen, fixed, fix_sigma)
        if phase != before and phase in _AFLOAT:
            self._afloat_since, self._fixed = t, False
        return self._estimate(seen, t)

    def _grow(self, seen: _Seen, interval: float) -> None:
        north, east = seen.reckoned_north, seen.reckoned_east
        self.uncertainty.grow(north - self._reckoned[0], east - self._reckoned[1], interval)
        self._reckoned = north, east

    def _take(self, seen: _Seen, fixed: bool, sigma: float | None) -> None:
        if fixed:
            self._fix_at, self._fixed = seen.fix_at, True
            self._sigma = self.uncertainty.errors.fix if sigma is None else sigma
            self.uncertainty.fix(self._sigma)

    def _submerge(self, averaged_over: float) -> None:
        """Follow control as it leaves the surface with a position."""
        if averaged_over > 0.0:
            self.uncertainty.find_current(averaged_over, self._sigma)
        else:
            self.uncertainty.submerge(self._sigma)
        self._fixed, self._reckoned = False, (0.0, 0.0)

    def _place(self, seen: _Seen, t: float) -> tuple[float, float]:
        """Latitude and longitude [rad]; afloat control reckons on only as it submerges again."""
        if self._phase not in _AFLOAT:
            return seen.latitude, seen.longitude
        if self._fixed:
            return adrift(seen, seen.fix_latitude, seen.fix_longitude, t - self._fix_at)
        return adrift(seen, seen.latitude, seen.longitude, t - self._afloat_since)

    def _estimate(self, seen: _Seen, t: float) -> NavigationEstimate:
        P = self.uncertainty.covariance
        north, east = math.sqrt(P[0, 0]), math.sqrt(P[1, 1])
        return NavigationEstimate(
            t,
            *self._place(seen, t),
            north,
            east,
            float(P[0, 1]) / (north * east) if north * east > 0.0 else 0.0,
            seen.current_north,
            seen.current_east,
            math.sqrt(0.5 * float(P[6, 6] + P[7, 7])),
            t - self._fix_at,
        )


def adrift(seen: _Seen, latitude: float, longitude: float, since: float) -> tuple[float, float]:
    """Latitude and longitude [rad] of a place that the current which control assumes has carried so long [s]."""
    m_north, m_east = metres_per_radian(latitude)
    north, east = seen.current_north * since, seen.current_east * since
    return latitude + north / m_north, wrapped(longitude + east / m_east)
