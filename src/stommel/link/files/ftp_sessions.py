"""Open files of ordinary ground stations: few, and none for ever."""

from collections.abc import Iterator
from typing import NamedTuple

from stommel.link.files.ftp_words import Words
from stommel.link.files.port import FileRefusalError, FtpError, Path, Staged

MOST_SESSIONS = 8
IDLE = 60.0
"""A session that says nothing for so long is closed [s]."""
Peer = tuple[int, int]
"""System and component."""


class Burst(NamedTuple):
    """What a burst sends next; nothing else moves it."""

    sequence: int
    offset: int
    size: int
    """Bytes of a piece."""
    left: int
    """Pieces."""


class OpenFile:
    """A file that a ground station has open."""

    def __init__(self, path: Path, size: int, staged: Staged | None) -> None:
        self.path, self.size, self.staged = path, size, staged
        self.burst: Burst | None = None
        self.used = 0.0


class FtpSessions:
    """Open files by ground station and number."""

    def __init__(self) -> None:
        self._open: dict[tuple[Peer, int], OpenFile] = {}

    def __iter__(self) -> Iterator[tuple[tuple[Peer, int], OpenFile]]:
        return iter(tuple(self._open.items()))

    def __len__(self) -> int:
        return len(self._open)

    def begin(self, peer: Peer, wanted: int, file: OpenFile, t: float) -> int:
        """Open a session under the number that the ground station proposes, or another one, and return it."""
        if len(self._open) >= MOST_SESSIONS:
            raise FileRefusalError(FtpError.NO_SESSIONS_AVAILABLE, f"at most {MOST_SESSIONS} sessions are open at once")
        number = next(n % 256 for n in range(wanted, wanted + 256) if (peer, n % 256) not in self._open)
        file.used = t
        self._open[peer, number] = file
        return number

    def of(self, peer: Peer, question: Words, t: float) -> OpenFile:
        """The open file of a question."""
        file = self._open.get((peer, question.session))
        if file is None:
            raise FileRefusalError(FtpError.INVALID_SESSION, f"session {question.session} is not open")
        file.used = t
        return file

    def end(self, peer: Peer, number: int) -> None:
        """Close a session; a file that was written comes into being."""
        file = self._open.pop((peer, number), None)
        if file is None:
            raise FileRefusalError(FtpError.INVALID_SESSION, f"session {number} is not open")
        if file.staged is not None:
            file.staged.commit()

    def forget(self, peer: Peer | None, until: float) -> None:
        """Close what was not used since a time, of one ground station or all; half a file is thrown away."""
        for (owner, number), file in tuple(self._open.items()):
            if (peer is None or owner == peer) and file.used <= until:
                if file.staged is not None:
                    file.staged.discard()
                del self._open[owner, number]
