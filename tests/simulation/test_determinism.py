"""The same mission and seed give the same bytes, in one piece or in several; another seed does not."""

import hashlib
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from stommel.simulation import flight as flight_module
from stommel.simulation.flight import Flown
from tests.simulation.conftest import file_of, flown


def test_same_seed_gives_the_same_bytes(quarter_day: Flown) -> None:
    assert file_of(flown()) == file_of(quarter_day)


def test_another_process_writes_the_same_bytes(quarter_day: Flown) -> None:
    code = (
        "import hashlib; from tests.simulation.conftest import file_of, flown;"
        "print(hashlib.sha256(file_of(flown())).hexdigest())"
    )
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True,
                           timeout=300, cwd=Path(__file__).parents[2])  # fmt: skip
    assert found.stdout.strip() == hashlib.sha256(file_of(quarter_day)).hexdigest()


def test_another_seed_differs_in_noise_only(quarter_day: Flown) -> None:
    other = flown(seed=2)
    assert not np.array_equal(other.record, quarter_day.record)
    assert other.outcome == quarter_day.outcome
    assert len(other.surfacings) == len(quarter_day.surfacings)


def test_pieces_change_nothing(quarter_day: Flown, monkeypatch: pytest.MonkeyPatch) -> None:
    """Uninterrupted or in 37 pieces of unequal contents: the same record."""
    monkeypatch.setattr(flight_module, "_PIECE_DAYS", 0.25 / 37.3)
    shares: list[float] = []
    document_flown = flight_module.fly_mission(quarter_day.mission, progress=shares.append)
    assert len(shares) > 30
    np.testing.assert_array_equal(document_flown.record, quarter_day.record)
    np.testing.assert_array_equal(document_flown.surfacings, quarter_day.surfacings)
    np.testing.assert_array_equal(document_flown.events, quarter_day.events)
