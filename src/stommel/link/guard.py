"""Who may be heard: what a session asks before it believes a frame, and by what its own are signed."""

from typing import Protocol

from stommel.link.frames import RawFrame


class Guard(Protocol):
    """Checks and makes signatures."""

    @property
    def signs(self) -> bool:
        """Whether frames that are sent now carry a signature."""

    def accept(self, frame: RawFrame, t: float) -> bool:
        """Whether a frame that came at a time [s] is believed; what is not is counted there."""

    def sign(self, frame: bytes, t: float) -> bytes:
        """Return a frame, whose flag says that it is signed, with its signature behind it, made at a time [s]."""
