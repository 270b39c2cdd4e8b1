"""Names in a file that are nearly those with a meaning: one flipped bit, and all numbers mean something else."""

from stommel.ocean.reading.axes import TIME_AND_DEPTH
from stommel.ocean.reading.variables import STANDARD_NAMES, File

_ATTRIBUTES = (
    "_FillValue", "_Unsigned", "add_offset", "bounds", "calendar", "climatology", "coordinates", "grid_mapping",
    "missing_value", "positive", "scale_factor", "standard_name", "units", "valid_max", "valid_min", "valid_range",
)  # fmt: skip
"""Attributes that change what numbers mean."""
_STANDARD = (*(name for names in STANDARD_NAMES.values() for name in names), *TIME_AND_DEPTH)
_LOST = 3
"""Letters that may be lost at the end of a name of known beginning."""


def require_spelling(file: File) -> None:
    """Refuse a file in which a name with a meaning is spelt wrong.

    Raises
    ------
    FileError
        An attribute or a standard name is one letter off a known one, or lacks its end.
    """
    for variable, array in file.data.variables.items():
        for name, value in array.attrs.items():
            known = _nearly(str(name), _ATTRIBUTES)
            # units in capitals are a habit of some; without units nothing is read
            if known is not None and str(name).lower() != "units":
                file.refuse(
                    str(variable), f"{variable} has an attribute {str(name)!r}, nearly {known}; the file is damaged"
                )
            known = _nearly(str(value), _STANDARD, lost=_LOST) if name == "standard_name" else None
            if known is not None:
                file.refuse(
                    str(variable),
                    f"{variable} has the standard_name {str(value)!r}, nearly {known}; the file is damaged",
                )


def _nearly(given: str, known: tuple[str, ...], lost: int = 0) -> str | None:
    """The name that this one is but for a letter, or for letters lost at its end; none where it is one itself."""
    if given in known:
        return None
    for name in known:
        off = sum(a != b for a, b in zip(given, name, strict=False))
        if (len(given) == len(name) and off == 1) or (off == 0 and 0 < len(name) - len(given) <= lost < len(given)):
            return name
    return None
