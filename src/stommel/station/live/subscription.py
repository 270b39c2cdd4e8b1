"""What readers can wait for: the latest values, every sample, or what happens."""

from collections import deque
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from stommel.station.live.events import Happening, Samples, Summary, Vehicle
from stommel.station.live.mailbox import Mailbox, Message

VALUES_EVERY = 0.2
"""Shortest time between two messages [s]."""
MOST_SAMPLES = 50_000
"""That wait for a reader of every sample."""
MOST_HAPPENINGS = 1000
NEW_PERIOD = 1.2
"""A period is told again when it is longer or shorter by this factor than it was told."""

Latest = Mapping[str, tuple[float, float]]


class ToldPeriods:
    """How often values come, as one reader knows it."""

    def __init__(self, period_of: Callable[[str], float]) -> None:
        self._period_of = period_of
        self._told: dict[str, float] = {}

    def news(self, channels: Iterable[str]) -> dict[str, float]:
        """Periods that the reader does not know yet, of some channels [s]."""
        found = {}
        for key in channels:
            period, known = self._period_of(key), self._told.get(key, 0.0)
            if not known / NEW_PERIOD <= period <= known * NEW_PERIOD:
                found[key] = round(period, 3)
        self._told.update(found)
        return found


class LatestValues(Mailbox):
    """The latest value of each channel, those that have changed; a slow reader skips."""

    def __init__(
        self, identity: str, vehicle: Vehicle, channels: frozenset[str], look: Callable[[], tuple[float, Latest]],
        periods: ToldPeriods,
    ) -> None:  # fmt: skip
        super().__init__(VALUES_EVERY)
        self.vehicle = vehicle
        self._identity, self._channels, self._look, self._periods = identity, channels, look, periods
        self._sent: dict[str, tuple[float, float]] = {}
        self._is_first = True

    def take(self, event: Samples) -> None:  # noqa: ARG002 - the hub has the latest
        """Take note that there is something new."""
        self.ring()

    def restart(self) -> None:
        """Take note that all values are others."""
        self.ring()

    @property
    def waiting(self) -> int:
        """Samples that wait: none, as the latest is enough."""
        return 0

    def collect(self) -> Message | None:
        """What has changed since the last time; at first what there is, even if that is nothing."""
        now, latest = self._look()
        news = {
            key: latest[key] for key in self._channels if key in latest and self._sent.get(key) != latest[key]
        }  # fmt: skip
        if not news and not self._is_first:
            return None
        self._is_first = False
        self._sent.update(news)
        return {
            "type": "values", "id": self._identity, "vehicle": self.vehicle, "now": now,
            "values": {key: list(pair) for key, pair in news.items()}, "periods": self._periods.news(news),
        }  # fmt: skip


class EverySample(Mailbox):
    """All samples; a reader that is too slow is told from when on some are missing."""

    def __init__(self, identity: str, vehicle: Vehicle, channels: frozenset[str], periods: ToldPeriods) -> None:
        super().__init__(VALUES_EVERY)
        self.vehicle = vehicle
        self._identity, self._channels, self._periods = identity, channels, periods
        self._waiting: deque[Samples] = deque()
        self._count = 0
        self._gap: float | None = None

    def take(self, event: Samples) -> None:
        """Take what came."""
        with self._lock:
            self._waiting.append(event)
            self._count += len(event.samples)
            while self._count > MOST_SAMPLES and len(self._waiting) > 1:
                dropped = self._waiting.popleft()
                self._count -= len(dropped.samples)
                first = min(t for _, t, _ in dropped.samples)
                self._gap = first if self._gap is None else min(first, self._gap)
        self.ring()

    def restart(self) -> None:
        """Drop what waits: it is of another time."""
        with self._lock:
            self._waiting.clear()
            self._count, self._gap = 0, None

    @property
    def waiting(self) -> int:
        """Samples that wait."""
        return self._count

    def collect(self) -> Message | None:
        """All that waits, or that some was lost."""
        with self._lock:
            gap, self._gap = self._gap, None
            if gap is not None:
                return {"type": "gap", "id": self._identity, "vehicle": self.vehicle, "from": gap}
            waiting, self._waiting, self._count = list(self._waiting), deque(), 0
        found: dict[str, tuple[list[float], list[float]]] = {}
        for event in waiting:
            for key, t, value in event.samples:
                if key in self._channels:
                    times, values = found.setdefault(key, ([], []))
                    times.append(t)
                    values.append(value)
        if not found:
            return None
        return {
            "type": "samples", "id": self._identity, "vehicle": self.vehicle, "now": waiting[-1].now,
            "samples": {key: list(pair) for key, pair in found.items()}, "periods": self._periods.news(found),
        }  # fmt: skip


class News(Mailbox):
    """Happenings, and the latest summary of each vehicle, which tells itself at most once a second."""

    def __init__(self) -> None:
        super().__init__()
        self._happenings: deque[Happening] = deque(maxlen=MOST_HAPPENINGS)
        self._lost = 0
        self._summaries: dict[Vehicle, Mapping[str, Any]] = {}

    def take(self, event: Happening | Summary) -> None:
        """Take what happened."""
        with self._lock:
            if isinstance(event, Summary):
                self._summaries[event.vehicle] = event.summary
            else:
                self._lost += len(self._happenings) == MOST_HAPPENINGS
                self._happenings.append(event)
        self.ring()

    def collect(self) -> Message | None:
        """The happening that waits longest, or a summary."""
        with self._lock:
            if self._lost:
                lost, self._lost = self._lost, 0
                return {"type": "gap", "id": "", "lost": lost}
            if self._happenings:
                found = self._happenings.popleft()
                return {"type": "event", "kind": found.kind, "vehicle": found.vehicle, "data": found.data}
            for vehicle in self._summaries:
                return {"type": "summary", "vehicle": vehicle, "summary": self._summaries.pop(vehicle)}
        return None


Subscription = LatestValues | EverySample | News
