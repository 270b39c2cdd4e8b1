"""Fetches orders that a vehicle holds and nobody here has seen."""

import hashlib
from pathlib import Path
from typing import NamedTuple

from stommel.link.files.download import Download
from stommel.link.files.folder_disk import FolderDisk
from stommel.link.files.progress import State
from stommel.link.shore.shore_end import ShoreEnd

LOCAL = "active.orders"
ABOARD_PATH = "missions/active.orders"


class Fetched(NamedTuple):
    """What came."""

    sha256: bytes
    """Of what was wanted."""
    content: bytes
    reason: str
    """Why it is not what was wanted, in words; empty where it is."""


class MissionFetch:
    """One download at a time; what could not be fetched is not tried again.

    Parameters
    ----------
    folder
        Of the vehicle, where it comes to lie meanwhile.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._going: tuple[Download, FolderDisk, bytes] | None = None
        self._vain = b""

    def want(self, end: ShoreEnd, sha256: bytes) -> None:
        """Begin to fetch the orders aboard, which have this SHA-256."""
        if self._going is None and sha256 != self._vain:
            disk = FolderDisk(self._folder)
            self._going = end.download(ABOARD_PATH, disk, LOCAL), disk, sha256

    def look(self) -> Fetched | None:
        """What came, again and again until `done`; None while it is on its way, or nothing is."""
        if self._going is None or not self._going[0].state.is_over:
            return None
        download, _, sha256 = self._going
        content = self._content(download)
        if hashlib.sha256(content).digest() == sha256:
            return Fetched(sha256, content, "")
        self._vain = sha256
        return Fetched(sha256, content, download.reason or "they have changed meanwhile")

    def done(self, end: ShoreEnd) -> None:
        """Give back what was used: what came is kept elsewhere."""
        if self._going is None:
            return
        download, disk, _ = self._going
        self._going = None
        end.drop(download)
        for left in disk.sizes():
            disk.remove(left)
        disk.close()

    def _content(self, download: Download) -> bytes:
        """What was fetched; nothing if it did not come whole."""
        name = (download.file.kept_as if download.file is not None else None) or LOCAL
        try:
            return (self._folder / name).read_bytes() if download.state is State.WHOLE else b""
        except OSError:
            return b""
