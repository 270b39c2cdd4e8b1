"""Time that turning from dive to climb costs: oil flows for a while, and the vehicle's inertia answers."""

from dataclasses import dataclass
from math import log, pi

import numpy as np
from numpy.typing import NDArray

from stommel.machinery.power.actuator_work import Quantity

Array = NDArray[np.float64]

OVERRUN = 0.5 * log(2.0)
"""Way that coming to rest takes, in units of m w2 / F (eq-e14)."""
STOPPING = pi / 4.0 + OVERRUN
"""Time to come to rest and to win back the depth that is overrun meanwhile, in units of m w / F (eq-e14)."""
STARTING = log(2.0)
"""Time that getting under way from rest costs, in units of m w / F (eq-e14)."""


@dataclass(frozen=True)
class Inertia:
    """What resists a change of vertical motion."""

    mass: float
    """Of the vehicle with the water that it carries along its axis [kg]."""
    weight: float
    """Weight of displaced water, rho g [N/m3]."""

    def time(self, w: Quantity, drive: Quantity) -> Array:
        """m w / F for vertical speed [m/s] and ballast beyond neutral [m3]; [s]."""
        return np.asarray(self.mass * np.asarray(w) / (self.weight * np.asarray(drive)))


def reversal(flow_s: Quantity, before: Quantity, after: Quantity, w_before: Quantity, w_after: Quantity,
             inertia: Inertia) -> Array:  # fmt: skip
    """Time that a turn costs beside flying both ways at full speed [s] (eq-e13), (eq-e14).

    Parameters
    ----------
    flow_s
        Time in which the oil flows [s].
    before, after
        Ballast volume beyond neutral before and after the turn, both positive [m3].
    w_before, w_after
        Vertical speeds that they drive, both positive [m/s].
    """
    share = np.asarray(before) / (np.asarray(before) + after)
    ratio = np.asarray(w_before) / w_after
    flowing = flow_s * (share + 2.0 / 3.0 * share * ratio + (1.0 - share) / 3.0)
    answering = STOPPING * inertia.time(w_before, after) + STARTING * inertia.time(w_after, after)
    return np.asarray(flowing + answering)


def departure(flow_s: Quantity, afloat: Quantity, after: Quantity, w_after: Quantity, inertia: Inertia) -> Array:
    """Time that leaving the surface costs beside diving at full speed [s] (eq-e13), (eq-e14).

    `afloat` is the ballast volume beyond neutral at the surface [m3]; the rest is as in `reversal`.
    """
    share = np.asarray(afloat) / (np.asarray(afloat) + after)
    flowing = flow_s * (share + (1.0 - share) / 3.0)
    return np.asarray(flowing + STARTING * inertia.time(w_after, after))
