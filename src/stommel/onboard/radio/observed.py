"""What is known of the vehicle when telemetry is made: the last decision, and what led to it."""

from typing import NamedTuple

import numpy as np

from stommel.control.orders import Orders
from stommel.instruments.gnss.fix import Fix
from stommel.messages.codec import Values
from stommel.onboard.coordination.coordinator import Coordinator
from stommel.onboard.coordination.view import View

_NOTHING: Values = {}


class Observed(NamedTuple):
    """The vehicle at one decision; SI units and radians."""

    t: float
    """Time of the vehicle [s]."""
    utc: float
    """Seconds since 1970, by the vehicle's clock."""
    view: View
    memory: np.record | None
    """Of control; None before the first position."""
    orders: Orders | None
    mission: int
    """Number of the mission; 0 for none."""
    fix: Fix | None
    """The last position by GPS that was believed."""
    messages: dict[str, Values]
    """The last of each message of the CAN bus."""
    heard: dict[str, float]
    """When that was [s]."""

    def said(self, message: str) -> Values:
        """Values of the last message of the bus; none before the first."""
        return self.messages.get(message, _NOTHING)


def observe(coordinator: Coordinator, utc: float) -> Observed | None:
    """Look at a coordinator; None before its first decision."""
    view, pilot = coordinator.view, coordinator.pilot
    if view is None:
        return None
    return Observed(
        view.t, utc, view, pilot.memory, pilot.orders, coordinator.mission, coordinator.instruments.fix,
        coordinator.perception.latest, coordinator.perception.heard,
    )  # fmt: skip
