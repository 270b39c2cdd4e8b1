"""The decision of `stommel.control` aboard: its memory, and what happens when it fails."""

from collections.abc import Callable

import numpy as np

from stommel.compilation import plain
from stommel.control.commands import Commands
from stommel.control.decision import decide
from stommel.control.dive_cycle import NOTHING, SURFACE
from stommel.control.memory import new_memory
from stommel.control.orders import Orders
from stommel.control.readings import Readings
from stommel.onboard.coordination.executive import FLOWN, ExecutiveState
from stommel.onboard.coordination.executive_commands import instruct
from stommel.onboard.coordination.power import orders_for

Decide = Callable[[np.record, Orders, Readings, float], Commands]


class Pilot:
    """Decides by orders, once it knows where it is; an exception leaves the last commands standing.

    Parameters
    ----------
    decision
        Signature of `stommel.control.decision.decide`, which it is in plain Python if left out.
    """

    def __init__(self, decision: Decide | None = None) -> None:
        self._decide: Decide = plain(decide) if decision is None else decision
        self.orders: Orders | None = None
        self.memory: np.record | None = None
        self.exceptions = 0
        """Decisions in a row that ended in an exception."""
        self.failure = ""
        """Of the last exception, in words."""
        self._last: Commands | None = None
        self._taken_up = (0, 0.0)

    @property
    def phase(self) -> int:
        """Of the dive cycle."""
        return SURFACE if self.memory is None else int(self.memory["phase"])

    @property
    def event(self) -> int:
        """What happened last."""
        return NOTHING if self.memory is None else int(self.memory["event"])

    @property
    def alarm(self) -> int:
        """What ends the mission."""
        return NOTHING if self.memory is None else int(self.memory["alarm"])

    @property
    def submerged_since(self) -> float:
        """Time at which the vehicle left the surface [s]; not a number before a mission."""
        return float("nan") if self.memory is None else float(self.memory["submerged_since"])

    def adopt(self, orders: Orders, waypoint: int = 0, energy_used: float = 0.0) -> None:
        """Fly other orders from now on: its way begins anew, what it knows of place and energy stays.

        Before the first position a restarted vehicle takes up the way that it was on, with the energy that was used.
        """
        self.orders = orders
        self._taken_up = (waypoint, energy_used)
        if self.memory is not None:
            memory = new_memory(self.memory["latitude"], self.memory["longitude"], self.memory["heading_wanted"])
            for name in ("energy_used", "current_north", "current_east"):
                memory[name] = self.memory[name]
            self.memory, self._last = memory, None

    def step(self, readings: Readings, state: ExecutiveState, t: float, interval: float) -> Commands | None:
        """Decide, an interval [s] after the last time; None without orders or a first position."""
        if self.orders is None:
            return None
        if self.memory is None:
            if not readings.fixed:
                return None
            self.memory = new_memory(readings.fix_latitude, readings.fix_longitude, readings.psi)
            # its stay at the surface begins with the first decision that is obeyed
            self.memory["since"] = t if state.state in FLOWN else t + self.orders.step
            self.memory["waypoint"], self.memory["energy_used"] = self._taken_up
        orders = orders_for(self.orders, interval)
        try:
            instruct(self.memory, state, orders.step)
            self._last = _plain(self._decide(self.memory, orders, readings, t))
            self.exceptions = 0
        except Exception as error:  # noqa: BLE001 - whatever it is, the vehicle must come up
            self.exceptions += 1
            self.failure = f"{type(error).__name__}: {error}"
        return self._last


def _plain(c: Commands) -> Commands:
    """The same in Python's own numbers, which NumPy's arithmetic leaves behind."""
    return Commands(
        float(c.r_px), float(c.V_b), float(c.steering), float(c.hold_mass), int(c.loads), bool(c.sampling),
        bool(c.radio), int(c.ended),
    )  # fmt: skip
