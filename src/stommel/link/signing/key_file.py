"""The key file of a vehicle: a few lines of text that only its owner may read, and that tell when they are damaged."""

import hashlib
import re
import secrets
import stat
import sys
from datetime import UTC, datetime
from pathlib import Path

from stommel.errors import FileError, Problem, StommelError
from stommel.files.opening import read_text, require_regular
from stommel.files.whole import write_private
from stommel.link.signing.keys import FIRST_MADE, LAST_MADE, SIZE, Key, Keys

PRIVATE = 0o600
_HEAD = "stommel link key 1"
_TIME = "%Y-%m-%dT%H:%M:%SZ"
_MOST_MIB = 1
_MOST_VEHICLE = 250
"""Systems above are ground stations."""


class ClockError(StommelError):
    """The wall clock cannot be right."""


class KeyFile:
    """Keys in a file; a link to one is followed."""

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)

    def read(self) -> Keys:
        """Return the keys.

        Raises
        ------
        FileError
            There is no file, others may read it, or it is damaged; the message says which.
        """
        require_regular(self.path)
        mode = self.mode
        if mode & ~PRIVATE and sys.platform != "win32":
            raise self._error("mode", f"others may read it: its mode is {mode:04o}; 0600 is allowed (chmod 600)")
        return self.read_of_any_mode()

    def read_of_any_mode(self) -> Keys:
        """Return the keys, also where others may read the file; else as `read`."""
        return self._parsed(read_text(self.path, _MOST_MIB))

    @property
    def mode(self) -> int:
        """Who may read it, as chmod has it."""
        return stat.S_IMODE(self.path.stat().st_mode)

    def write(self, keys: Keys) -> None:
        """Write the keys: whole, readable by their owner alone, and on the disk; or not at all.

        Raises
        ------
        OutputError
            The file cannot be written; what stood there before still does.
        """
        write_private(self.path.resolve(), _text(keys))

    def _parsed(self, text: str) -> Keys:
        body, _, seal = text.rpartition("sha256 = ")
        if not text.startswith(f"{_HEAD}\n"):
            raise self._error("", f"is no key file: its first line must be {_HEAD!r}")
        if seal != f"{_digest(body)}\n":
            raise self._error("sha256", "is damaged: its SHA-256 is another")
        entries = dict(line.partition(" = ")[::2] for line in body.splitlines()[1:])
        try:
            return Keys(
                _whole(entries["vehicle"], 1, _MOST_VEHICLE),
                _whole(str(_seconds(entries["made"])), FIRST_MADE, LAST_MADE),
                _key(entries["key"]),
                _key(entries["next"]) if "next" in entries else None,
                entries.get("unused") == "yes",
            )
        except (KeyError, ValueError) as error:
            raise self._error("", f"cannot be used: {error}") from None

    def _error(self, key: str, why: str) -> FileError:
        return FileError([Problem(str(self.path), key, why)])


def new_keys(vehicle: int, now: float) -> Keys:
    """Make a key for a vehicle at a UTC time [s since 1970].

    Raises
    ------
    ClockError
        The clock is wrong, and a key is dated by it.
    """
    if not FIRST_MADE <= now <= LAST_MADE:
        raise ClockError("the clock of this computer is not between 2025 and 2075; set it, for a key is dated by it")
    return Keys(vehicle, int(now), Key(secrets.token_bytes(SIZE)), unused=True)


def made_text(keys: Keys) -> str:
    """When a key was made."""
    return datetime.fromtimestamp(keys.made, UTC).strftime(_TIME)


def _text(keys: Keys) -> str:
    lines = [_HEAD, f"vehicle = {keys.vehicle}", f"made = {made_text(keys)}", f"key = {keys.current.secret.hex()}"]
    if keys.next is not None:
        lines.append(f"next = {keys.next.secret.hex()}")
    if keys.unused:
        lines.append("unused = yes")
    body = "\n".join(lines) + "\n"
    return f"{body}sha256 = {_digest(body)}\n"


def _digest(body: str) -> str:
    return hashlib.sha256(body.encode()).hexdigest()


def _key(text: str) -> Key:
    if not re.fullmatch(f"[0-9a-f]{{{2 * SIZE}}}", text):
        raise ValueError(f"a key has {2 * SIZE} hexadecimal digits")
    return Key(bytes.fromhex(text))


def _seconds(text: str) -> int:
    return int(datetime.strptime(text, _TIME).replace(tzinfo=UTC).timestamp())


def _whole(text: str, least: int, most: int) -> int:
    if not text.isascii() or not text.isdigit() or not least <= int(text) <= most:
        raise ValueError(f"{text!r} is not between {least} and {most}")
    return int(text)
