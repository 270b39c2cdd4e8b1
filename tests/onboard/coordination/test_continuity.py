"""What outlives a restart. Oracle: what was kept before the power was cut, by the disk that cuts it anywhere."""

import os
from pathlib import Path

import pytest

from stommel.files.folder_storage import FolderStorage
from stommel.onboard.coordination.stores.continuity import Continuity, ContinuityStore

FIRST = Continuity(1, True, ("leak",), 3, 2, 5000.0)
SECOND = FIRST._replace(waypoint=3, energy_used=7000.5, standing=())
COPIES = ("continuity-a", "continuity-b")


def test_nothing_was_kept_before_the_first_start(tmp_path: Path) -> None:
    assert ContinuityStore(FolderStorage(tmp_path)).kept == Continuity()


def test_the_newer_copy_counts(tmp_path: Path) -> None:
    for kept in (FIRST, SECOND, FIRST, SECOND):
        ContinuityStore(FolderStorage(tmp_path)).keep(kept)
        opened = ContinuityStore(FolderStorage(tmp_path))
        assert opened.kept == kept
        assert not opened.notes


def test_any_damaged_byte_of_the_newer_copy_leaves_the_older(tmp_path: Path) -> None:
    """Each byte flipped, and the file cut there, in turn."""
    store = ContinuityStore(FolderStorage(tmp_path))
    store.keep(FIRST)
    store.keep(SECOND)
    path = tmp_path / COPIES[1]
    whole = path.read_bytes()
    for k in range(len(whole)):
        for damaged in (whole[:k], whole[:k] + bytes((whole[k] ^ 0x20,)) + whole[k + 1 :]):
            path.write_bytes(damaged)
            opened = ContinuityStore(FolderStorage(tmp_path))
            assert opened.kept == FIRST
            assert opened.notes
            assert opened.notes[0].startswith("continuity-b is not used")


def test_both_copies_lost_is_a_first_start(tmp_path: Path) -> None:
    for name in COPIES:
        (tmp_path / name).write_bytes(b"\xff\x00")
    opened = ContinuityStore(FolderStorage(tmp_path))
    assert opened.kept == Continuity()
    assert len(opened.notes) == 2


class FullDisk(FolderStorage):
    def create(self, name: str):  # type: ignore[no-untyped-def]
        raise OSError(28, "No space left on device")


def test_a_full_disk_leaves_what_was_kept(tmp_path: Path) -> None:
    ContinuityStore(FolderStorage(tmp_path)).keep(FIRST)
    full = ContinuityStore(FullDisk(tmp_path))
    full.keep(SECOND)
    assert not full.written
    assert full.kept == FIRST
    assert ContinuityStore(FolderStorage(tmp_path)).kept == FIRST


@pytest.mark.parametrize("key", ["waypoint", "starts", "mission"])
def test_numbers_out_of_range_are_no_copy(tmp_path: Path, key: str) -> None:
    """A sound hash over senseless numbers, as another version might write them."""
    ContinuityStore(FolderStorage(tmp_path)).keep(FIRST._replace(**{key: -1}))
    opened = ContinuityStore(FolderStorage(tmp_path))
    assert opened.kept == Continuity()
    assert key in opened.notes[0]


def test_a_pipe_in_the_place_of_a_copy_is_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / COPIES[0])
    opened = ContinuityStore(FolderStorage(tmp_path))
    assert opened.kept == Continuity()
    assert "is no regular file" in opened.notes[0]
