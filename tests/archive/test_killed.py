"""`kill -9` at random moments loses nothing that was reported as stored: oracle is what the killed process printed."""

import os
from pathlib import Path

import pytest
from sqlalchemy import text

from stommel.archive import Archive
from tests.archive import writer_killed

KILLS = int(os.environ.get("STOMMEL_ARCHIVE_KILLS", "20"))


def test_nothing_that_was_stored_is_lost(tmp_path: Path) -> None:
    assert writer_killed.run(str(tmp_path / "archive.sqlite"), KILLS, seed=7) > KILLS // 2


def test_nothing_that_was_stored_is_lost_in_both_databases(database: str) -> None:
    assert writer_killed.run(database, 3, seed=3) > 1


def test_a_loss_is_found(tmp_path: Path) -> None:
    """The search itself: a frame that is taken away, a batch that is missing."""
    url = str(tmp_path / "archive.sqlite")
    last = writer_killed.killed_and_looked_at(url, 0, 0.05, stored=2) - 1
    with Archive.open(url) as archive, archive.writing() as connection:
        connection.execute(text("DELETE FROM frames WHERE id = (SELECT max(id) FROM frames)"))
    with pytest.raises(writer_killed.LostError, match="half a batch"):
        writer_killed.looked_at(url, last)
    with pytest.raises(writer_killed.LostError, match="not there"):
        writer_killed.looked_at(url, last + 1)
