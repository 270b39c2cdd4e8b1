"""The mission that is flown, as those who send another one see it."""

from stommel.control.dive_cycle import RECOVERY
from stommel.link.missions.port import WaypointProgress
from stommel.messages.mavlink import enumeration
from stommel.onboard.coordination.coordinator import Coordinator


class FlownMission:
    """Asks the coordinator how far it is, and whether another mission may be taken."""

    def __init__(self, coordinator: Coordinator) -> None:
        self._coordinator = coordinator

    def progress(self) -> WaypointProgress:
        """How far the vehicle has come."""
        pilot, view = self._coordinator.pilot, self._coordinator.view
        if pilot.orders is None:
            return WaypointProgress(None, None, _state("NO_MISSION"))
        if view is None or pilot.memory is None:
            return WaypointProgress(0, None, _state("NOT_STARTED"), len(pilot.orders.waypoints))
        number, count = int(pilot.memory["waypoint"]), len(pilot.orders.waypoints)
        if pilot.phase == RECOVERY and number >= count:
            state = "COMPLETE"
        else:
            state = "ACTIVE" if view.executive.started else "NOT_STARTED"
        return WaypointProgress(
            min(number, count - 1) if count else None, number - 1 if number else None, _state(state), count
        )

    def aim_at(self, number: int) -> str:
        """Aim at a waypoint; why not, in words, or nothing."""
        return self._coordinator.aim_at(number)

    def why_not_now(self) -> str:
        """Why no other mission may be taken now, in words, or nothing."""
        view = self._coordinator.view
        if view is not None and view.safety.submerged:
            return "the vehicle is under water; send it at the surface"
        return ""


def _state(word: str) -> int:
    return enumeration("MISSION_STATE")[f"MISSION_STATE_{word}"]
