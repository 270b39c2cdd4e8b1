"""The vehicle's inbox. Oracle: its room, and what was put into it."""

import hashlib

import pytest

from stommel.link.files.port import FileRefusalError
from stommel.onboard.radio.files import MOST_INBOX, VehicleFiles
from tests.link.files.fakes import MemoryDisk

HALF = MOST_INBOX // 2 + 1000
CONTENT = bytes(range(251)) * (HALF // 251 + 1)
SUM = hashlib.sha256(CONTENT).digest()


def begun(disk: MemoryDisk, name: str, count: int) -> None:
    part = VehicleFiles(disk, dict).receive(("inbox", name), len(CONTENT), SUM)
    part.write(0, CONTENT[:count], 0.0)
    part.close()


def test_a_file_that_has_come_by_half_goes_on_though_it_takes_most_of_the_inbox() -> None:
    """What has come of it is no other file that stands in its way."""
    disk = MemoryDisk()
    begun(disk, "long.bin", len(CONTENT) - 10)
    files = VehicleFiles(disk, dict)
    part = files.receive(("inbox", "long.bin"), len(CONTENT), SUM)
    assert part.missing.bytes == 10
    part.write(len(CONTENT) - 10, CONTENT[-10:], 1.0)
    part.finish()
    assert files.read(("inbox", "long.bin"), 0, len(CONTENT)) == CONTENT


def test_what_nobody_goes_on_with_is_named_where_it_is_in_the_way_and_can_be_removed() -> None:
    disk = MemoryDisk()
    begun(disk, "left.bin", len(CONTENT))
    files = VehicleFiles(disk, dict)
    with pytest.raises(
        FileRefusalError, match=r"has room for \d+ bytes, not \d+; begun there, and not whole: left.bin$"
    ):
        files.receive(("inbox", "new.bin"), len(CONTENT), SUM)
    assert list(files.entries(("inbox",))) == []
    files.remove(("inbox", "left.bin"))
    assert disk.files == {}
    files.receive(("inbox", "new.bin"), len(CONTENT), SUM)


def test_removing_a_file_removes_what_has_come_of_its_next_edition_too() -> None:
    disk = MemoryDisk()
    disk.write("a.txt", 0, b"old")
    begun(disk, "a.txt", 20)
    files = VehicleFiles(disk, dict)
    files.remove(("inbox", "a.txt"))
    assert disk.files == {}
    with pytest.raises(FileRefusalError, match="there is no such file"):
        files.remove(("inbox", "a.txt"))
    with pytest.raises(FileRefusalError):
        files.remove(("log", "a.txt"))
