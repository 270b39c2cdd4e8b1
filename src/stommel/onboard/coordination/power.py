"""When the controller decides, what is on meanwhile, what wakes it, and how long the battery lasts.

Control decides in steps of `orders.step`. Between two decisions the controller may sleep for as long as its
configuration allows in the phase of the dive; frames that tell of danger wake it.
"""

import math
from typing import NamedTuple

from stommel.control.dive_cycle import PHASES
from stommel.control.orders import GUIDANCE_PERIOD, Orders
from stommel.messages.codec import Received

WAKING = ("Abort", "MotionEmergency", "AcquisitionEmergency")
"""Messages of which each frame wakes the controller; that of the hull does where a leak detector is wet."""
HULL = "Hull"
_LEAKS = ("leak_fore", "leak_aft")


class PowerSchedule(NamedTuple):
    """What goes by the phase of the dive, in the order of `PHASES`."""

    decide: tuple[float, ...] = (1.0,) * len(PHASES)
    """Time between two decisions [s]."""
    compass_rests: tuple[bool, ...] = (False,) * len(PHASES)
    """Whether the compass measures only for the decisions; else at its own interval."""
    ctd: tuple[float, ...] = (10.0,) * len(PHASES)
    """Time between two samples of the CTD [s], where the mission has it sample."""
    gps: tuple[bool, ...] = (True,) * len(PHASES)
    """Whether GPS has power where control has it listen."""


def wakes(received: Received) -> bool:
    """Whether a frame tells of danger, so that a sleeping controller decides at once."""
    if received.name == HULL:
        return any(received.values[name] for name in _LEAKS)
    return received.name in WAKING


class Sleeper:
    """Tells when the controller is to decide.

    Parameters
    ----------
    schedule
        Of the configuration.
    """

    def __init__(self, schedule: PowerSchedule | None = None) -> None:
        self.schedule = schedule or PowerSchedule()
        self.woken = 0
        """How often it was woken early."""
        self.elapsed = self.schedule.decide[0]
        """Time from the decision before to the last one [s]: the step of its orders (`orders_for`)."""
        self._decided_at, self._urgent = -math.inf, False

    def hear(self, urgent: bool) -> None:
        """Note whether a frame came that tells of danger (`wakes`)."""
        self._urgent = self._urgent or urgent

    def due(self, t: float, phase: int, abort: bool = False) -> bool:
        """Whether to decide now.

        Parameters
        ----------
        t
            Time [s].
        phase
            Of the dive.
        abort
            Whether the vehicle is brought up by its last reaction: it then sleeps no more.
        """
        interval = self.schedule.decide[phase]
        # a clock that jumped back must not let it sleep
        rested = t - self._decided_at >= interval - 1e-6 or t < self._decided_at
        if not (rested or self._urgent or abort):
            return False
        self.woken += not rested
        since = t - self._decided_at
        self.elapsed = since if 0.0 < since < math.inf else interval
        self._decided_at, self._urgent = t, False
        return True

    def sleeps_until(self, phase: int) -> float:
        """When the next decision is due if nothing wakes it [s]."""
        return self._decided_at + self.schedule.decide[phase]


def orders_for(orders: Orders, interval: float) -> Orders:
    """The same orders for decisions that lie so far apart [s]: laws and reckoning count by their step."""
    if interval == orders.step:
        return orders
    return orders._replace(step=interval, guidance_every=max(1, round(GUIDANCE_PERIOD / interval)))


class BatteryEstimate(NamedTuple):
    """What is left in the battery."""

    used: float
    """Energy taken since it was charged [J]."""
    left: float
    """Of what may be taken [J]; never below zero."""
    power: float
    """Mean power of late [W]."""
    hours_left: float
    """At that power [h]; infinite before any is known."""


class BatteryAccount:
    """Energy that was measured, and how long the rest lasts.

    Parameters
    ----------
    usable
        Energy of the charged battery that may be taken [J].
    used
        Taken before this start [J], as the log has it.
    mean_over
        Time constant of the mean power [s]: a dive and the stay at the surface after it.
    """

    def __init__(self, usable: float, used: float = 0.0, mean_over: float = 14400.0) -> None:
        self.usable, self.mean_over = usable, mean_over
        self._before, self._t, self._energy = used, math.nan, 0.0
        self._span, self._spent = 0.0, 0.0

    def update(self, t: float, energy_used: float) -> BatteryEstimate:
        """Take the account of control at a time [s]: energy since the start [J], as `memory.energy_used` has it."""
        interval, energy = t - self._t, energy_used - self._energy
        if interval > 0.0:  # not at the first, and not where a clock jumped back
            kept = math.exp(-interval / self.mean_over)
            self._span, self._spent = kept * self._span + interval, kept * self._spent + energy
        self._t, self._energy = t, energy_used
        used = self._before + energy_used
        left = max(0.0, self.usable - used)
        power = self._spent / self._span if self._span > 0.0 else 0.0
        hours = left / power / 3600.0 if power > 0.0 else math.inf
        return BatteryEstimate(used, left, power, hours)
