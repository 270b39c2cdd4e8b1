"""Values of parameters in the field of a message that MAVLink has for them: 32 bits that say they are a float.

"Byte-wise" encoding (MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_BYTEWISE): the bytes of a whole number lie in the field as
they are. Bits that are a signalling not-a-number do not survive being a float on most machines, therefore no parameter
may reach them.
"""

import hashlib
import re
import struct
from collections.abc import Iterable, Sequence
from math import isfinite

from stommel.errors import StommelError
from stommel.link.parameters.port import Description, ParameterKind, ParameterSet, Value, WriteError
from stommel.messages.mavlink import Fields, message_named

LEAST_INT, MOST_INT = -4194304, 2139095040
"""Whole numbers whose 32 bits are no signalling not-a-number."""
LONGEST_ID, LONGEST_UNIT, LONGEST_WORDS = 16, 16, 180
DIGEST = 16
"""Bytes of a digest."""
_ID = re.compile(r"[A-Z][A-Z0-9_]{0,15}")
_CODES = {1: "<Bxxx", 2: "<bxxx", 3: "<Hxx", 4: "<hxx", 5: "<I", 6: "<i", 9: "<f"}
"""By MAV_PARAM_TYPE, those of 32 bits and less."""


class ParameterValueError(StommelError):
    """A parameter that cannot be as it is described, or a value that it cannot have."""

    def __init__(self, words: str, error: WriteError = WriteError.OUT_OF_RANGE) -> None:
        super().__init__(words)
        self.error = error


def float_of(kind: ParameterKind, value: Value) -> float:
    """Return the float that a message holds for a value."""
    return float(struct.unpack("<f", _bits(kind, value))[0])


def _bits(kind: ParameterKind, value: Value) -> bytes:
    return struct.pack(_CODES[kind], value)


def value_of(kind: int, held: float) -> Value:
    """Return the value of the float that a message holds.

    Raises
    ------
    ParameterValueError
        There is no such type.
    """
    if kind not in _CODES:
        raise ParameterValueError(f"param_type = {kind}: must be one of {', '.join(map(str, _CODES))}")
    value: Value = struct.unpack(_CODES[kind], struct.pack("<f", held))[0]
    return value


def held(kind: ParameterKind, value: Value) -> Value:
    """Return a value as 32 bits hold it.

    Raises
    ------
    ParameterValueError
        They cannot.
    """
    if kind is not ParameterKind.FLOAT32 and isinstance(value, float) and value.is_integer():
        value = int(value)  # PARAMETER_OUTCOME tells every value as a double
    try:
        return value_of(kind, float_of(kind, value))
    except (struct.error, OverflowError):
        raise ParameterValueError(f"{value!r}: is no {kind.name.lower()}") from None


def fitting(described: Description, value: Value) -> Value:
    """Return a value as its parameter holds it.

    Raises
    ------
    ParameterValueError
        It is beyond the limits, or no whole number where one must be.
    """
    is_whole = described.kind is not ParameterKind.FLOAT32
    if isfinite(value) and described.low <= value <= described.high:
        if not is_whole:
            # 32 bits hold a limit a little off: a value that is the limit is within it
            low, high = held(described.kind, described.low), held(described.kind, described.high)
            return min(max(held(described.kind, value), low), high)
        if float(value).is_integer():
            return int(value)
    number = "a whole number " if is_whole else ""
    span = f"{number}between {described.low:.9g} and {described.high:.9g} {described.unit}".rstrip()
    raise ParameterValueError(f"{described.id} = {value:.9g}: must be {span}")


def check_sets(sets: Iterable[ParameterSet]) -> None:
    """Hold descriptions against what messages can say.

    Raises
    ------
    ParameterValueError
        One cannot be said, two have one name, or limits and default contradict each other.
    """
    for each in sets:
        names = [described.id for described in each.descriptions]
        if len(set(names)) != len(names) or len(each.values) != len(names):
            raise ParameterValueError(f"parameters of {each.name}: must have one value each, and each name once")
        for described in each.descriptions:
            check_description(described, each.name)


def check_description(described: Description, component: str) -> None:
    """Hold a description against what messages can say.

    Raises
    ------
    ParameterValueError
        It cannot be said, or limits and default contradict each other.
    """
    where = f"parameters of {component}: {described.id}"
    if not _ID.fullmatch(described.id):
        raise ParameterValueError(f"{where}: must be up to {LONGEST_ID} capital letters, digits and underscores")
    if len(described.unit.encode()) > LONGEST_UNIT or len(described.words.encode()) > LONGEST_WORDS:
        raise ParameterValueError(f"{where}: unit and words must be at most {LONGEST_UNIT} and {LONGEST_WORDS} bytes")
    least, most = {
        ParameterKind.UINT8: (0, 255),
        ParameterKind.INT32: (LEAST_INT, MOST_INT),
        ParameterKind.FLOAT32: (-3.4e38, 3.4e38),
    }[described.kind]
    if not least <= described.low <= described.default <= described.high <= most:
        raise ParameterValueError(f"{where}: limits and default must rise from {least:.9g} to {most:.9g}")


def description_fields(number: int, described: Description) -> Fields:
    """Fields of PARAMETER_DESCRIPTION, with the number in the set."""
    return {
        "default_value": float(described.default), "low": float(described.low), "high": float(described.high),
        "param_index": number, "param_type": int(described.kind), "param_id": described.id, "unit": described.unit,
        "words": described.words,
    }  # fmt: skip


def value_fields(each: ParameterSet, number: int, value: Value) -> Fields:
    """Fields of PARAM_VALUE, with the number in the set."""
    described = each.descriptions[number]
    return {
        "param_id": described.id, "param_value": float_of(described.kind, value), "param_type": int(described.kind),
        "param_count": len(each.descriptions), "param_index": number,
    }  # fmt: skip


def descriptions_digest(descriptions: Sequence[Description]) -> bytes:
    """Digest of all descriptions of a component."""
    message = message_named("PARAMETER_DESCRIPTION")
    payloads = (message.pack(description_fields(number, described)) for number, described in enumerate(descriptions))
    return hashlib.sha256(b"".join(payload.ljust(message.layout.size, b"\0") for payload in payloads)).digest()[:DIGEST]


def values_digest(descriptions: Sequence[Description], values: Sequence[Value | None]) -> bytes:
    """Digest of all values of a component; zeros if one is not known."""
    bits = bytearray()
    for described, value in zip(descriptions, values, strict=True):
        if value is None:
            return bytes(DIGEST)
        bits += _bits(described.kind, value)
    return hashlib.sha256(bits).digest()[:DIGEST]
