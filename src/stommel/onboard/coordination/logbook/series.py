"""One series of files of the log: records wait in memory, are written once a step, and are committed by a sync."""

from collections import deque
from collections.abc import Callable
from contextlib import suppress
from typing import NamedTuple

from stommel.files.storage import OpenFile, Storage


class SyncPolicy(NamedTuple):
    """When written records are brought to the disk: whichever comes first."""

    records: int
    """So many are not yet there."""
    seconds: float
    """The first of them has waited so long [s]."""


class Counts(NamedTuple):
    """What became of the records of a series."""

    taken: int
    """Given to the log since its start."""
    committed: int
    """Brought to the disk."""
    dropped: int
    """Given up, since the disk took nothing and memory is bounded."""
    failures: int
    """Times that the disk refused."""


class Series:
    """One series of files; the newest is being written.

    Records keep their place in memory until a sync has returned, so that after a failure of the disk all of them go
    into the next file. What stands in the failed file as well has the same sequence numbers.
    """

    def __init__(self, storage: Storage, policy: SyncPolicy, memory_bytes: int) -> None:
        self.file_name = ""
        """Of the file that is being written; empty if there is none."""
        self.size = 0
        """Of this file [bytes]."""
        self.next_sequence = 0
        self.blocked_since: float | None = None
        """Since when the disk takes nothing [s]."""
        self.reason = ""
        """What the disk said last."""
        self.failed_file = ""
        """Name of a file that the disk has just refused to go on with."""
        self.failed_records = 0
        """Whole records in it."""
        self._storage = storage
        self._policy = policy
        self._memory_bytes = memory_bytes
        self._file: OpenFile | None = None
        self._kept: deque[bytes] = deque()
        self._kept_bytes = 0
        self._written = 0
        """Records of `_kept` that are in the file and wait for a sync."""
        self._written_bytes = 0
        self._in_file = 0
        self._waiting_since: float | None = None
        self._urgent = False
        self._dropped = self._failures = 0

    @property
    def counts(self) -> Counts:
        """What became of the records."""
        committed = self.next_sequence - self._dropped - len(self._kept)
        return Counts(self.next_sequence, committed, self._dropped, self._failures)

    @property
    def first_kept(self) -> int:
        """Sequence number of the first record that is not committed."""
        return self.next_sequence - len(self._kept)

    @property
    def unwritten_bytes(self) -> int:
        """What the next step writes [bytes]."""
        return self._kept_bytes - self._written_bytes

    def add(self, record: bytes, urgent: bool) -> None:
        """Take a record with the number `next_sequence`; of too many, the oldest are given up."""
        self.next_sequence += 1
        self._kept.append(record)
        self._kept_bytes += len(record)
        self._urgent |= urgent
        if self._kept_bytes > self._memory_bytes // 2:
            self._urgent = True
            self._drop()

    def _drop(self) -> None:
        """Give up the oldest records."""
        while self._kept_bytes > self._memory_bytes:
            record = self._kept.popleft()
            self._kept_bytes -= len(record)
            self._dropped += 1
            if self._written:
                self._written -= 1
                self._written_bytes -= len(record)

    def write(self, t: float, name: str, header: Callable[[], bytes]) -> None:
        """Write what waits, and sync as the policy says; a failure is counted and the next file tried later.

        Parameters
        ----------
        t
            Time [s].
        name
            Of the file to begin where none is open.
        header
            Its first bytes.
        """
        if len(self._kept) == self._written and not self._is_due(t):
            return
        try:
            if self._file is None:
                self._begin(name, header)
            self._write_kept(t)
            if self._is_due(t):
                self._sync()
        except OSError as error:
            self._failed(t, error)
        else:
            self.blocked_since = None

    def _begin(self, name: str, header: Callable[[], bytes]) -> None:
        self._file, self.file_name, self.size, self._in_file = self._storage.create(name), name, 0, 0
        first = header()
        self._file.write(first)
        self.size = len(first)

    def _write_kept(self, t: float) -> None:
        assert self._file is not None
        fresh = len(self._kept) - self._written
        if not fresh:
            return
        # from the end: those before are written already
        records = [self._kept[i] for i in range(-fresh, 0)]
        data = b"".join(records)
        self._file.write(data)
        self.size += len(data)
        self._in_file += fresh
        self._written, self._written_bytes = len(self._kept), self._kept_bytes
        if self._waiting_since is None:
            self._waiting_since = t

    def _is_due(self, t: float) -> bool:
        if not self._written:
            return False
        since = t if self._waiting_since is None else self._waiting_since
        # a clock that was set back has waited, too
        return self._urgent or self._written >= self._policy.records or not 0.0 <= t - since < self._policy.seconds

    def _sync(self) -> None:
        if self._file is None or not self._written:
            return
        self._file.sync()
        if self._written == len(self._kept):
            self._kept.clear()
        else:
            for _ in range(self._written):
                self._kept.popleft()
        self._kept_bytes -= self._written_bytes
        self._written = self._written_bytes = 0
        self._waiting_since, self._urgent = None, False

    def _failed(self, t: float, error: OSError) -> None:
        """Leave the file as it is; nothing that is committed in it is touched again."""
        self._failures += 1
        self.reason = error.strerror or str(error)
        if self.blocked_since is None:
            self.blocked_since = t
        self._written = self._written_bytes = 0
        self._waiting_since = None
        self.failed_file, self.failed_records = self.file_name, self._in_file
        self._leave()

    def _leave(self) -> None:
        if self._file is not None:
            with suppress(OSError):
                self._file.close()
        self._file, self.file_name, self.size = None, "", 0

    def end_file(self, t: float) -> None:
        """Sync and close the file; the next record begins another."""
        try:
            self._sync()
        except OSError as error:
            self._failed(t, error)
        else:
            self._leave()
