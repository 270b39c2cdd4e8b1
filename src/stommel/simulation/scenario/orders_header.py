"""The head of the orders that a mission file makes: for which vehicle they are, and of what they were made."""

from pathlib import Path

from stommel.control.orders_file import OrdersHeader
from stommel.simulation.scenario.mission import Mission
from stommel.vehicle.fingerprint import untrimmed_fingerprint
from stommel.version import __version__


def orders_header(mission: Mission, expires_hours: float | None = None) -> OrdersHeader:
    """Return the head of a mission's orders; they expire after the mission's duration if nothing else is said.

    How often the CTD measures stands in it where the mission file says so; else the vehicle's configuration does.
    """
    sampling = mission.scenario.sampling
    return OrdersHeader(
        mission=mission.scenario.name,
        created_from=Path(mission.origin).name,
        vehicle=mission.vehicle.name,
        vehicle_sha256=untrimmed_fingerprint(mission.vehicle),
        physics=mission.scenario.physics,
        density_kg_m3=mission.vehicle.neutral_density_kg_m3,
        stommel=__version__,
        expires_hours=mission.scenario.duration_days * 24.0 if expires_hours is None else expires_hours,
        sample_every_s=sampling.every_s if "every_s" in sampling.model_fields_set else None,
    )
