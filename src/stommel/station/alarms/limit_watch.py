"""The limits of one vehicle, held against its samples."""

from collections.abc import Iterable

from stommel.station.alarms.change import Change, changes_of
from stommel.station.alarms.limits import Limit, Naming, Side, limit_key, limit_words
from stommel.station.alarms.threshold import Threshold, Transitions

Sample = tuple[str, float, float]
"""Key of the channel, time [s], value."""


class LimitWatch:
    """Every limit of a vehicle: samples in, alarms that begin or end out.

    Parameters
    ----------
    naming
        What people call a channel.
    open_keys
        Alarms that were raised before, as from before a restart.
    """

    def __init__(self, naming: Naming, open_keys: Iterable[str] = ()) -> None:
        self._naming = naming
        self._open = set(open_keys)
        self._limits: dict[str, Limit] = {}
        self._thresholds: dict[str, list[tuple[Side, Threshold]]] = {}
        self._last: dict[str, tuple[float, float]] = {}

    @property
    def limits(self) -> list[Limit]:
        """All, by name of the channel."""
        return [self._limits[channel] for channel in sorted(self._limits)]

    def limit_of(self, channel: str) -> Limit | None:
        """Limit of a channel."""
        return self._limits.get(channel)

    def put(self, limit: Limit, t: float) -> list[Change]:
        """Watch a limit from a time on [s], in place of the one before; what is raised stays so if it holds."""
        ended = [
            change
            for side in self._sides_of(limit.channel) - set(limit.sides())
            for change in self._end(limit.channel, side, t)
        ]
        self._limits[limit.channel] = limit
        self._thresholds[limit.channel] = [
            (side, limit.threshold(side, raised=limit_key(limit.channel, side) in self._open)) for side in limit.sides()
        ]
        last = self._last.get(limit.channel)
        return ended + (self._taken(limit.channel, *last) if last is not None else [])

    def remove(self, channel: str, t: float) -> list[Change]:
        """Watch a channel no more; its alarms end."""
        ended = [change for side in sorted(self._sides_of(channel)) for change in self._end(channel, side, t)]
        self._limits.pop(channel, None)
        self._thresholds.pop(channel, None)
        self._last.pop(channel, None)
        return ended

    def take(self, samples: Iterable[Sample]) -> list[Change]:
        """Take samples that came together, in whatever order."""
        watched = sorted((sample for sample in samples if sample[0] in self._thresholds), key=lambda sample: sample[1])
        return [change for channel, t, value in watched for change in self._taken(channel, t, value)]

    def look(self, t: float) -> list[Change]:
        """See which delays are over at a time [s]."""
        return [
            change
            for channel, sides in self._thresholds.items()
            for side, threshold in sides
            for change in self._told(channel, side, threshold.look(t))
        ]

    def _taken(self, channel: str, t: float, value: float) -> list[Change]:
        if channel not in self._last or t >= self._last[channel][0]:
            self._last[channel] = t, value
        return [
            change
            for side, threshold in self._thresholds[channel]
            for change in self._told(channel, side, threshold.take(t, value))
        ]

    def _told(self, channel: str, side: Side, transitions: Transitions) -> list[Change]:
        if not transitions:
            return []
        limit, key = self._limits[channel], limit_key(channel, side)
        (self._open.add if transitions[-1].raised else self._open.discard)(key)
        return changes_of(key, transitions, limit_words(limit, side, self._naming), limit.severity)

    def _sides_of(self, channel: str) -> set[Side]:
        return {side for side in ("low", "high") if limit_key(channel, side) in self._open}

    def _end(self, channel: str, side: Side, t: float) -> list[Change]:
        key = limit_key(channel, side)
        self._open.discard(key)
        return [Change(key, False, t, None, "", "notice")]
