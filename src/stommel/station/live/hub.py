"""The hub: what vehicles bring, handed on to everybody who watches, without ever waiting for any of them."""

import time
from collections.abc import Callable, Mapping, Sequence
from threading import Lock

from stommel.errors import StommelError
from stommel.station.live.events import Event, Samples, Summary, Vehicle
from stommel.station.live.subscription import EverySample, LatestValues, News, ToldPeriods
from stommel.station.periods import Periods

MOST_CHANNELS = 200
"""Of one subscription."""
MOST_READERS = 2000
"""Subscriptions at a time."""

AHEAD = 60.0
"""A value from so far after now was told before the vehicle's clock was set back: whatever comes stands for it [s]."""


class SubscriptionError(StommelError):
    """A subscription that cannot be."""


class Hub:
    """Latest values, and who waits for news. Every method may be called from any thread."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._latest: dict[Vehicle, dict[str, tuple[float, float]]] = {}
        self._clocks: dict[Vehicle, Callable[[], float]] = {}
        self._periods: dict[Vehicle, Callable[[str], float]] = {}
        self._summaries: dict[Vehicle, Summary] = {}
        self._readers: dict[Vehicle, tuple[LatestValues | EverySample, ...]] = {}
        self._news: tuple[News, ...] = ()

    # who brings

    def open(
        self,
        vehicle: Vehicle,
        now: Callable[[], float],
        latest: Mapping[str, tuple[float, float]] | None = None,
        period_of: Callable[[str], float] | None = None,
    ) -> None:
        """Take in a vehicle with its clock, the values that are known of it, and how often each comes [s]."""
        with self._lock:
            self._clocks[vehicle] = now
            self._periods[vehicle] = period_of or Periods().of_key
            self._latest.setdefault(vehicle, {}).update(latest or {})

    def restart(self, vehicle: Vehicle, latest: Mapping[str, tuple[float, float]]) -> None:
        """Put other values in place of all that are known of a vehicle, as a replay does that jumps."""
        with self._lock:
            self._latest[vehicle] = dict(latest)
            readers = self._readers.get(vehicle, ())
        for reader in readers:
            reader.restart()

    def forget(self, vehicle: Vehicle) -> None:
        """Drop a vehicle, such as a replay that has ended, and end whoever waits for its values."""
        with self._lock:
            readers = self._readers.pop(vehicle, ())
            for known in (self._latest, self._clocks, self._periods, self._summaries):
                known.pop(vehicle, None)
        for reader in readers:
            reader.close()

    def publish(self, event: Event) -> None:
        """Hand something on. Never waits."""
        if isinstance(event, Samples):
            self._publish_samples(event)
            return
        if isinstance(event, Summary):
            with self._lock:
                self._summaries[event.vehicle] = event
        for news in self._news:
            if not news.is_closed:
                news.take(event)
        self._sweep()

    def _publish_samples(self, event: Samples) -> None:
        with self._lock:
            latest = self._latest.setdefault(event.vehicle, {})
            for key, t, value in event.samples:
                known = latest.get(key)
                if known is None or t >= known[0] or known[0] > event.now + AHEAD:
                    latest[key] = (t, value)
            readers = self._readers.get(event.vehicle, ())
        for reader in readers:
            if not reader.is_closed:
                reader.take(event)
        if any(reader.is_closed for reader in readers):
            self._sweep()

    # who watches

    def values(self, vehicle: Vehicle) -> dict[str, tuple[float, float]]:
        """Time and value of the latest of each channel."""
        with self._lock:
            return dict(self._latest.get(vehicle, {}))

    def now(self, vehicle: Vehicle) -> float:
        """Time of a vehicle [s since 1970]; UTC for one that is not known."""
        clock = self._clocks.get(vehicle)
        return time.time() if clock is None else clock()

    def knows(self, vehicle: Vehicle) -> bool:
        """Whether there is such a vehicle."""
        return vehicle in self._clocks

    def listeners(self, vehicle: Vehicle) -> int:
        """How many wait for values of a vehicle."""
        return sum(not reader.is_closed for reader in self._readers.get(vehicle, ()))

    def waiting(self, vehicle: Vehicle) -> int:
        """Samples that wait for the slowest reader of a vehicle; who brings the past goes no faster than it takes."""
        return max((reader.waiting for reader in self._readers.get(vehicle, ()) if not reader.is_closed), default=0)

    def subscribe(
        self, identity: str, vehicle: Vehicle, channels: Sequence[str], every: bool = False
    ) -> LatestValues | EverySample:
        """Values of some channels of a vehicle, by the name that the reader gives.

        The latest of each, at once and when they change; or every sample from now on.

        Raises
        ------
        SubscriptionError
            There is no such vehicle, or too much is asked for.
        """
        if len(channels) > MOST_CHANNELS:
            raise SubscriptionError(f"channels: {len(channels)} were asked for; at most {MOST_CHANNELS} are allowed")
        wanted = frozenset(channels)
        periods = ToldPeriods(self._periods.get(vehicle, Periods().of_key))
        reader = (
            EverySample(identity, vehicle, wanted, periods)
            if every
            else LatestValues(identity, vehicle, wanted, lambda: (self.now(vehicle), self.values(vehicle)), periods)
        )
        self._sweep()
        with self._lock:
            if not self.knows(vehicle):  # who forgets it takes the same lock, and closes all readers that are there
                raise SubscriptionError(f"vehicle {vehicle}: this station has none of that number")
            if sum(map(len, self._readers.values())) >= MOST_READERS:
                raise SubscriptionError(f"{MOST_READERS} subscriptions are open; close a page")
            self._readers[vehicle] = (*self._readers.get(vehicle, ()), reader)
        return reader

    def watch(self) -> News:
        """Summaries and happenings of all vehicles, the last summary of each at once."""
        news = News()
        with self._lock:
            if len(self._news) >= MOST_READERS:
                raise SubscriptionError(f"{MOST_READERS} pages are open; close one")
            for summary in self._summaries.values():
                news.take(summary)
            self._news = (*self._news, news)
        return news

    def _sweep(self) -> None:
        """Forget who has gone."""
        with self._lock:
            self._news = tuple(news for news in self._news if not news.is_closed)
            for vehicle, readers in list(self._readers.items()):
                self._readers[vehicle] = tuple(reader for reader in readers if not reader.is_closed)
