"""Fields of received messages, with the types that the dialect gives them."""

from collections.abc import Mapping

from stommel.messages.mavlink import FieldValue

Values = Mapping[str, FieldValue]


def boot_ms(t: float) -> int:
    """Time of a sender [s] as its messages say it [ms]; it begins anew after 49 days."""
    return int(max(t, 0.0) * 1e3) & 0xFFFFFFFF


def whole(values: Values, name: str) -> int:
    """A whole number."""
    value = values[name]
    assert isinstance(value, int)
    return value


def real(values: Values, name: str) -> float:
    """A number."""
    value = values[name]
    assert isinstance(value, int | float)
    return float(value)


def octets(values: Values, name: str) -> bytes:
    """Bytes."""
    value = values[name]
    assert isinstance(value, bytes)
    return value


def text(values: Values, name: str) -> str:
    """Text."""
    value = values[name]
    assert isinstance(value, str)
    return value
