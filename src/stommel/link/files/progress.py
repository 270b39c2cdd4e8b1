"""How far a transfer is, for whoever watches."""

from enum import Enum
from typing import NamedTuple


class State(Enum):
    """Where a transfer stands."""

    IDENTIFYING = "asks which file it is"
    FETCHING = "fetches what is missing"
    OFFERING = "offers the file, and sends what is asked for"
    WHOLE = "whole"
    REFUSED = "refused"
    FAILED = "failed"

    @property
    def is_over(self) -> bool:
        """Whether nothing more will happen."""
        return self in (State.WHOLE, State.REFUSED, State.FAILED)


class Progress(NamedTuple):
    """How far a transfer is."""

    state: State
    is_paused: bool
    reason: str
    """Why it was refused or has failed, in words; what else there is to know of a whole one."""
    done: int
    """Bytes that are there."""
    size: int | None
    """Bytes of all; None before it is known."""
    rate: float
    """New bytes a second of late."""
    seconds_left: float | None
    """Estimate; None if there is none."""
    duplicate: int
    """Bytes that came in vain."""
    loss: float
    """Share of frames that were lost of late."""

    @property
    def share(self) -> float:
        """Of the bytes that are there, 0 to 1."""
        return self.done / self.size if self.size else float(self.state is State.WHOLE)
