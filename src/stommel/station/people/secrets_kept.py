"""Secrets of sessions and tokens: 256 random bits, of which the archive keeps a hash only."""

import hashlib
import secrets


def new_secret(prefix: str = "") -> str:
    """A secret that nobody guesses."""
    return prefix + secrets.token_urlsafe(32)


def fingerprint(secret: str) -> str:
    """What the archive keeps: SHA-256, in hex. A random secret needs no slow hash."""
    return hashlib.sha256(secret.encode("utf-8", "surrogatepass")).hexdigest()
