"""Published equilibria of built-in vehicles, to stand beside the computed ones."""

from dataclasses import dataclass
from importlib import resources

from stommel.files.toml_reader import parse_toml


@dataclass(frozen=True)
class PublishedRow:
    """One printed row of a trim table."""

    speed_m_s: float
    pitch_deg: float
    moving_mass_mm: float
    angle_of_attack_deg: float
    ballast_ml: float


@dataclass(frozen=True)
class PublishedTable:
    """A printed trim table."""

    title: str
    source: str
    rows: tuple[PublishedRow, ...]


def published_tables(builtin: str | None) -> tuple[PublishedTable, ...]:
    """Tables published for a built-in vehicle; empty for any other."""
    entry = resources.files(__package__) / f"{builtin}.toml"
    if builtin is None or not entry.is_file():
        return ()
    tables = parse_toml(entry.read_text(encoding="utf-8"), entry.name)["tables"]
    return tuple(
        PublishedTable(table["title"], table["source"], tuple(PublishedRow(*row) for row in table["rows"]))
        for table in tables
    )
