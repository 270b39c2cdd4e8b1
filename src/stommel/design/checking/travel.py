"""Travel of the moving mass against its limit switches, and of bays and places against each other."""

from collections.abc import Iterator

from stommel.design.named_warning import NamedWarning
from stommel.vehicle import Vehicle


def travels(vehicle: Vehicle) -> Iterator[NamedWarning]:
    """The software's travel must end before the switches cut the motor off."""
    d = vehicle.description
    stated, pitch = d.actuators.moving_mass, d.drives.pitch if d.drives is not None else None
    if stated is None or pitch is None:
        return
    (low, high), (aft, fore) = stated.travel_mm, pitch.switches_mm
    if low <= aft or high >= fore:
        yield NamedWarning(
            "switch_within_travel",
            f"actuators.moving_mass.travel_mm = [{low:g}, {high:g}] reaches the limit switches, "
            f"drives.pitch.switches_mm = [{aft:g}, {fore:g}]",
        )
