"""MAVLink 2 signatures: 48 bits of SHA-256 over key, frame, link and time stamp."""

import hashlib
import hmac

from stommel.link.frames import SIGNATURE

STAMP = 6
"""Bytes of a time stamp, and of the part of the hash."""


def signed(frame: bytes, secret: bytes, link: int, stamp: int) -> bytes:
    """Return a frame, whose flag says that it is signed, with its signature behind it."""
    body = frame + bytes((link,)) + stamp.to_bytes(STAMP, "little")
    return body + _hash(secret, body)


def holds(raw: bytes, secret: bytes) -> bool:
    """Whether the signature at the end of a signed frame was made with a key; takes the same time for every answer."""
    return hmac.compare_digest(_hash(secret, raw[:-STAMP]), raw[-STAMP:])


def link_and_stamp(raw: bytes) -> tuple[int, int]:
    """Return what a signed frame says of its link and time; nobody has checked it."""
    return raw[-SIGNATURE], int.from_bytes(raw[1 - SIGNATURE : -STAMP], "little")


def _hash(secret: bytes, body: bytes) -> bytes:
    return hashlib.sha256(secret + body).digest()[:STAMP]
