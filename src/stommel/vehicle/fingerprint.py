"""A hash of a vehicle, so that what was computed for it can be told from what was computed for another."""

import hashlib
import json
from typing import Any

from stommel.vehicle.loading import Vehicle


def fingerprint(vehicle: Vehicle) -> str:
    """SHA-256 of everything that the vehicle's file says of its numbers, in hexadecimal, and of its trim.

    Comments, provenance, the order of the keys and whether a default is written down do not count.
    """
    return _hash_of(vehicle.description.model_dump(mode="json") | {"trimmed_for_kg_m3": vehicle.trimmed_for_kg_m3})


def untrimmed_fingerprint(vehicle: Vehicle) -> str:
    """The same without its trim: by it a vehicle knows its missions, whatever water it is trimmed for."""
    return _hash_of(vehicle.description.model_dump(mode="json"))


def _hash_of(description: dict[str, Any]) -> str:
    return hashlib.sha256(json.dumps(description, sort_keys=True).encode()).hexdigest()
