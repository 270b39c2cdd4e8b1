"""Numbers, units and keys as the report words them."""

from collections.abc import Sequence
from math import isinf

from stommel.design.study import DesignStudy
from stommel.files.provenance import Provenance
from stommel.files.units import unit_of

MINUS = "−"

_SIGNS = {"degrees": "deg", "deg C": "°C"}
_POWERS = str.maketrans("23", "²³")


def fixed(value: float, digits: int = 2) -> str:
    """Format with a fixed number of decimals, a proper minus sign, and no negative zero."""
    if isinf(value):
        return "∞" if value > 0 else MINUS + "∞"
    return f"{round(value, digits) + 0.0:.{digits}f}".replace("-", MINUS)


def short(value: float, digits: int = 4) -> str:
    """Format with so many significant digits, a proper minus sign."""
    return f"{value + 0.0:.{digits}g}".replace("-", MINUS)


def signed(value: float, digits: int = 2) -> str:
    """Format a difference: always with its sign."""
    text = fixed(value, digits)
    return text if text.startswith(MINUS) or not text.strip("0.") else f"+{text}"


def percent(change: float) -> str:
    """A relative change, as +41 % or −2.3 %."""
    return f"{signed(100.0 * change, 0 if abs(change) >= 0.1 else 1)} %"


def listed(value: object) -> str:
    """A number or nested list of the vehicle file, as the file writes it."""
    if isinstance(value, list | tuple):
        return "[" + ", ".join(listed(item) for item in value) + "]"
    return f"{value:g}" if isinstance(value, float) else str(value)


def unit(key: str) -> str:
    """Unit of a number of the vehicle file; "1" where it has none."""
    words = (unit_of(key) or "1").translate(_POWERS)
    for plain, sign in _SIGNS.items():
        words = words.replace(plain, sign)
    return words


def joined(words: Sequence[str]) -> str:
    """`a, b and c`."""
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


def why_unanswered(study: DesignStudy, part: str) -> str:
    """Reason that a study gives for a part it could not answer."""
    reasons = dict(study.unanswered)
    return reasons.get(part, "nothing that was tried is within the limits of the vehicle file")


def origin(origin: Provenance) -> str:
    """Where a number comes from, with the range that it may well lie in."""
    between = f"; between {short(origin.range[0])} and {short(origin.range[1])}" if origin.range else ""
    return origin.text + between
