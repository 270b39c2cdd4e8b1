"""`glider.dbc`, the single source of what goes over the CAN bus."""

import hashlib
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from math import inf
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from cantools.database.can import Database, Message

COORDINATOR, MOTION, ACQUISITION, BENCH = 1, 2, 3, 4
NODES = {COORDINATOR: "Coordinator", MOTION: "Motion", ACQUISITION: "Acquisition", BENCH: "Bench"}
"""Nodes by their number, which is the low part of their identifiers."""


class Guard(NamedTuple):
    """How frames of a message are protected."""

    counted: bool
    """Whether an alive counter runs in it."""
    checked: bool
    """Whether its last byte is a checksum."""


def database_text() -> str:
    """Text of `glider.dbc`."""
    return files("stommel.messages").joinpath("glider.dbc").read_text(encoding="utf-8")


@cache
def database() -> "Database":
    """Return the messages of `glider.dbc`, as cantools holds them."""
    from cantools.database import load_string  # noqa: PLC0415 - takes a fifth of a second
    from cantools.database.can import Database  # noqa: PLC0415

    loaded = load_string(database_text(), "dbc", strict=True)
    assert isinstance(loaded, Database)
    return loaded


@cache
def database_hash() -> int:
    """First 24 bits of the SHA-256 of `glider.dbc`, by which nodes know each other's version."""
    return int.from_bytes(hashlib.sha256(database_text().encode()).digest()[:3], "big")


@cache
def message_named(name: str) -> "Message":
    """Return a message by its name.

    Raises
    ------
    KeyError
        There is none.
    """
    return database().get_message_by_name(name)


@cache
def message_of(identifier: int) -> "Message | None":
    """Return the message with an identifier; None if there is none."""
    try:
        return database().get_message_by_frame_id(identifier)
    except KeyError:
        return None


@cache
def guard_of(identifier: int) -> Guard:
    """How frames with an identifier are protected."""
    message = message_of(identifier)
    names = {signal.name for signal in message.signals} if message else set()
    return Guard("alive_counter" in names, "checksum" in names)


@cache
def sender_of(message: str) -> str:
    """Name of the node that sends a message.

    Raises
    ------
    KeyError
        There is no such message.
    """
    return message_named(message).senders[0]


@cache
def limits_of(identifier: int) -> tuple[tuple[str, float, float], ...]:
    """Signals whose bits can say more than is allowed, each with its lowest and its highest value.

    They are half a step wider than the file says, as what was rounded on its way is not refused.
    """
    message = message_of(identifier)
    found = []
    for signal in message.signals if message is not None else ():
        half, low, high = abs(signal.scale) / 2.0, signal.minimum, signal.maximum
        if low is not None and high is not None and (high - low) / signal.scale < (1 << signal.length) - 1.5:
            found.append((signal.name, low - half, high + half))
    return tuple(found)


@cache
def sayable(message: str) -> dict[str, tuple[float, float]]:
    """Lowest and highest value of each signal of a message; infinite where the file does not say.

    Raises
    ------
    KeyError
        There is no such message.
    """
    return {
        signal.name: (
            -inf if signal.minimum is None else float(signal.minimum),
            inf if signal.maximum is None else float(signal.maximum),
        )
        for signal in message_named(message).signals
    }


@cache
def words_of(message: str, signal: str) -> dict[int, str]:
    """Words of an enumeration by their numbers; none for a signal that is a number.

    Raises
    ------
    KeyError
        There is no such message or signal.
    """
    choices: Mapping[int, object] = message_named(message).get_signal_by_name(signal).choices or {}
    return {int(number): str(word) for number, word in choices.items()}


@cache
def value_named(message: str, signal: str, word: str) -> int:
    """Return the number that a word of an enumeration stands for.

    Raises
    ------
    KeyError
        The signal has no such word.
    """
    return {name: number for number, name in words_of(message, signal).items()}[word]


@cache
def word_of(message: str, signal: str, value: int) -> str:
    """Return the word for a value of an enumeration; the number itself where it has none."""
    return words_of(message, signal).get(value, str(value))
