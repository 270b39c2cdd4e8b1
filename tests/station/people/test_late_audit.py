"""The audit log while the archive takes nothing. Oracle: what was done, and when."""

from contextlib import suppress

import pytest

from stommel.archive import ArchiveError, ArchiveRequestError
from stommel.archive.errors import ArchiveFullError
from stommel.station.people.audit import MOST_LATE, Audit
from stommel.station.people.people import People


def full(*_: object) -> None:
    raise ArchiveFullError("archive.sqlite: the disk is full; free some room there")


def test_what_was_done_while_the_disk_was_full_is_written_when_it_is_not(
    people: People, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In its order, with the time at which it was done, and once."""
    times = iter(range(1000, 2000))
    audit = Audit(people.audit._archive, lambda: float(next(times)))
    audit.record("before", user="ada")
    with monkeypatch.context() as broken:
        broken.setattr(audit._archive, "writing", full)
        for k in range(3):
            with pytest.raises(ArchiveError, match="the disk is full"):
                audit.record(f"late {k}", user="ada", detail={"k": k})
    assert [(entry.action, entry.t) for entry in reversed(audit.entries())] == [
        ("before", 1000.0), ("late 0", 1001.0), ("late 1", 1002.0), ("late 2", 1003.0)
    ]  # fmt: skip
    audit.record("after", user="ada")
    assert audit.entries()[0].action == "after"
    assert len(audit.entries()) == 5


def test_what_waits_is_bounded_and_what_no_archive_takes_holds_nothing_up(
    people: People, monkeypatch: pytest.MonkeyPatch
) -> None:
    audit = people.audit
    with monkeypatch.context() as broken:
        broken.setattr(audit._archive, "writing", full)
        for k in range(MOST_LATE + 10):
            with suppress(ArchiveError):
                audit.record(f"late {k}", user=None)
    assert len(audit.entries(limit=2 * MOST_LATE)) == MOST_LATE
    with pytest.raises(ArchiveRequestError, match="a value that the database does not take"):
        audit.record("x", user=None, vehicle=1 << 70)
    audit.record("y", user=None)
    assert audit.entries()[0].action == "y"
