"""What the shore sees of the vehicle's files, and what it may do to them."""

import hashlib

import pytest

from stommel.link.files.port import Entry, FileRefusalError, FtpError
from stommel.messages.database import database_hash
from stommel.onboard.coordination.logbook.framing import LogIdentity
from stommel.onboard.coordination.logbook.logbook import Logbook, LogSettings
from stommel.onboard.radio.files import MOST_INBOX, VehicleFiles
from stommel.sitl.faults.disk import MemoryDisk
from stommel.sitl.radio.memory_folder import MemoryFolder


@pytest.fixture
def disk() -> MemoryDisk:
    return MemoryDisk()


@pytest.fixture
def logbook(disk: MemoryDisk) -> Logbook:
    settings = LogSettings(total_bytes=400_000, file_bytes=16_384)
    return Logbook(disk, settings, LogIdentity("test", database_hash(), "test", 0.0), 0.0)


@pytest.fixture
def files(logbook: Logbook) -> VehicleFiles:
    return VehicleFiles(MemoryFolder(), lambda: {"active.orders": b"orders"}, logbook)


def filled(logbook: Logbook) -> None:
    """Write so much that at least one file of the log is finished."""
    for second in range(2000):
        logbook.event(float(second), "test", "x" * 40)
        logbook.step(float(second))


def test_root_and_folders_are_listed(files: VehicleFiles, disk: MemoryDisk, logbook: Logbook) -> None:
    filled(logbook)
    assert files.entries(()) == [Entry(name, 0, True) for name in ("inbox", "log", "missions")]
    assert files.entries(("missions",)) == [Entry("active.orders", 6, False)]
    assert {entry.name: entry.size for entry in files.entries(("log",))} == disk.sizes()


def test_a_log_file_reads_as_it_is_on_the_disk(files: VehicleFiles, disk: MemoryDisk, logbook: Logbook) -> None:
    filled(logbook)
    name = min(disk.sizes())
    content = disk.read(name)
    assert files.read(("log", name), 0, len(content)) == content
    assert files.read(("log", name), 100, 50) == content[100:150]
    assert files.read(("log", name), len(content) + 5, 50) == b""


def test_a_file_that_grows_reads_on(files: VehicleFiles, disk: MemoryDisk, logbook: Logbook) -> None:
    logbook.event(0.0, "test", "one")
    logbook.step(0.0)
    (name,) = [name for name in disk.sizes() if "essential" in name]
    before = files.size(("log", name))
    assert files.read(("log", name), 0, before) == disk.read(name)
    logbook.event(1.0, "test", "two")
    logbook.step(10.0)
    assert files.size(("log", name)) > before
    assert files.read(("log", name), before, 1000) == disk.read(name)[before:]


def test_a_released_log_file_is_marked_as_sent_and_one_that_is_written_is_not(
    files: VehicleFiles, disk: MemoryDisk, logbook: Logbook
) -> None:
    filled(logbook)
    finished = logbook.finished()[0][0].text
    files.release(("log", finished))
    assert finished not in disk.sizes()
    assert finished.replace(".log", ".sent.log") in disk.sizes()
    written = max(name for name in disk.sizes() if "essential" in name)
    with pytest.raises(FileRefusalError, match="still being written"):
        files.release(("log", written))


@pytest.mark.parametrize(
    "path", [("log", "a.log"), ("missions", "active.orders"), ("other", "a"), ("inbox",), ("inbox", "a", "b"), ("a",)]
)
def test_nothing_is_written_outside_of_the_inbox(files: VehicleFiles, path: tuple[str, ...]) -> None:
    for act in (lambda: files.stage(path, from_old=False), lambda: files.receive(path, 5, bytes(32))):
        with pytest.raises(FileRefusalError) as error:
            act()
        assert error.value.code is FtpError.FILE_PROTECTED


def test_missions_and_logs_are_not_removed_for_who_has_proved_nothing(
    files: VehicleFiles, disk: MemoryDisk, logbook: Logbook
) -> None:
    filled(logbook)
    for path in (("log", min(disk.sizes())), ("missions", "active.orders")):
        with pytest.raises(FileRefusalError):
            files.remove(path)
    with pytest.raises(FileRefusalError):
        files.release(("missions", "active.orders"))


def test_the_inbox_takes_reads_renames_and_removes(files: VehicleFiles) -> None:
    staged = files.stage(("inbox", "a.txt"), from_old=False)
    staged.write(3, b"def")
    staged.write(0, b"abc")
    assert files.entries(("inbox",)) == []
    staged.commit()
    assert files.read(("inbox", "a.txt"), 0, 10) == b"abcdef"
    files.rename(("inbox", "a.txt"), ("inbox", "b.txt"))
    assert files.entries(("inbox",)) == [Entry("b.txt", 6, False)]
    files.remove(("inbox", "b.txt"))
    assert files.entries(("inbox",)) == []


def test_a_received_file_stands_only_with_its_hash(files: VehicleFiles) -> None:
    content = b"abcdef"
    part = files.receive(("inbox", "a.txt"), 6, hashlib.sha256(content).digest())
    part.write(0, b"abcdeX", 0.0)
    with pytest.raises(FileRefusalError):
        part.finish()
    assert files.entries(("inbox",)) == []
    part.write(0, content, 1.0)
    part.finish()
    assert files.read(("inbox", "a.txt"), 0, 10) == content


def test_the_inbox_is_bounded(files: VehicleFiles) -> None:
    with pytest.raises(FileRefusalError, match=str(MOST_INBOX)):
        files.receive(("inbox", "a"), MOST_INBOX + 1, bytes(32))
    staged = files.stage(("inbox", "a"), from_old=False)
    with pytest.raises(FileRefusalError):
        staged.write(MOST_INBOX, b"x")
    with pytest.raises(FileRefusalError):
        staged.truncate(1 << 40)
