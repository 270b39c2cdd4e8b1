"""Asking a line's thread from a thread that waits for the answer."""

from collections.abc import Callable
from concurrent.futures import CancelledError
from concurrent.futures import TimeoutError as TooLate
from typing import TypeVar

from stommel.link.shore.shore_end import ShoreEnd
from stommel.station.vehicles.line import VehicleLine
from stommel.station.vehicles.opening import LateError, VehicleError

ANSWER_WITHIN = 5.0
"""Time for a line's thread to do something [s]."""

T = TypeVar("T")


def ask(line: VehicleLine, function: Callable[[ShoreEnd, float], T]) -> T:
    """Let the line's thread call a function with the end and the time of the link, and wait for what it returns.

    Raises
    ------
    VehicleError
        It has not done so in time, and will not; or the station ends.
    LateError
        It was doing it, and nobody knows whether it has.
    """
    future = line.ask(function)
    try:
        return future.result(ANSWER_WITHIN)
    except CancelledError:
        raise VehicleError(f"vehicle {line.vehicle}: the station ends, and nothing was done") from None
    except TooLate:
        if future.cancel():
            raise VehicleError(
                f"vehicle {line.vehicle}: the line is busy, and nothing was done; try again in a moment"
            ) from None
    try:
        return future.result(ANSWER_WITHIN)
    except TooLate:
        raise LateError(
            f"vehicle {line.vehicle}: the line is busy with it; look in a moment what has become of it"
        ) from None
