"""The folders that a vehicle's software writes in: one program at a time has them."""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from stommel.errors import FileError, Problem
from stommel.files.folder_lock import FolderInUseError, locked
from stommel.files.folder_storage import FolderStorage
from stommel.link.files.folder_disk import FolderDisk
from stommel.onboard.coordination.config import Configuration

INBOX = "inbox"
FOLDERS = ("missions", "parameters", "log.folder", INBOX)
"""Keys of the configuration that name one."""


def inbox_of(configuration: Configuration) -> FolderDisk:
    """Return the folder of received files, made if it is not there.

    Raises
    ------
    FileError
        It cannot be.
    """
    try:
        return FolderDisk(_path(configuration, INBOX))
    except OSError as error:
        raise _refused(configuration, INBOX, f"cannot be used: {error.strerror or error}") from None


def bench_storage(configuration: Configuration) -> FolderStorage:
    """Return the folder of what the link of the bench keeps, apart from that of the radio.

    Raises
    ------
    FileError
        It cannot be.
    """
    return _storage(configuration, "parameters", "bench")


def storage_of(configuration: Configuration, key: str) -> FolderStorage:
    """Return the folder that a key names, made if it is not there.

    Raises
    ------
    FileError
        It cannot be.
    """
    return _storage(configuration, key)


def _storage(configuration: Configuration, key: str, inside: str = "") -> FolderStorage:
    try:
        return FolderStorage(_path(configuration, key) / inside)
    except OSError as error:
        raise _refused(configuration, key, f"cannot be used: {error.strerror or error}") from None


@contextmanager
def claimed(configuration: Configuration) -> Iterator[None]:
    """Keep other programs out of all folders; a process that dies gives them back.

    Raises
    ------
    FileError
        Another program has one, or one cannot be made.
    """
    by_path: dict[Path, str] = {}
    for key in FOLDERS:
        first = by_path.setdefault(_path(configuration, key).resolve(), key)
        if key == INBOX and first != INBOX:
            raise _refused(configuration, key, f"is the folder of {first} too; received files need one of their own")
    with ExitStack() as held:
        for key in by_path.values():
            storage_of(configuration, key)
            _lock(configuration, key, held)
        yield


def _lock(configuration: Configuration, key: str, held: ExitStack) -> None:
    try:
        held.enter_context(locked(_path(configuration, key)))
    except FolderInUseError:
        raise _refused(configuration, key, "another `stommel vehicle run` is writing there") from None


def _path(configuration: Configuration, key: str) -> Path:
    file = configuration.file
    return configuration.path(file.log.folder if key == "log.folder" else getattr(file, key))


def _refused(configuration: Configuration, key: str, why: str) -> FileError:
    name = configuration.file.log.folder if key == "log.folder" else getattr(configuration.file, key)
    return FileError([Problem(configuration.origin, key, f"{key} = {name!r}: {why}")])
