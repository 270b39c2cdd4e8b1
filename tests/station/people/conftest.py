"""People of an empty station, whose clock a test turns."""

from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from stommel.archive import Archive
from stommel.station.people.people import People


class Clock(SimpleNamespace):
    now: float = 1_800_000_000.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Clock:
    """The clock of the station, which the library `limits` reads too."""
    clock = Clock()
    monkeypatch.setattr("time.time", clock)
    return clock


@pytest.fixture
def told() -> list[Any]:
    """What everybody hears of holds."""
    return []


@pytest.fixture
def people(tmp_path: Path, clock: Clock, told: list[Any]) -> Iterator[People]:
    archive = Archive.open(f"sqlite:///{tmp_path / 'archive.sqlite'}")
    yield People(archive, clock=clock, told=lambda vehicle, hold: told.append((vehicle, hold)))
    archive.close()
