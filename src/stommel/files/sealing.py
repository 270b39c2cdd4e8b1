"""Small files that know when they are damaged: what the stores of vehicle and shore keep."""

import hashlib


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
