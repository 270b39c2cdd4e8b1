"""The data log of a vehicle: append-only series of files, bounded, which outlive a loss of power at any byte.

No clock and no thread: records come with their time, `step` is told what time it is, and the disk is a `Storage`.
"""

import struct
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, NamedTuple

from stommel.errors import StommelError
from stommel.files.storage import Storage
from stommel.messages.log.layout import SEQUENCES, SERIES
from stommel.messages.log.names import LogName, log_name
from stommel.onboard.coordination.logbook.framing import ClockReading, LogIdentity, encoder, header
from stommel.onboard.coordination.logbook.records import DETAIL, ESSENTIAL, EVENT, KINDS, RAW, RecordKind
from stommel.onboard.coordination.logbook.series import Counts, Series, SyncPolicy

_OFTEN, _AT_TIMES, _SELDOM = SyncPolicy(20, 5.0), SyncPolicy(200, 30.0), SyncPolicy(2000, 60.0)
_HEADER_BYTES = 4096
"""More than the header of any series takes."""
CLOCK_STEP, CLOCK_EVERY = 1.0, 60.0
"""A clock that is set by more than this [s] begins new files, no more often than this [s]: each file has one clock."""


class LogSettingsError(StommelError):
    """Bounds of a log that contradict each other."""


@dataclass(frozen=True)
class LogSettings:
    """How much a log may take, and how often it is brought to the disk."""

    total_bytes: int = 1 << 30
    """Of all files together."""
    file_bytes: int = 4 << 20
    """A file that has grown so large is closed, and the next begun."""
    memory_bytes: int = 512 << 10
    """Of records that no disk takes, in each series."""
    retry_s: float = 10.0
    """From one try to the next while the disk takes nothing."""
    raw: bool = False
    """Whether frames of the bus and bytes of the ports are kept."""
    sync: tuple[SyncPolicy, SyncPolicy, SyncPolicy] = (_OFTEN, _AT_TIMES, _SELDOM)
    """When records are committed, for each series."""

    def __post_init__(self) -> None:
        if self.file_bytes < 1 << 14:
            raise LogSettingsError(f"log.file_bytes = {self.file_bytes}: must be at least {1 << 14}")
        least = 2 * len(SERIES) * self.file_bytes
        if self.total_bytes < least:
            raise LogSettingsError(
                f"log.total_bytes = {self.total_bytes}: must be at least {least}, two files of each series"
            )


class Removed(NamedTuple):
    """Files that were removed to make room."""

    files: int
    bytes: int
    unsent_files: int
    """Of them, those that nobody ashore has."""


class Logbook:
    """The log that is being written; begins new files, and never touches those of before but to remove them.

    Parameters
    ----------
    storage
        Its disk.
    settings
        How much it may take.
    identity
        What writes it.
    t
        Time of the software [s].
    utc
        UTC by the vehicle's clock [s since 1970] at a time of the software [s]; None where there is no clock.
    """

    def __init__(
        self,
        storage: Storage,
        settings: LogSettings,
        identity: LogIdentity,
        t: float,
        utc: Callable[[float], float] | None = None,
    ) -> None:
        self.storage, self._settings, self._identity = storage, settings, identity
        self._utc = utc
        self._clock = self._read_clock(t)
        self._sizes: dict[str, int] = {}
        self.restarts = 0
        """How often a log was begun here before."""
        self._listed = self._list()
        self.removed = Removed(0, 0, 0)
        self.malformed = 0
        """Records that were refused since a value did not fit its field."""
        self._series = tuple(Series(storage, policy, settings.memory_bytes) for policy in settings.sync)
        self._encoders = {kind.number: encoder(kind) for kind in KINDS}
        self._files = 0
        self._retry_at = t
        self._told_dropped = [0] * len(SERIES)
        self._told_removed = self.removed
        self._told_malformed: set[int] = set()
        self._t = t

    def _list(self) -> bool:
        """Look what is there, and take the next run; False while the disk does not answer."""
        try:
            sizes = self.storage.sizes()
        except OSError:
            return False
        self._sizes = {name: size for name, size in sizes.items() if log_name(name)}
        self.restarts = 1 + max((parsed.run for name in sizes if (parsed := log_name(name))), default=-1)
        return True

    def append(self, kind: RecordKind, values: Sequence[Any]) -> None:
        """Take a record, of a kind of `records.KINDS` with a value for each of its fields; takes microseconds.

        It is written by the next `step`, and committed as the settings say.
        """
        if kind.series == RAW and not self._settings.raw:
            return
        series = self._series[kind.series]
        try:
            record = self._encoders[kind.number](series.next_sequence % SEQUENCES, tuple(values))
        except (struct.error, TypeError, ValueError, OverflowError, AttributeError) as error:
            self._refuse(kind, error)
            return
        series.add(record, kind.urgent)

    def event(self, t: float, code: str, reason: str = "") -> None:
        """Write down that something happened: a short code, and the reason in words."""
        self.append(EVENT, (t, code, reason))

    def _refuse(self, kind: RecordKind, error: Exception) -> None:
        """A record that does not fit must not stop a vehicle; it is counted, and told once for its kind."""
        self.malformed += 1
        if kind.number not in self._told_malformed:
            self._told_malformed.add(kind.number)
            self.event(self._t, "log:malformed", f"a record {kind.name} was not taken: {error}")

    def step(self, t: float) -> None:
        """Write what was taken since the last step, the essential first; sync, begin new files and make room."""
        self._t = t
        self._listed = self._listed or self._list()
        if not self._listed:
            return
        self._look_at_clock(t)
        self._tell(t)
        retry = t >= self._retry_at or t < self._retry_at - self._settings.retry_s
        for importance, series in enumerate(self._series):
            if series.blocked_since is not None:
                if not retry:
                    continue
                self._make_room_for(importance)
            self._write(importance, series, t)
        if retry:
            self._retry_at = t + self._settings.retry_s

    def _write(self, importance: int, series: Series, t: float) -> None:
        if series.unwritten_bytes:
            self._keep_within(series.unwritten_bytes + _HEADER_BYTES)
        elif not series.file_name:
            return
        if not series.file_name:
            self._files += 1
        name = series.file_name or LogName(self.restarts, self._files, SERIES[importance], False).text
        before = series.blocked_since
        series.write(t, name, lambda: self._header(importance, series.first_kept, t))
        if series.file_name:
            self._sizes[name] = series.size
        self._tell_blocked(t, importance, before)
        if series.size >= self._settings.file_bytes:
            series.end_file(t)
        if series.failed_file:
            self._look_after(series.failed_file, series.failed_records)
            series.failed_file = ""

    def _header(self, importance: int, first: int, t: float) -> bytes:
        return header(self._identity, self.restarts, importance, first % SEQUENCES, self._read_clock(t))

    def _read_clock(self, t: float) -> ClockReading | None:
        return None if self._utc is None else ClockReading(t, self._utc(t))

    def _look_at_clock(self, t: float) -> None:
        """Begin new files when the clock was set: what is written from here on is dated by the new time."""
        before, now = self._clock, self._read_clock(t)
        if before is None or now is None or 0.0 <= t - before.t < CLOCK_EVERY:
            return
        self._clock = now
        if abs((now.utc - now.t) - (before.utc - before.t)) > CLOCK_STEP:
            for series in self._series:
                series.end_file(t)

    def _look_after(self, name: str, records: int) -> None:
        """A file that the disk refused to go on with stays for what is in it; without any record it only takes room."""
        with suppress(OSError):
            if records:
                self._sizes[name] = self.storage.sizes().get(name, 0)
                return
            self.storage.remove(name)
            self._sizes.pop(name, None)

    def sync(self, t: float) -> None:
        """Write and commit everything, and begin new files with the next record: before the vehicle sends or sleeps."""
        self.step(t)
        for series in self._series:
            series.end_file(t)

    @property
    def counts(self) -> dict[str, Counts]:
        """What became of the records, for each series."""
        return {name: series.counts for name, series in zip(SERIES, self._series, strict=True)}

    @property
    def blocked(self) -> str:
        """What the disk says that takes nothing now; empty while all is well."""
        return next((series.reason for series in self._series if series.blocked_since is not None), "")

    def finished(self) -> list[tuple[LogName, int]]:
        """Files that are written no more with their sizes [bytes], the oldest first: what can be sent ashore."""
        open_ones = {series.file_name for series in self._series}
        names = [(parsed, size) for name, size in self._sizes.items() if (parsed := log_name(name))]
        return sorted(pair for pair in names if pair[0].text not in open_ones)

    def mark_sent(self, name: LogName) -> bool:
        """Mark a finished file as sent ashore: such files make room first. False if there is none, or no disk."""
        if name.sent or name not in [finished for finished, _ in self.finished()]:
            return False
        sent = name._replace(sent=True).text
        try:
            self.storage.rename(name.text, sent)
        except OSError:
            return False
        self._sizes[sent] = self._sizes.pop(name.text)
        return True

    # making room

    def _keep_within(self, more: int) -> None:
        """Remove files until `more` bytes fit into the total."""
        excess = sum(self._sizes.values()) + more - self._settings.total_bytes
        while excess > 0:
            size = self._remove(self._victim(ESSENTIAL))
            if not size:
                return
            excess -= size

    def _make_room_for(self, importance: int) -> None:
        """The disk is full: one file goes that was sent ashore, or that matters less."""
        self._remove(self._victim(importance + 1))

    def _victim(self, least: int) -> LogName | None:
        """Next file to remove: of those sent the oldest, then of the least important series, down to `least`."""
        finished = [name for name, _ in self.finished()]
        sent = [name for name in finished if name.sent]
        if sent:
            return sent[0]
        for importance in (RAW, DETAIL, ESSENTIAL):
            names = [name for name in finished if name.series == SERIES[importance]]
            if names and importance >= least:
                return names[0]
        return None

    def _remove(self, name: LogName | None) -> int:
        """Remove a file; its size, 0 if it is still there."""
        if name is None:
            return 0
        try:
            self.storage.remove(name.text)
        except OSError:
            return 0
        size = self._sizes.pop(name.text)
        files, total, unsent = self.removed
        self.removed = Removed(files + 1, total + size, unsent + (not name.sent))
        return max(1, size)

    # nothing silently

    def _tell(self, t: float) -> None:
        """Write down what was removed and dropped since it was told last."""
        if self.removed != self._told_removed:
            files, total, unsent = (now - told for now, told in zip(self.removed, self._told_removed, strict=True))
            self._told_removed = self.removed
            self.event(t, "log:removed", f"{files} files with {total} bytes to make room, {unsent} of them not sent")
        for i, series in enumerate(self._series):
            dropped = series.counts.dropped
            if dropped > self._told_dropped[i] and series.blocked_since is None:
                self.event(t, "log:dropped", f"{dropped - self._told_dropped[i]} records of the series {SERIES[i]}")
                self._told_dropped[i] = dropped

    def _tell_blocked(self, t: float, importance: int, before: float | None) -> None:
        """Write down that the disk takes nothing any more, or takes records again."""
        series = self._series[importance]
        if before is None and series.blocked_since is not None:
            self.event(t, "log:blocked", f"series {SERIES[importance]}: {series.reason}")
        elif before is not None and series.blocked_since is None:
            self.event(t, "log:resumed", f"series {SERIES[importance]} after {t - before:.0f} s: {series.reason}")
