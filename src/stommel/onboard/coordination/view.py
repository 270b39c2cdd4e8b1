"""What the coordinator made of the last decision, for logs, live views and tests."""

from typing import NamedTuple

from stommel.control.commands import Commands
from stommel.onboard.coordination.executive import ExecutiveState
from stommel.onboard.coordination.health import Health
from stommel.onboard.coordination.navigation import NavigationEstimate
from stommel.onboard.coordination.node_mirror import ParameterOutcome
from stommel.onboard.coordination.power import BatteryEstimate
from stommel.onboard.coordination.safety import SafetyState
from stommel.onboard.coordination.situation import Situation


class View(NamedTuple):
    """One decision, and what led to it."""

    t: float
    """Time of the vehicle [s]."""
    situation: Situation
    safety: SafetyState
    executive: ExecutiveState
    commands: Commands
    health: Health
    parameters: tuple[ParameterOutcome, ...]
    """What became of parameters of the nodes that were written or saved, since the decision before."""
    navigation: NavigationEstimate | None
    """None before the first position."""
    battery: BatteryEstimate | None
    """None before the first position, and where nobody said what the battery holds."""
