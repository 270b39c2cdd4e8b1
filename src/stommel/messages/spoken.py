"""Frames as people and logs write them: `100#0102`, candump's lines, decoded words with units."""

import re
from collections.abc import Iterable, Iterator
from math import isfinite
from typing import NamedTuple

from stommel.errors import StommelError, one_line
from stommel.files.nearest import did_you_mean
from stommel.messages.codec import REASONS, Received, Rejected, UnsayableError, Values, known_message
from stommel.messages.database import message_named, message_of, words_of
from stommel.messages.frames import Frame
from stommel.messages.nodes import named_stranger

GUARDS = ("alive_counter", "checksum")
"""Signals that protect a frame and say nothing else."""
_FRAME = re.compile(r"([0-9A-Fa-f]{1,8})#([0-9A-Fa-f.]*)")
_LINE = re.compile(r"\s*\((\d+(?:\.\d+)?)\)\s+(\S+)\s+(\S+)(?:\s+[RT])?\s*")


class FrameTextError(StommelError):
    """Text that is no CAN frame."""


class LoggedFrame(NamedTuple):
    """A line of a candump log."""

    time: float
    """As the log says [s]."""
    interface: str
    frame: Frame


def frame_of(text: str) -> Frame:
    """Read `ID#DATA`, both hexadecimal, bytes with points between them or without.

    Raises
    ------
    FrameTextError
        It is something else, an extended or remote frame, or longer than 8 bytes.
    """
    form = f"{one_line(repr(text), 60)}: must be ID#DATA, hexadecimal, as 100#E803204E0000000C"
    found = _FRAME.fullmatch(text)
    if found is None or len(found[2].replace(".", "")) % 2:
        raise FrameTextError(form)
    identifier, data = int(found[1], 16), bytes.fromhex(found[2].replace(".", ""))
    if len(found[1]) > 3 or identifier > 0x7FF:
        raise FrameTextError(f"{text[:60]!r}: the identifier must be between 0 and 7FF")
    if len(data) > 8:
        raise FrameTextError(f"{one_line(repr(text), 60)}: {len(data)} bytes; at most 8 are allowed")
    return Frame(identifier, data)


def frame_text(frame: Frame) -> str:
    """A frame as candump writes it."""
    return f"{frame.identifier:03X}#{frame.data.hex().upper()}"


def log_line_of(line: str) -> LoggedFrame:
    """Read a line of a candump log, `(time) interface ID#DATA`.

    Raises
    ------
    FrameTextError
        It is something else.
    """
    found = _LINE.fullmatch(line)
    if found is None:
        raise FrameTextError(f"{one_line(repr(line.strip()), 60)}: must be (time) interface ID#DATA")
    return LoggedFrame(float(found[1]), found[2], frame_of(found[3]))


def log_of(lines: Iterable[str]) -> Iterator[LoggedFrame | str]:
    """Yield the frames of a candump log, and for each line that is none a sentence with its number."""
    for number, line in enumerate(lines, 1):
        if line.strip():
            try:
                yield log_line_of(line)
            except FrameTextError as error:
                yield f"line {number}: {error}"


def sentence(frame: Frame, answer: Received | Rejected) -> str:
    """What a frame says, on one line: words and numbers with units, or why it is not believed."""
    message = message_of(frame.identifier)
    if message is None:
        return f"{named_stranger(frame.identifier)}: {REASONS['unknown']} ({frame.data.hex(' ') or 'no data'})"
    if isinstance(answer, Rejected):
        return f"{message.name} rejected: {REASONS[answer.reason]} ({frame.data.hex(' ') or 'no data'})"
    words = []
    for signal in message.signals:
        if signal.name not in GUARDS:
            value = spoken(message.name, signal.name, answer.values[signal.name])
            shown = f"{value:.10g}" if isinstance(value, float) else value
            words.append(f"{signal.name} {shown} {signal.unit or ''}".rstrip())
    lost = f" ({answer.lost} lost before)" if answer.lost else ""
    return f"{message.name}: {', '.join(words)}{lost}"


def spoken(message: str, signal: str, value: float) -> str | float:
    """A value in the database's word, or the number; whole numbers without a point, others without rounding's tail."""
    words = words_of(message, signal)
    if words:
        return words.get(int(value), str(int(value)))
    return int(value) if float(value).is_integer() and message_step(message, signal) == 1 else float(f"{value:.10g}")


def message_step(message: str, signal: str) -> float:
    """Step of a signal, in its unit."""
    return float(message_named(message).get_signal_by_name(signal).scale)


def as_row(frame: Frame, answer: Received | Rejected) -> dict[str, object]:
    """What a frame says, as a table of JSON: signals by name, words where the database has them."""
    message = message_of(frame.identifier)
    row: dict[str, object] = {
        "identifier": frame.identifier,
        "data": frame.data.hex(),
        "message": message.name if message is not None else None,
        "rejected": answer.reason if isinstance(answer, Rejected) else None,
    }
    if message is None:
        row["named"] = named_stranger(frame.identifier)
    if isinstance(answer, Received):
        said = {name: value for name, value in answer.values.items() if name not in GUARDS}
        row["lost_before"] = answer.lost
        row["signals"] = {name: spoken(answer.name, name, value) for name, value in said.items()}
        row["units"] = {s.name: s.unit for s in message_named(answer.name).signals if s.name in said and s.unit}
    return row


def values_of(message: str, words: Iterable[str]) -> Values:
    """Read what a message shall say, as `signal=value`: numbers, or words of the database.

    Raises
    ------
    UnsayableError
        There is no such message, signal or word, a value is no number, or a signal is given twice or not at all.
    """
    known = {signal.name: signal for signal in known_message(message).signals if signal.name not in GUARDS}
    values: Values = {}
    for text in words:
        name, equals, value = text.partition("=")
        if not equals:
            raise UnsayableError(f"{one_line(repr(text), 60)}: must be signal=value; signals are {', '.join(known)}")
        if name not in known:
            near = did_you_mean(name, known)
            raise UnsayableError(f"{message}: unknown signal {one_line(name, 60)}{near} known: {', '.join(known)}")
        if name in values:
            raise UnsayableError(f"{message}: {name}: given twice")
        values[name] = _value(message, name, value)
    if missing := [name for name in known if name not in values]:
        raise UnsayableError(f"{message}: {', '.join(missing)}: not given")
    return values


def _value(message: str, signal: str, text: str) -> float:
    words = words_of(message, signal)
    for number, word in words.items():
        if word == text:
            return number
    shown = one_line(repr(text), 60)
    try:
        value = float(text)
    except ValueError:
        near = did_you_mean(text, words.values()).rstrip(";")
        allowed = f"one of {', '.join(words.values())}{near}" if words else "a number"
        raise UnsayableError(f"{message}: {signal} = {shown}: must be {allowed}") from None
    if not isfinite(value):
        raise UnsayableError(f"{message}: {signal} = {shown}: must be a number")
    if message_step(message, signal) == 1 and not value.is_integer():
        raise UnsayableError(f"{message}: {signal} = {shown}: must be a whole number")
    if words and value not in words:
        raise UnsayableError(f"{message}: {signal} = {shown}: must be one of {', '.join(words.values())}")
    return value
