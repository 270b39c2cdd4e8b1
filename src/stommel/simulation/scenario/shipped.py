"""Missions that come with stommel, by name."""

import tomllib
from importlib.resources import files
from pathlib import Path

from stommel.errors import StommelError


class UnknownMissionError(StommelError):
    """Neither a shipped mission nor a file."""


def shipped_missions() -> dict[str, str]:
    """Names of the shipped missions, with their titles."""
    found = sorted(_folder().glob("*.toml"))
    return {path.stem: str(tomllib.loads(path.read_text(encoding="utf-8"))["name"]) for path in found}


def mission_path(name: str) -> Path:
    """Path of a mission file, or of the shipped mission of this name.

    Raises
    ------
    UnknownMissionError
        There is neither.
    """
    if Path(name).exists():
        return Path(name)
    names = shipped_missions()
    if name in names:
        return _folder() / f"{name}.toml"
    raise UnknownMissionError(f"mission {name!r} is neither a file nor a shipped mission; shipped: {', '.join(names)}")


def _folder() -> Path:
    return Path(str(files("stommel.simulation.scenario"))) / "missions"
