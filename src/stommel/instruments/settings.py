"""Settings of instruments that are not possible."""

from collections.abc import Iterable

from stommel.errors import StommelError


class SettingError(StommelError):
    """A setting of an instrument is none that it has; the message names it and what is allowed."""


def refuse(name: str, value: object, allowed: Iterable[object]) -> SettingError:
    """Return the error for a setting that must be one of some values."""
    return SettingError(f"{name} = {value}: must be one of {', '.join(map(str, allowed))}")


def require_positive(name: str, value: float) -> None:
    """Hold a number against zero.

    Raises
    ------
    SettingError
        It is not more than zero.
    """
    if not 0.0 < value < float("inf"):
        raise SettingError(f"{name} = {value:g}: must be more than 0")
