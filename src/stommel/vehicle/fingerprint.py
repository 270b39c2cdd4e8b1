"""A hash of a vehicle, so that what was computed for it can be told from what was computed for another."""

import hashlib
import json

from stommel.vehicle.loading import Vehicle


def fingerprint(vehicle: Vehicle) -> str:
    """SHA-256 of everything that the vehicle's file says of its numbers, in hexadecimal.

    Comments, provenance, the order of the keys and whether a default is written down do not count.
    """
    description = vehicle.description.model_dump(mode="json") | {"trimmed_for_kg_m3": vehicle.trimmed_for_kg_m3}
    return hashlib.sha256(json.dumps(description, sort_keys=True).encode()).hexdigest()
