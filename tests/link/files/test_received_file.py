"""A file on its way to the disk. Oracle: the bytes that were handed over, killed and cut at every single write."""

import hashlib
import random
from pathlib import Path

import pytest

from stommel.link.files.folder_disk import FolderDisk
from stommel.link.files.received_file import (
    SYNC_AFTER,
    SYNC_BYTES,
    Identity,
    ReceivedFile,
    ReceivedFileError,
    WrongSumError,
    identity_on_disk,
)
from tests.link.files.fakes import MemoryDisk, noise

DATA = noise(5000)
IDENTITY = Identity("logs/a.log", len(DATA), hashlib.sha256(DATA).hexdigest())
SEGMENT = 244
PIECES = [(first, DATA[first : first + SEGMENT]) for first in range(0, len(DATA), SEGMENT)]


def receive(disk: MemoryDisk | FolderDisk, t: float = 0.0) -> list[int]:
    """Go on with the file, asking for what is missing; the places that were asked for."""
    file = ReceivedFile(disk, "a.log", IDENTITY)
    asked = []
    for first, last in file.missing:
        for at in range(first, last, SEGMENT):
            asked.append(at)
            file.write(at, DATA[at : min(at + SEGMENT, last)], t)
    file.finish()
    return asked


def write_all(file: ReceivedFile) -> None:
    for at, piece in PIECES:
        file.write(at, piece, 0.0)


def killed_after(writes: int, disk: MemoryDisk) -> bool:
    """Receive until the program dies at a write; whether it did."""
    disk.writes, disk.dies_after = 0, writes
    try:
        receive(disk)
    except KeyboardInterrupt:
        return True
    finally:
        disk.dies_after = None
    return False


def test_a_kill_at_any_write_costs_at_most_the_piece_in_hand() -> None:
    """mavlink/MAVSDK#2764: no resume after power-off."""
    writes = 0
    while True:
        disk = MemoryDisk()
        if not killed_after(writes, disk):
            break
        before = len(disk.files.get("a.log.part", disk.files.get("a.log", b"")))
        asked = receive(disk)
        assert disk.files["a.log"] == DATA
        assert set(disk.files) == {"a.log"}
        assert len(asked) * SEGMENT <= len(DATA) - before + 2 * SEGMENT
        writes += 1
    assert writes > 2 * len(PIECES)


@pytest.mark.parametrize("seed", range(3))
def test_a_power_cut_at_any_write_leaves_a_file_that_ends_whole(seed: int) -> None:
    draw = random.Random(seed)
    writes = 0
    while True:
        disk = MemoryDisk()
        if not killed_after(writes, disk):
            break
        # each file keeps what was synced, or all, or a torn end
        for name, data in tuple(disk.files.items()):
            kind = draw.choice(("synced", "all", "torn", "garbled"))
            synced = disk.synced.get(name, b"")
            if kind == "synced":
                disk.files[name] = bytearray(synced)
            elif kind == "torn":
                del data[draw.randint(len(synced), max(len(synced), len(data))) :]
            elif kind == "garbled" and len(data) > len(synced):
                at = draw.randrange(len(synced), len(data))
                data[at:] = bytes(len(data) - at)
        if "a.log" not in disk.files:
            receive(disk)
        assert disk.files["a.log"] == DATA
        writes += 1


def test_what_a_power_cut_takes_is_bounded_and_nothing_after_silence() -> None:
    data = noise(100_000, 3)
    disk, identity = MemoryDisk(), Identity("a", len(data), hashlib.sha256(data).hexdigest())
    file = ReceivedFile(disk, "a", identity)
    for at in range(0, 60_000, 240):
        file.write(at, data[at : at + 240], 0.0)
        lost = MemoryDisk()
        lost.files, lost.synced = {}, dict(disk.synced)
        lost.power_cut()
        assert ReceivedFile(lost, "a", identity).received.bytes >= at + 240 - SYNC_BYTES
    assert disk.syncs < 40, "not for every frame"
    file.rest(SYNC_AFTER)
    disk.power_cut()
    assert ReceivedFile(disk, "a", identity).received.bytes == 60_000


def test_bytes_that_the_disk_has_damaged_are_fetched_again() -> None:
    disk = MemoryDisk()
    file = ReceivedFile(disk, "a.log", IDENTITY)
    for at, piece in PIECES[:10]:
        file.write(at, piece, 0.0)
    file.close()
    disk.files["a.log.part"][700] ^= 1
    again = ReceivedFile(disk, "a.log", IDENTITY)
    assert again.damaged_bytes == SEGMENT
    assert next(iter(again.missing)) == (2 * SEGMENT, 3 * SEGMENT)
    disk.files["a.log.part.ranges"][-5] ^= 1
    assert receive(disk)[0] <= 2 * SEGMENT
    assert disk.files["a.log"] == DATA


def test_a_journal_of_garbage_is_none() -> None:
    draw = random.Random(1)
    for _ in range(200):
        disk = MemoryDisk()
        disk.files = {"a.log.part": bytearray(draw.randbytes(300)), "a.log.part.ranges": bytearray(draw.randbytes(99))}
        assert identity_on_disk(disk, "a.log") is None
        receive(disk)
        assert disk.files["a.log"] == DATA


def test_a_full_disk_is_named_and_the_part_is_kept() -> None:
    disk = MemoryDisk(room=3000)
    file = ReceivedFile(disk, "a.log", IDENTITY)
    with pytest.raises(
        ReceivedFileError, match=r"a.log: No space left on device; \d+ of 5000 bytes are kept in a.log.part"
    ):
        write_all(file)
    kept = file.received.bytes
    assert kept > 2000
    disk.room = None
    asked = receive(disk)
    assert asked[0] == kept
    assert disk.files["a.log"] == DATA


def test_another_file_than_was_begun_is_begun_anew() -> None:
    disk = MemoryDisk()
    file = ReceivedFile(disk, "a.log", IDENTITY)
    file.write(0, DATA[:SEGMENT], 0.0)
    assert identity_on_disk(disk, "a.log") == IDENTITY
    other = IDENTITY._replace(sha256="0" * 64)
    assert ReceivedFile(disk, "a.log", other).received.bytes == 0


def test_wrong_bytes_never_get_the_name() -> None:
    disk = MemoryDisk()
    file = ReceivedFile(disk, "a.log", IDENTITY)
    for at, piece in PIECES:
        file.write(at, piece if at else bytes(SEGMENT), 0.0)
    with pytest.raises(WrongSumError, match="sha256"):
        file.finish()
    assert "a.log" not in disk.files
    assert file.missing.bytes == len(DATA)
    receive(disk)
    assert disk.files["a.log"] == DATA


def test_not_whole_is_not_finished() -> None:
    with pytest.raises(ReceivedFileError, match="5000 of 5000 bytes are missing"):
        ReceivedFile(MemoryDisk(), "a.log", IDENTITY).finish()


def test_a_log_that_has_grown_takes_the_place_of_its_beginning_and_nothing_else_does() -> None:
    disk = MemoryDisk()
    disk.files["a.log"] = bytearray(DATA[:3000])
    receive(disk)
    assert disk.files["a.log"] == DATA
    disk.files["a.log"] = bytearray(b"something else")
    file = ReceivedFile(disk, "a.log", IDENTITY)
    for at, piece in PIECES:
        file.write(at, piece, 0.0)
    assert file.finish() == f"a-{IDENTITY.sha256[:8]}.log"
    assert disk.files["a.log"] == b"something else"


def test_an_empty_file_is_whole_at_once() -> None:
    disk = MemoryDisk()
    ReceivedFile(disk, "e", Identity("e", 0, hashlib.sha256().hexdigest())).finish()
    assert disk.files == {"e": b""}


def test_a_file_that_is_there_already_costs_nothing() -> None:
    disk = MemoryDisk()
    disk.files["a.log"] = bytearray(DATA)
    assert receive(disk) == []
    assert disk.files == {"a.log": DATA}


def test_a_size_that_cannot_be_is_refused() -> None:
    with pytest.raises(ReceivedFileError, match="size = 4294967295"):
        ReceivedFile(MemoryDisk(), "a", Identity("a", 0xFFFFFFFF, ""))


def test_a_folder_keeps_what_the_disk_in_memory_keeps(tmp_path: Path) -> None:
    folder = tmp_path / "new" / "folder"
    disk = FolderDisk(folder)
    file = ReceivedFile(disk, "a.log", IDENTITY)
    for at, piece in PIECES[3:9]:
        file.write(at, piece, 0.0)
    disk.close()
    asked = receive(FolderDisk(folder))
    assert len(asked) == len(PIECES) - 6
    assert (folder / "a.log").read_bytes() == DATA
    assert [path.name for path in folder.iterdir()] == ["a.log"]


def test_a_link_in_the_folder_is_not_followed(tmp_path: Path) -> None:
    target = tmp_path / "target"
    target.write_bytes(b"precious")
    folder = tmp_path / "f"
    disk = FolderDisk(folder)
    (folder / "a.log.part").symlink_to(target)
    with pytest.raises(ReceivedFileError, match="symbolic links"):
        receive(disk)
    assert target.read_bytes() == b"precious"
