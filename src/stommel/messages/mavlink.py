"""MAVLink messages: names, fields and bytes of the common dialect and of `glider.xml`.

pymavlink knows the common dialect and reads our XML; packing is ours, since its own objects take a CRC in Python and a
tuple of 251 numbers for a file's piece.
"""

import struct
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from stommel.errors import StommelError

FieldValue = int | float | str | bytes | tuple[int, ...] | tuple[float, ...]
Fields = dict[str, FieldValue]

DIALECT = Path(__file__).with_name("glider.xml")
MOST_PAYLOAD = 255
"""Bytes of a message."""

_CODES = {
    "char": "s", "uint8_t": "B", "int8_t": "b", "uint16_t": "H", "int16_t": "h", "uint32_t": "I", "int32_t": "i",
    "uint64_t": "Q", "int64_t": "q", "float": "f", "double": "d",
}  # fmt: skip


class MessageError(StommelError):
    """A message that is unknown or cannot be said."""


class Field(NamedTuple):
    """A field as it lies on the wire."""

    name: str
    type: str
    """`uint8_t`, `float`, ...; of an element if it is an array."""
    elements: int
    """Of an array; 0 for a single value."""

    @property
    def code(self) -> str:
        """Format for `struct`; text and bytes are one item each."""
        if self.elements and self.type in ("char", "uint8_t"):
            return f"{self.elements}s"
        return f"{self.elements or ''}{_CODES[self.type]}"


class MessageType(NamedTuple):
    """A kind of message."""

    id: int
    name: str
    fields: tuple[Field, ...]
    """As they lie on the wire."""
    crc_extra: int
    """Is part of every checksum, so that both ends know the same fields."""
    least: int
    """Bytes without extensions."""
    layout: struct.Struct

    def pack(self, values: Mapping[str, FieldValue]) -> bytes:
        """Return the payload of values by field name, zeros at its end left out; a field that is left out is 0.

        Raises
        ------
        MessageError
            There is no such field, or it cannot hold the value.
        """
        if unknown := set(values) - {field.name for field in self.fields}:
            raise MessageError(f"{self.name}: has no field {', '.join(sorted(unknown))}")
        flat: list[Any] = []
        for field in self.fields:
            flat += _flat(self.name, field, values.get(field.name))
        try:
            payload = self.layout.pack(*flat)
        except (struct.error, OverflowError) as error:
            raise MessageError(f"{self.name}: {error}") from None
        return payload.rstrip(b"\0") or payload[:1]

    def unpack(self, payload: bytes) -> Fields:
        """Return the values of a payload; what its end leaves out is zeros, what is beyond the fields is not read."""
        size = self.layout.size
        flat = self.layout.unpack(payload[:size].ljust(size, b"\0"))
        values: Fields = {}
        at = 0
        for field in self.fields:
            width = field.elements if field.elements and field.type not in ("char", "uint8_t") else 1
            value: Any = (
                flat[at : at + width] if width > 1 or (field.elements and width == field.elements == 1) else flat[at]
            )
            if field.type == "char":
                value = value.split(b"\0", 1)[0].decode("utf-8", "replace")
            values[field.name] = value
            at += width
        return values


def _flat(message: str, field: Field, value: FieldValue | None) -> list[Any]:
    """Items of `struct` for a value."""
    if field.type == "char" or (field.elements and field.type == "uint8_t"):
        content = value.encode() if isinstance(value, str) else bytes(value or b"")  # type: ignore[arg-type]
        if len(content) > (field.elements or 1):
            raise MessageError(
                f"{message}.{field.name}: {len(content)} bytes; at most {field.elements or 1} are allowed"
            )
        return [content]
    if not field.elements:
        return [0 if value is None else value]
    items = list(value or ())  # type: ignore[arg-type]
    if len(items) > field.elements:
        raise MessageError(f"{message}.{field.name}: {len(items)} values; at most {field.elements} are allowed")
    return items + [0] * (field.elements - len(items))


def _message_type(number: int, name: str, fields: list[Field], base: int, crc_extra: int) -> MessageType:
    layout = struct.Struct("<" + "".join(field.code for field in fields))
    least = struct.calcsize("<" + "".join(field.code for field in fields[:base]))
    return MessageType(number, name, tuple(fields), crc_extra, least, layout)


@cache
def message_types() -> Mapping[int, MessageType]:
    """Return every kind of message by its number."""
    from pymavlink.dialects.v20 import common  # noqa: PLC0415 - only who speaks MAVLink needs it
    from pymavlink.generator.mavparse import MAVXML  # noqa: PLC0415

    found: dict[int, MessageType] = {}
    for number, kind in common.mavlink_map.items():
        types = dict(zip(kind.fieldnames, kind.fieldtypes, strict=True))
        names, counts = kind.ordered_fieldnames, kind.array_lengths
        fields = [Field(name, types[name], count) for name, count in zip(names, counts, strict=True)]
        found[number] = _message_type(number, kind.msgname, fields, len(fields), kind.crc_extra)
    for message in MAVXML(str(DIALECT), "2.0").message:
        fields = [Field(field.name, field.type, field.array_length) for field in message.ordered_fields]
        if message.id in found:
            raise MessageError(f"{DIALECT.name}: message {message.name}: number {message.id} is taken")
        found[message.id] = _message_type(message.id, message.name, fields, message.base_fields(), message.crc_extra)
    return found


@cache
def message_named(name: str) -> MessageType:
    """Return a kind of message by its name.

    Raises
    ------
    MessageError
        There is none.
    """
    for kind in message_types().values():
        if kind.name == name:
            return kind
    raise MessageError(f"{name}: is no message of the common dialect or of {DIALECT.name}")


@cache
def enumeration(name: str) -> Mapping[str, int]:
    """Return the entries of an enumeration, of the common dialect or of `glider.xml`, by name.

    Raises
    ------
    MessageError
        There is none.
    """
    from pymavlink.dialects.v20 import common  # noqa: PLC0415

    if name in common.enums:
        return {entry.name: int(value) for value, entry in common.enums[name].items()}
    return {entry.name: int(entry.value) for entry in _own_entries(name)}


@cache
def entry_words(name: str) -> Mapping[int, str]:
    """Return what the entries of an enumeration of `glider.xml` mean, by their values.

    Raises
    ------
    MessageError
        There is no such enumeration.
    """
    return {int(entry.value): entry.description for entry in _own_entries(name)}


def _own_entries(name: str) -> list[Any]:
    from pymavlink.generator.mavparse import MAVXML  # noqa: PLC0415

    for found in MAVXML(str(DIALECT), "2.0").enum:
        if found.name == name:
            return [entry for entry in found.entry if not entry.name.endswith("_ENUM_END")]
    raise MessageError(f"{name}: is no enumeration of the common dialect or of {DIALECT.name}")
