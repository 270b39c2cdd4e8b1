"""A file that is being received: a part, and a journal of what has come, so that no byte is asked for twice.

The part `NAME.part` has the bytes at their places. The journal `NAME.part.ranges` begins with what the file shall
be, and has a record for every stretch of bytes that came: first byte, number of bytes, CRC-32 of the bytes, CRC-32 of
the record. Whoever goes on reads the journal up to its first damaged record and believes only what the part has with
the right sum: a loss of power may have kept either without the other. The file gets its name when its SHA-256 is right.
"""

import hashlib
import json
import struct
import zlib
from collections.abc import Iterator
from contextlib import suppress
from typing import NamedTuple

from stommel.errors import StommelError
from stommel.link.files.disk import Disk
from stommel.link.files.ranges import Ranges

SYNC_BYTES = 1 << 14
"""What a loss of power may take."""
SYNC_AFTER = 0.5
"""Silence after which everything is brought to the disk [s]."""
MOST_SIZE = 0xFFFFFFFE
_RECORD = struct.Struct("<IIII")
_CHUNK = 1 << 20
_MOST_HEAD = 4096
_LONGEST = 1 << 16
"""Bytes that one record vouches for: what a damaged sector takes with it."""


class ReceivedFileError(StommelError):
    """A file cannot be received, kept or finished; what has come is kept."""


class DiskFailedError(ReceivedFileError):
    """The disk does not take or give bytes now; what has come goes on when it does again."""


class WrongSumError(ReceivedFileError):
    """All bytes have come, and they are not the file: all have to come again."""


class Identity(NamedTuple):
    """Which file it is."""

    path: str
    """Where it stands at the other end."""
    size: int
    sha256: str


class ReceivedFile:
    """One file on its way.

    Parameters
    ----------
    disk
        Where it comes to stand.
    name
        Its name there.
    identity
        What it shall be.
    """

    def __init__(self, disk: Disk, name: str, identity: Identity) -> None:
        if not 0 <= identity.size <= MOST_SIZE:
            raise ReceivedFileError(f"{name}: size = {identity.size}: must be between 0 and {MOST_SIZE} bytes")
        self._disk, self.name, self.identity = disk, name, identity
        self._part, self._journal = f"{name}.part", f"{name}.part.ranges"
        self.received = Ranges()
        self.damaged_bytes = 0
        """Bytes that the journal has and the part has not, found when it was opened."""
        self.kept_as: str | None = None
        """Name of the file, once it is whole."""
        self._end = 0
        self._unsynced, self._written_at = 0, 0.0
        try:
            self._open()
        except OSError as error:
            raise self._disk_error(error) from error

    @property
    def missing(self) -> Ranges:
        """What has not come."""
        return self.received.missing(self.identity.size)

    def write(self, offset: int, data: bytes, t: float) -> None:
        """Keep bytes that have come at a time [s].

        Raises
        ------
        ReceivedFileError
            The disk does not take them; what has come before is kept.
        """
        try:
            self._disk.write(self._part, offset, data)
            self._note(offset, len(data), zlib.crc32(data))
            self._unsynced += len(data)
            self._written_at = t
            if self._unsynced >= SYNC_BYTES:
                self._sync()
        except OSError as error:
            raise self._disk_error(error) from error
        self.received.add(offset, offset + len(data))

    def rest(self, t: float) -> None:
        """Bring to the disk what has come, once nothing comes for a while."""
        if self._unsynced and t - self._written_at >= SYNC_AFTER:
            self.close()

    def close(self) -> None:
        """Bring everything to the disk; a later one goes on from here."""
        try:
            if self._unsynced:
                self._sync()
        except OSError as error:
            raise self._disk_error(error) from error

    def finish(self) -> str:
        """Give the file its name, and return it: the one that was wanted, unless another file has it.

        Raises
        ------
        WrongSumError
            It is not the file; everything is missing again.
        ReceivedFileError
            The disk fails, or bytes are missing.
        """
        if self.missing:
            raise ReceivedFileError(f"{self.name}: {self.missing.bytes} of {self.identity.size} bytes are missing")
        if self.kept_as is not None:
            return self.kept_as
        try:
            self._disk.sync(self._part)
            if (found := self._sum(self._part)) != self.identity.sha256:
                self._begin()
                told = f"{self.identity.sha256[:12]}... was announced"
                raise WrongSumError(f"{self.name}: sha256 = {found[:12]}...: {told}; everything comes again")
            kept_as = self._free_name()
            self._disk.rename(self._part, kept_as)
            self._disk.remove(self._journal)
        except OSError as error:
            raise self._disk_error(error) from error
        self.kept_as = kept_as
        return kept_as

    def discard(self) -> None:
        """Forget what has come."""
        for name in (self._journal, self._part):
            with suppress(OSError):
                self._disk.remove(name)

    # the disk

    def _open(self) -> None:
        sizes = self._disk.sizes()
        if sizes.get(self.name) == self.identity.size and self._sum(self.name) == self.identity.sha256:
            self.received.add(0, self.identity.size)
            self.kept_as = self.name
            self.discard()
            return
        if self._journal not in sizes or self._part not in sizes or not self._go_on(sizes[self._journal]):
            self._begin()

    def _begin(self) -> None:
        """An empty part and a journal without records."""
        self.received = Ranges()
        for name in (self._journal, self._part):
            if name in self._disk.sizes():
                self._disk.remove(name)
        self._disk.write(self._part, 0, b"")
        self._rewrite(())

    def _go_on(self, size: int) -> bool:
        """Take what the journal has and the part bears out; False if it is about another file."""
        journal = self._disk.read(self._journal, 0, size)
        head, _, records = journal.partition(b"\n")
        if head != _head(self.identity):
            return False
        sound = [(first, length) for first, length, crc in _records(records) if self._is_sound(first, length, crc)]
        for first, length in sound:
            self.received.add(first, first + length)
        self._rewrite(self.received)
        return True

    def _is_sound(self, first: int, length: int, crc: int) -> bool:
        if first + length > self.identity.size:
            return False
        is_sound = zlib.crc32(self._disk.read(self._part, first, length)) == crc
        self.damaged_bytes += 0 if is_sound else length
        return is_sound

    def _rewrite(self, ranges: Ranges | tuple[()]) -> None:
        """Write the journal anew, as short as it can be; the old one stands until the new one is on the disk."""
        new = f"{self._journal}.new"
        if new in self._disk.sizes():
            self._disk.remove(new)
        content = bytearray(_head(self.identity) + b"\n")
        for each in ranges:
            for first in range(each.first, each.last, _LONGEST):
                data = self._disk.read(self._part, first, min(_LONGEST, each.last - first))
                content += _record(first, len(data), zlib.crc32(data))
        self._disk.sync(self._part)
        self._disk.write(new, 0, bytes(content))
        self._disk.sync(new)
        self._disk.rename(new, self._journal)
        self._end = len(content)
        self._unsynced = 0

    def _note(self, first: int, length: int, crc: int) -> None:
        record = _record(first, length, crc)
        self._disk.write(self._journal, self._end, record)
        self._end += len(record)

    def _sync(self) -> None:
        self._disk.sync(self._part)
        self._disk.sync(self._journal)
        self._unsynced = 0

    def _sum(self, name: str) -> str:
        found = hashlib.sha256()
        for first in range(0, self.identity.size, _CHUNK):
            found.update(self._disk.read(name, first, min(_CHUNK, self.identity.size - first)))
        return found.hexdigest()

    def _free_name(self) -> str:
        """The name, unless another file has it that this one is not the continuation of."""
        there = self._disk.sizes().get(self.name)
        if there is None or (there <= self.identity.size and self._continues(there)):
            return self.name
        stem, dot, suffix = self.name.rpartition(".")
        return f"{stem}-{self.identity.sha256[:8]}{dot}{suffix}" if dot else f"{self.name}-{self.identity.sha256[:8]}"

    def _continues(self, there: int) -> bool:
        """Whether the part begins with the file that has the name: a log that has grown since."""
        for first in range(0, there, _CHUNK):
            length = min(_CHUNK, there - first)
            if self._disk.read(self.name, first, length) != self._disk.read(self._part, first, length):
                return False
        return True

    def _disk_error(self, error: OSError) -> ReceivedFileError:
        reason = error.strerror or str(error)
        kept = f"{self.received.bytes} of {self.identity.size} bytes are kept in {self._part}"
        return DiskFailedError(f"{self.name}: {reason}; {kept}")


def identity_on_disk(disk: Disk, name: str) -> Identity | None:
    """What a part of this name was begun for; None if there is none that can go on.

    Raises
    ------
    DiskFailedError
        The disk cannot be read.
    """
    try:
        head, newline, _ = disk.read(f"{name}.part.ranges", 0, _MOST_HEAD).partition(b"\n")
        identity = Identity(**json.loads(head[9:]))
    except FileNotFoundError:
        return None
    except OSError as error:
        raise DiskFailedError(f"{name}.part.ranges: {error.strerror or error}") from error
    except (ValueError, TypeError):
        return None
    return identity if newline and head == _head(identity) else None


def _head(identity: Identity) -> bytes:
    told = json.dumps(identity._asdict(), sort_keys=True)
    return f"{zlib.crc32(told.encode()):08x} {told}".encode()[:_MOST_HEAD]


def _record(first: int, length: int, crc: int) -> bytes:
    body = struct.pack("<III", first, length, crc)
    return body + zlib.crc32(body).to_bytes(4, "little")


def _records(content: bytes) -> Iterator[tuple[int, int, int]]:
    """Records up to the first that is damaged."""
    for at in range(0, len(content) - _RECORD.size + 1, _RECORD.size):
        first, length, crc, own = _RECORD.unpack_from(content, at)
        if zlib.crc32(content[at : at + _RECORD.size - 4]) != own:
            return
        yield first, length, crc
