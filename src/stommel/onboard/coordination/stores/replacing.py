"""Small files that are replaced as a whole, and know when they are damaged: what every store of the vehicle does."""

import hashlib

from stommel.onboard.coordination.stores.storage import Storage


def replace_whole(storage: Storage, name: str, content: bytes, part: str) -> None:
    """Bring a file into being under its name: whole, on the disk, or not at all; it grows under the name `part`.

    Raises
    ------
    OSError
        The disk does not keep it; what stood under the name still does.
    """
    if part in storage.sizes():
        storage.remove(part)
    file = storage.create(part)
    try:
        file.write(content)
        file.sync()
    finally:
        file.close()
    storage.rename(part, name)


def sealed(told: str) -> bytes:
    """A text with its SHA-256 before it."""
    content = told.encode()
    return f"{_digest(content)} ".encode() + content


def unsealed(content: bytes) -> bytes | None:
    """Return the text of sealed bytes; None if its SHA-256 is another."""
    digest, _, told = content.partition(b" ")
    return told if digest.decode("ascii", "replace") == _digest(told) else None


def _digest(told: bytes) -> str:
    return hashlib.sha256(told).hexdigest()
