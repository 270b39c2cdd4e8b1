"""SHA-256 of files aboard, a piece at a time, so that nothing else waits for a long file."""

import hashlib
from collections.abc import Callable

from stommel.link.files.paths import shown
from stommel.link.files.port import FilePort, FileRefusalError, FtpError, Path

PIECE = 1 << 18
"""Bytes that are read at once."""
MOST_JOBS = 8


class _Job:
    def __init__(self, path: Path, size: int, done: Callable[[bytes | FileRefusalError], None]) -> None:
        self.path, self.size, self.done = path, size, done
        self.at = 0
        self.sum = hashlib.sha256()


class Digests:
    """Sums that are being made, one after the other."""

    def __init__(self, port: FilePort) -> None:
        self._port = port
        self._jobs: dict[object, _Job] = {}

    def __contains__(self, key: object) -> bool:
        return key in self._jobs

    def begin(self, key: object, path: Path, size: int, done: Callable[[bytes | FileRefusalError], None]) -> None:
        """Sum the first bytes of a file; `done` gets the digest, or why there is none.

        Raises
        ------
        FileRefusalError
            Too many are being made.
        """
        if key not in self._jobs and len(self._jobs) >= MOST_JOBS:
            raise FileRefusalError(FtpError.NO_SESSIONS_AVAILABLE, f"{MOST_JOBS} files are being summed already")
        self._jobs[key] = _Job(path, size, done)

    def work(self) -> None:
        """Read one piece."""
        if not self._jobs:
            return
        key, job = next(iter(self._jobs.items()))
        try:
            data = self._port.read(job.path, job.at, min(PIECE, job.size - job.at)) if job.at < job.size else b""
            if not data and job.at < job.size:
                raise FileRefusalError(FtpError.END_OF_FILE, f"{shown(job.path)}: ends at {job.at} of {job.size} bytes")  # noqa: TRY301
        except FileRefusalError as error:
            del self._jobs[key]
            job.done(error)
            return
        job.sum.update(data)
        job.at += len(data)
        if job.at >= job.size:
            del self._jobs[key]
            job.done(job.sum.digest())
