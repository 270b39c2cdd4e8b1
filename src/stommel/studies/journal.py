"""The journal of a study: a folder with one small file for every finished run, so that none is lost or repeated."""

import fcntl
import json
import shutil
from collections.abc import Mapping
from pathlib import Path
from types import TracebackType
from typing import IO, Any, Self

from stommel.errors import FileError, OutputError
from stommel.files.opening import TABLE_MIB, read_text
from stommel.files.whole import write_whole
from stommel.studies.errors import StudyError

_HEAD = "study.json"
_LOCK = "lock"
_FOLDER = 1000
"""Runs in one folder."""


class Journal:
    """Finished runs on disk; use it as a context, which keeps a second study out."""

    def __init__(self, folder: Path, fingerprint: Mapping[str, str], *, restart: bool = False) -> None:
        self.folder = folder
        self._fingerprint = dict(fingerprint)
        self._restart = restart
        self._lock: IO[str] | None = None

    def __enter__(self) -> Self:
        """Open the folder.

        Raises
        ------
        StudyError
            Another study runs there, or the folder belongs to another study.
        OutputError
            The folder cannot be written.
        """
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            self._lock = (self.folder / _LOCK).open("w", encoding="utf-8")
        except OSError as error:
            raise OutputError(f"{self.folder}: cannot be written: {error.strerror or error}") from error
        try:
            fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            self._lock.close()
            raise StudyError(f"{self.folder}: another `stommel study` is writing here") from None
        try:
            self._open()
        except BaseException:
            self._lock.close()
            raise
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._lock is not None:
            self._lock.close()

    def _open(self) -> None:
        if self._restart:
            for old in self.folder.glob("[0-9]*"):
                shutil.rmtree(old)
            (self.folder / _HEAD).unlink(missing_ok=True)
        head = self.folder / _HEAD
        if head.exists():
            kept = _read(head)
            changed = [part for part, value in self._fingerprint.items() if kept.get(part) != value]
            if changed:
                raise StudyError(
                    f"{self.folder}: holds runs of a study that differs in: {', '.join(changed)}; give another "
                    "--output, or --restart to fly all runs anew"
                )
        else:
            write_whole(head, json.dumps(self._fingerprint, indent=1) + "\n")

    def finished(self) -> dict[int, dict[str, Any]]:
        """Runs that are finished, by number."""
        return {int(path.stem): _read(path) for path in sorted(self.folder.glob("[0-9]*/[0-9]*.json"))}

    def keep(self, record: Mapping[str, Any]) -> None:
        """Write one finished run, whole or not at all."""
        run = int(record["run"])
        write_whole(self.folder / f"{run // _FOLDER:04d}" / f"{run:07d}.json", json.dumps(record) + "\n")


def _read(path: Path) -> dict[str, Any]:
    try:
        found: dict[str, Any] = json.loads(read_text(path, TABLE_MIB))
    except FileError as error:
        raise StudyError(f"{error}; delete it to fly that run again") from None
    except ValueError as error:
        raise StudyError(f"{path}: cannot be read: {error}; delete it to fly that run again") from error
    return found
