"""What every service of the link is: messages in, messages into an outbox, by a time that is given."""

from typing import NamedTuple, Protocol

from stommel.link.outbox import Outbox
from stommel.messages.mavlink import Fields

VEHICLE_COMPONENT = 1
"""MAV_COMP_ID_AUTOPILOT1: the coordination software."""
SHORE_COMPONENT = 190
"""MAV_COMP_ID_MISSIONPLANNER: a shore station."""
SHORE_SYSTEM = 255
"""What ground stations call themselves."""

Peer = tuple[int, int]
"""System and component."""


class Received(NamedTuple):
    """A message that the session has accepted."""

    system: int
    component: int
    name: str
    values: Fields


class Service(Protocol):
    """One conversation; it knows neither port nor clock."""

    def take(self, received: Received, t: float) -> None:
        """Take a message at a time [s]; what is not its own is passed over."""

    def poll(self, t: float, outbox: Outbox) -> None:
        """Say what is due at a time [s]; is called often, and again as soon as the outbox has room."""


def is_for(received: Received, system: int, component: int) -> bool:
    """Whether a message names this end as its target, or all (0), or none."""
    target_system = received.values.get("target_system", 0)
    target_component = received.values.get("target_component", 0)
    return target_system in (0, system) and target_component in (0, component)
