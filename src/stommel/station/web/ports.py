"""What the web door needs of the station behind it."""

from collections.abc import AsyncIterator, Mapping, Sequence
from typing import Any, Protocol


class Subscription(Protocol):
    """Messages for one reader; a slow reader skips and never holds anybody up."""

    def __aiter__(self) -> AsyncIterator[dict[str, Any]]:
        """Messages as they come, ready for JSON."""

    def close(self) -> None:
        """No more of them."""


class Hub(Protocol):
    """Live data."""

    def subscribe(self, identity: str, vehicle: int | str, channels: Sequence[str], every: bool) -> Subscription:
        """Values of some channels of a vehicle, by the name that the reader gives."""

    def watch(self) -> Subscription:
        """Summaries and events of all vehicles."""


class Station(Protocol):
    """The station, wired."""

    @property
    def vehicles(self) -> Mapping[int, Any]:
        """Lines to the vehicles by number."""

    @property
    def hub(self) -> Hub:
        """Live data of them."""
