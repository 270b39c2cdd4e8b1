"""Which ocean the options choose, read from text."""

from typing import TYPE_CHECKING, Any

from stommel.errors import StommelError

if TYPE_CHECKING:
    from stommel.ocean import Ocean


class OceanOptionError(StommelError):
    """An option that does not say what it should."""


def open_ocean(given: list[str], choice: dict[str, Any], policies: dict[str, Any]) -> "Ocean":
    """Open the ocean of that name, or else the files.

    Raises
    ------
    OceanOptionError
        Neither name nor file, or an option that this kind of ocean does not have.
    """
    from stommel.ocean import Ocean
    from stommel.ocean.analytic.catalogue import ANALYTIC, is_analytic

    choice = choice | {"parameters": {key: _number_or_text(value) for key, value in choice["parameters"].items()}}
    if given[0] in ANALYTIC:
        if len(given) > 1:
            raise OceanOptionError(f"{given[0]}: an analytic ocean stands alone; {given[1]} is too much")
        unfit = [key for key in ("names", "units", "bounds", "between", "at_rest") if choice[key]]
        if unfit:
            option = "--" + unfit[0].removesuffix("s" if unfit[0] in ("names", "units") else "").replace("_", "-")
            raise OceanOptionError(f"{option}: {given[0]} is an analytic ocean; only a file has this option")
        return Ocean.analytic(given[0], **choice["parameters"]).with_outside(**policies)
    if len(given) == 1:
        is_analytic(given[0])  # refuses what is no file either
    return Ocean.open(given, **choice, **policies)


def _number_or_text(text: str) -> float | str:
    try:
        return float(text)
    except ValueError:
        return text  # refused with its name by what should have been given a number


def pairs(texts: list[str] | None, option: str) -> dict[str, str]:
    """Read NAME=VALUE, as often as it was given."""
    texts = texts or []
    wrong = [text for text in texts if not text.partition("=")[0].strip() or "=" not in text]
    if wrong:
        raise OceanOptionError(f"{option} {wrong[0]}: must be like NAME=VALUE")
    return {key.strip(): value.strip() for key, value in (text.split("=", 1) for text in texts)}


def place(text: str | None) -> tuple[float, float] | None:
    """Read latitude and longitude [deg]."""
    if text is None:
        return None
    latitude, longitude = _numbers(text, 2, f"--at {text!r}: must be a latitude and a longitude like 28.2,126.6")
    return latitude, longitude


def bounds(text: str | None) -> tuple[float, float, float, float] | None:
    """Read south, north, west and east [deg]."""
    if text is None:
        return None
    south, north, west, east = _numbers(
        text, 4, f"--bounds {text!r}: must be south, north, west, east like 25,32,120,130"
    )
    return south, north, west, east


def _numbers(text: str, count: int, refusal: str) -> list[float]:
    try:
        found = [float(part) for part in text.split(",")]
    except ValueError:
        raise OceanOptionError(refusal) from None
    if len(found) != count or not all(abs(value) <= 720.0 for value in found):
        raise OceanOptionError(refusal)
    return found


def between(text: str | None) -> tuple[str, str] | None:
    """Read the first and the last time."""
    if text is None:
        return None
    parts = text.split(",")
    if len(parts) != 2:
        raise OceanOptionError(f"--between {text!r}: must be two times like 2016-02-01,2016-02-05T12:00")
    return parts[0], parts[1]
