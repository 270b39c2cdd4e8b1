"""What waits for a vehicle, as the API tells it."""

from pydantic import BaseModel

from stommel.station.vehicles.waiting import AbortStep


class OpenAbort(BaseModel):
    """The newest abort of which the vehicle has not said the last word."""

    id: str
    step: AbortStep
    """It waits here, may have left, or the vehicle has it."""
    words: str
    """What is known of it."""
    given: float
    expires: float


class Waiting(BaseModel):
    """How many of each have had no last word; files that somebody lets rest are not counted."""

    commands: int
    """With aborts."""
    parameters: int
    missions: int
    transfers: int
    abort: OpenAbort | None
