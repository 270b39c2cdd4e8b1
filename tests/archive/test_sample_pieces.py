"""Samples in pieces. Oracle: what was stored, sample by sample."""

import pytest

from stommel.archive import Archive, Batch
from stommel.archive.sample_pieces import kept_channels, sample_pieces
from tests.archive.every_sample import every_sample

T = 1_700_000_000.0
DEPTHS = [("depth_m", T + k, 0.1 * k) for k in range(25)]
PITCHES = [("pitch_deg", T + 0.5 + k, -1.0 * k) for k in range(7)]


@pytest.fixture
def sea(archive: Archive) -> Archive:
    archive.store(1, Batch(samples=[*DEPTHS, *PITCHES]))
    archive.store(2, Batch(samples=[("roll_deg", T, 9.0)]))
    return archive


def test_every_sample_of_the_channels_of_a_vehicle_is_told(sea: Archive) -> None:
    assert kept_channels(sea, 1) == ["depth_m", "pitch_deg"]
    assert kept_channels(sea, 3) == []
    assert every_sample(sea, 1, T, T + 100.0) == [*DEPTHS, *PITCHES]
    assert every_sample(sea, 1, T + 3.0, T + 4.0) == [*DEPTHS[3:5], PITCHES[3]]


@pytest.mark.parametrize("size", [1, 4, 5, 25, 26])
def test_no_piece_is_larger_than_it_may_be_and_none_is_told_twice(sea: Archive, size: int) -> None:
    pieces = list(sample_pieces(sea, 1, ["pitch_deg", "depth_m", "roll_deg"], T, T + 100.0, size))
    assert all(1 <= piece.t_us.size <= size for piece in pieces)
    told = [value for piece in pieces for value in piece.value.tolist()]
    assert told == [value for _, _, value in [*PITCHES, *DEPTHS]]


def test_whoever_reads_slowly_holds_no_connection(sea: Archive) -> None:
    """A reader that keeps one would keep SQLite's log from being taken into the file, and others from reading."""
    pieces = sample_pieces(sea, 1, ["depth_m"], T, T + 100.0, 5)
    next(pieces)
    assert sea.engine.pool.checkedout() == 0  # type: ignore[attr-defined]
    sea.store(1, Batch(samples=[("depth_m", T + 24.5, 7.0)]))
    assert sum(piece.t_us.size for piece in pieces) == 21
