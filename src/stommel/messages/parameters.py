"""Typed parameters of a node: asked and written over the bus, kept in two copies with checksums."""

import struct
import zlib
from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum
from math import isfinite
from typing import NamedTuple, Protocol

from stommel.errors import StommelError
from stommel.messages.codec import Encoder, Received
from stommel.messages.database import NODES, value_named, word_of
from stommel.messages.frames import Frame

Value = float | int | bool


class ParameterType(IntEnum):
    """Types of parameters, by the numbers that `ReadType` answers."""

    float32 = 0
    int32 = 1
    bool = 2


class ParameterError(StommelError):
    """A parameter that cannot be as it is described."""


class Parameter(NamedTuple):
    """What can be set of a node."""

    number: int
    """0 to 255."""
    name: str
    type: ParameterType
    default: Value
    low: Value
    high: Value
    unit: str = ""
    words: str = ""
    """What it means to people."""

    def allows(self, value: Value) -> bool:
        """Whether a value lies within the limits; no number does not."""
        return bool(self.low <= value <= self.high)


def to_bits(kind: ParameterType, value: Value) -> int:
    """32 bits of a value, as a frame and a store hold it."""
    form = "<f" if kind is ParameterType.float32 else "<i"
    return int.from_bytes(struct.pack(form, value if kind is ParameterType.float32 else int(value)), "little")


def from_bits(kind: ParameterType, bits: int) -> Value:
    """Value of 32 bits."""
    raw = bits.to_bytes(4, "little")
    if kind is ParameterType.float32:
        return float(struct.unpack("<f", raw)[0])
    whole = int(struct.unpack("<i", raw)[0])
    # a truth that is neither 0 nor 1 is kept as it is, and refused by its limits
    return bool(whole) if kind is ParameterType.bool and whole in (0, 1) else whole


def _checked(parameters: Sequence[Parameter]) -> dict[int, Parameter]:
    """Parameters by number, their numbers as 32 bits hold them.

    Raises
    ------
    ParameterError
        Two have one number, or a default is beyond its limits or its type.
    """
    found: dict[int, Parameter] = {}
    for p in parameters:
        if not 0 <= p.number <= 0xFF or p.number in found:
            raise ParameterError(f"parameter {p.name}: number {p.number}: must be between 0 and 255, each once")
        try:
            low, default, high = (from_bits(p.type, to_bits(p.type, v)) for v in (p.low, p.default, p.high))
        except (struct.error, OverflowError):
            raise ParameterError(f"parameter {p.name}: its numbers must fit the type {p.type.name}") from None
        if not (isfinite(low) and isfinite(high) and low <= default <= high):
            raise ParameterError(f"parameter {p.name} = {p.default}: must be between {p.low} and {p.high}")
        found[p.number] = p._replace(low=low, default=default, high=high)
    return found


class ParameterStore(Protocol):
    """Where a node keeps two copies of its parameters; no error leaves it but OSError and StommelError."""

    def read(self, copy: int) -> bytes | None:
        """Return copy 0 or 1; None if it was never written."""

    def write(self, copy: int, content: bytes) -> None:
        """Replace copy 0 or 1."""


class MemoryStore:
    """Two copies that last as long as the program."""

    def __init__(self) -> None:
        self.copies: list[bytes | None] = [None, None]

    def read(self, copy: int) -> bytes | None:
        """Return a copy."""
        return self.copies[copy]

    def write(self, copy: int, content: bytes) -> None:
        """Replace a copy."""
        self.copies[copy] = content


_HEAD = struct.Struct("<4sII")
"""Mark, generation, count."""
_ITEM = struct.Struct("<BBI")
"""Number, type, bits."""
_TAIL = struct.Struct("<I")
_MARK = b"PAR1"


class StoredParameters(NamedTuple):
    """What a copy of a store says."""

    generation: int
    """Rises with each writing."""
    items: tuple[tuple[int, int, int], ...]
    """Number, type and bits of each parameter."""


def stored_bytes(stored: StoredParameters) -> bytes:
    """Bytes of a copy, with CRC-32 at its end."""
    body = _HEAD.pack(_MARK, stored.generation, len(stored.items))
    body += b"".join(_ITEM.pack(*item) for item in stored.items)
    return body + _TAIL.pack(zlib.crc32(body))


def read_stored(content: bytes) -> StoredParameters:
    """Read a copy.

    Raises
    ------
    ParameterError
        It is not whole; the message says what is wrong.
    """
    if len(content) < _HEAD.size + _TAIL.size or content[:4] != _MARK:
        raise ParameterError("it is not a parameter store")
    body, tail = content[: -_TAIL.size], content[-_TAIL.size :]
    _, generation, count = _HEAD.unpack_from(body)
    if len(body) != _HEAD.size + count * _ITEM.size:
        raise ParameterError(f"it has {len(content)} bytes, must be {_HEAD.size + count * _ITEM.size + _TAIL.size}")
    if _TAIL.unpack(tail)[0] != zlib.crc32(body):
        raise ParameterError("its checksum is wrong")
    return StoredParameters(generation, tuple(_ITEM.iter_unpack(body[_HEAD.size :])))


class ParameterServer:
    """A node's parameters: read from its store at the start, answered and written over the bus.

    `notes` says in words what was wrong with the store; it is empty where nothing was.
    """

    def __init__(self, parameters: Sequence[Parameter], store: ParameterStore) -> None:
        self.parameters = _checked(parameters)
        self._store = store
        self._by_name = {p.name: p.number for p in self.parameters.values()}
        self._values = {number: p.default for number, p in self.parameters.items()}
        self._generation = 0
        self._next_copy = 0
        self.notes: list[str] = []
        self._load()

    def __getitem__(self, name: str) -> Value:
        """Value of a parameter by its name."""
        return self._values[self._by_name[name]]

    def write(self, number: int, bits: int) -> str:
        """Set a parameter until the next start; return `Ok`, or why not, in the database's words."""
        parameter = self.parameters.get(number)
        if parameter is None:
            return "NoSuchParameter"
        value = from_bits(parameter.type, bits)
        if not parameter.allows(value):
            return "OutOfRange"
        self._values[number] = value
        return "Ok"

    def save(self) -> str:
        """Write all values to the older copy of the store; return `Ok` or `NotSaved`."""
        items = tuple((n, int(p.type), to_bits(p.type, self._values[n])) for n, p in self.parameters.items())
        try:
            self._store.write(self._next_copy, stored_bytes(StoredParameters(self._generation + 1, items)))
        except (OSError, StommelError) as error:
            self.notes.append(f"parameter store, copy {self._next_copy}: not written: {error}")
            return "NotSaved"
        self._generation += 1
        self._next_copy = 1 - self._next_copy
        return "Ok"

    def restore_defaults(self) -> None:
        """Set every parameter to its default, until the next start or `save`."""
        self._values = {number: p.default for number, p in self.parameters.items()}

    def take(self, received: Received, encoder: Encoder) -> list[Frame]:
        """Answer a request; the node passes only those that are meant for it."""
        if not received.name.endswith("ParameterRequest"):
            return []
        values = received.values
        number, bits = int(values["parameter"]), int(values["value"])
        operation = word_of(received.name, "operation", int(values["operation"]))
        result, answered = self._answer(operation, number, bits)
        name = received.name.removesuffix("Request") + "Answer"
        return [
            encoder.frame(
                name, operation=values["operation"], parameter=number, value=answered,
                result=value_named(name, "result", result),
            )
        ]  # fmt: skip

    def _answer(self, operation: str, number: int, bits: int) -> tuple[str, int]:
        """Return result and bits of an answer; a refused writing is answered with the value that holds."""
        if operation == "Save":
            return self.save(), 0
        if operation == "RestoreDefaults":
            self.restore_defaults()
            return "Ok", 0
        parameter = self.parameters.get(number)
        if parameter is None:
            return "NoSuchParameter", bits
        if operation == "ReadType":
            return "Ok", int(parameter.type)
        result = self.write(number, bits) if operation == "Write" else "Ok"
        answers = {"ReadDefault": parameter.default, "ReadMinimum": parameter.low, "ReadMaximum": parameter.high}
        return result, to_bits(parameter.type, answers.get(operation, self._values[number]))

    def _load(self) -> None:
        copies = [self._copy(number) for number in (0, 1)]
        whole = [(stored.generation, number) for number, stored in enumerate(copies) if stored is not None]
        if not whole:
            if self.notes:
                self.notes.append("parameter store: no good copy; the defaults hold")
            return
        self._generation, number = max(whole)
        self._next_copy = 1 - number
        if self.notes:
            self.notes.append(f"parameter store: copy {number} holds, the last good one")
        stored = copies[number]
        assert stored is not None
        for item in stored.items:
            self._set(*item)

    def _copy(self, number: int) -> StoredParameters | None:
        try:
            content = self._store.read(number)
            return None if content is None else read_stored(content)
        except (OSError, StommelError) as error:
            self.notes.append(f"parameter store, copy {number}: {error}")
        return None

    def _set(self, number: int, kind: int, bits: int) -> None:
        parameter = self.parameters.get(number)
        if parameter is None:
            self.notes.append(f"parameter store: number {number}: there is no such parameter; passed over")
        elif kind != parameter.type or self.write(number, bits) != "Ok":
            value = from_bits(ParameterType(kind), bits) if kind in list(ParameterType) else bits
            allowed = f"{parameter.type.name} between {parameter.low} and {parameter.high} {parameter.unit}".rstrip()
            self.notes.append(f"parameter store: {parameter.name} = {value}: must be {allowed}; its default holds")


TIME_OUT = 1.0
"""After which a request is sent again [s]."""
TRIES = 4
_EARLY = 1e-6


class ParameterAnswer(NamedTuple):
    """What a node answered, or that it did not."""

    operation: str
    parameter: int
    bits: int
    result: str
    """In the database's words; `NoAnswer` if none came."""


@dataclass
class _Request:
    operation: str
    parameter: int
    bits: int
    deadline: float
    tries: int = 0


class ParameterClient:
    """Asks one node for its parameters, one request at a time, each again until it is answered or given up."""

    def __init__(self, node: int, encoder: Encoder) -> None:
        self._request_name, self._answer_name = f"{NODES[node]}ParameterRequest", f"{NODES[node]}ParameterAnswer"
        self._encoder = encoder
        self._waiting: list[_Request] = []
        self._answers: list[ParameterAnswer] = []

    def ask(self, operation: str, parameter: int, t: float, bits: int = 0) -> None:
        """Queue a request: `Read`, `Write`, `ReadDefault`, ...; for `Write`, `to_bits` gives the bits."""
        request = _Request(operation, parameter, bits, t)
        Encoder().frame(self._request_name, **self._values(request))  # what cannot be said is refused here
        self._waiting.append(request)

    def poll(self, t: float) -> list[Frame]:
        """Return the frame that is due at a time [s], if any."""
        while self._waiting and t >= self._waiting[0].deadline - _EARLY:
            request = self._waiting[0]
            if request.tries < TRIES:
                request.tries, request.deadline = request.tries + 1, t + TIME_OUT
                return [self._encoder.frame(self._request_name, **self._values(request))]
            self._end(ParameterAnswer(request.operation, request.parameter, 0, "NoAnswer"))
        return []

    def take(self, received: Received, t: float) -> None:  # noqa: ARG002 - as every engine's
        """Take a message at a time [s]; all but answers to what was asked are passed over."""
        if received.name != self._answer_name or not self._waiting:
            return
        values, request = received.values, self._waiting[0]
        operation = word_of(self._answer_name, "operation", int(values["operation"]))
        if request.tries and (operation, values["parameter"]) == (request.operation, request.parameter):
            result = word_of(self._answer_name, "result", int(values["result"]))
            self._end(ParameterAnswer(operation, request.parameter, int(values["value"]), result))

    def answers(self) -> list[ParameterAnswer]:
        """Return what was answered since this was last asked."""
        answers, self._answers = self._answers, []
        return answers

    def _end(self, answer: ParameterAnswer) -> None:
        self._waiting.pop(0)
        self._answers.append(answer)

    def _values(self, request: _Request) -> dict[str, float]:
        operation = value_named(self._request_name, "operation", request.operation)
        return {"operation": operation, "parameter": request.parameter, "value": request.bits}
