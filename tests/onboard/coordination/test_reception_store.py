"""A mission on its way outlives a restart. Oracle: the bytes that were sent, and which were taken before the cut.

Every write and every operation of a simulated disk is cut; of what was not synced, all is found, or a part, or zeros.
"""

import hashlib
import random
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from stommel.files.folder_storage import FolderStorage
from stommel.onboard.coordination.stores.missions import MissionStore
from stommel.onboard.coordination.stores.piece_file import announcement, piece, read_pieces
from stommel.onboard.coordination.stores.reception import ReceptionError
from stommel.onboard.coordination.stores.reception_store import ReceptionStore
from tests.onboard.coordination.disk import Disk, PowerCutError
from tests.onboard.coordination.test_mission_store import LIMITS, NEW, OLD, held, holding, send

TEXT = bytes(random.Random(1).randbytes(300))
OTHER = bytes(random.Random(2).randbytes(200))
SIZE = 40
"""Of a piece."""


def announce(store: ReceptionStore, text: bytes) -> None:
    store.announce(len(text), hashlib.sha256(text).hexdigest())


def pieces(text: bytes) -> Iterator[tuple[int, bytes]]:
    """In no order, some overlapping."""
    offsets = list(range(0, len(text), SIZE))
    random.Random(3).shuffle(offsets)
    return ((offset, text[offset : offset + SIZE + 7]) for offset in offsets)


def begun(count: int) -> Disk:
    """A disk on which so many pieces have come before a restart."""
    disk = Disk()
    store = ReceptionStore(disk)
    announce(store, TEXT)
    for _, one in zip(range(count), pieces(TEXT), strict=False):
        store.take(*one)
    return disk


def places(store: ReceptionStore) -> set[int]:
    """Bytes that are held, each of them right."""
    if store.reception is None:
        return set()
    found = set()
    for offset, run in store.reception.held:
        assert TEXT[offset : offset + len(run)] == run
        found |= set(range(offset, offset + len(run)))
    missing = {byte for first, last in store.reception.missing for byte in range(first, last)}
    assert missing == set(range(len(TEXT))) - found
    return found


def receive(disk: Disk, sent: set[int]) -> None:
    """Go on with the mission; what is on the disk for sure is told in `sent`."""
    store = ReceptionStore(disk)
    announce(store, TEXT)
    for offset, data in pieces(TEXT):
        store.take(offset, data)
        sent |= set(range(offset, offset + len(data)))


@pytest.mark.parametrize("keeps_unsynced", [True, False])
@pytest.mark.parametrize("before", [0, 3])
@pytest.mark.parametrize("unit", ["bytes_left", "operations_left"])
def test_power_cut_at_every_byte_leaves_what_had_come(unit: str, before: int, keeps_unsynced: bool) -> None:
    """Before anything has come, and after a restart, when all goes into a new file."""
    cuts = 0
    for left in range(2000):
        disk = begun(before)
        sent = places(ReceptionStore(disk))
        setattr(disk, unit, left)
        try:
            receive(disk, sent)
        except PowerCutError:
            cuts += 1
        else:
            break
        for seed in range(3):
            found = disk.after_power_cut(random.Random(seed), keeps_unsynced)
            store = ReceptionStore(found)
            assert places(store) >= sent, (left, seed)
            announce(store, TEXT)
            assert places(store) >= sent
            for one in pieces(TEXT):
                store.take(*one)
            assert store.whole() == TEXT
            assert ReceptionStore(found).whole() == TEXT
            assert len(found.files) == 1, "files pile up"
    assert cuts > (len(TEXT) if unit == "bytes_left" else 15)


@pytest.mark.parametrize("unit", ["bytes_left", "operations_left"])
def test_power_cut_in_another_announcement_leaves_the_one_or_the_other(unit: str) -> None:
    seen = set()
    for left in range(200):
        disk = begun(9)
        setattr(disk, unit, left)
        store = None
        try:
            store = ReceptionStore(disk)
            announce(store, OTHER)
            store.take(0, OTHER[:SIZE])
            cut = False
        except PowerCutError:
            cut = True
        for seed in range(3):
            found = ReceptionStore(disk.after_power_cut(random.Random(seed), keeps_unsynced=bool(seed)))
            assert found.reception is not None
            seen.add(found.reception.sha256)
            if found.reception.size == len(TEXT):
                assert cut
                assert found.whole() == TEXT
            elif not cut:
                assert found.reception.held == [(0, OTHER[:SIZE])]
        if not cut:
            break
    assert not cut
    assert seen == {hashlib.sha256(text).hexdigest() for text in (TEXT, OTHER)}


def test_a_mission_goes_on_after_a_restart_of_the_vehicle() -> None:
    disk = holding(OLD)
    store = MissionStore(disk, LIMITS)
    sha256 = hashlib.sha256(NEW).hexdigest()
    store.announce(len(NEW), sha256)
    store.take(100, NEW[100:300])
    store = MissionStore(disk, LIMITS)
    assert (store.announced, store.missing) == ((len(NEW), sha256), [(0, 100), (300, len(NEW))])
    store.announce(len(NEW), sha256)
    store.take(0, NEW[:100])
    store = MissionStore(disk, LIMITS)  # without another announcement
    store.take(300, NEW[300:])
    assert store.switch().header.mission == "new"
    assert (store.announced, store.missing) == (None, [])
    assert held(MissionStore(disk, LIMITS)) == ("new", "old")
    assert sorted(disk.files) == ["mission-000001.orders", "mission-000002.orders"]


def test_what_was_switched_is_not_received_again() -> None:
    """The power goes between the switch and the end of the reception."""
    disk = holding(OLD)
    store = MissionStore(disk, LIMITS)
    send(store, NEW)
    kept = {name: bytes(content.data) for name, content in disk.files.items() if "reception" in name}
    store.switch()
    again = Disk({name: bytes(content.data) for name, content in disk.files.items()} | kept)
    store = MissionStore(again, LIMITS)
    assert (store.announced, held(store)) == (None, ("new", "old"))
    assert not any("reception" in name for name in again.files)


def test_every_damaged_byte_costs_pieces_and_lets_no_wrong_one_in() -> None:
    disk = begun(9)
    (name,) = disk.files
    whole = bytes(disk.files[name].data)
    for k in range(len(whole)):
        damaged = bytearray(whole)
        damaged[k] ^= 1 << k % 8
        store = ReceptionStore(Disk({name: bytes(damaged)}))
        assert len(places(store)) < len(TEXT)


def test_pieces_of_another_mission_in_the_same_place_are_not_taken() -> None:
    """A block of an older file, left by a disk that lost power: its checksum begins from another announcement."""
    ours, theirs = (hashlib.sha256(text).hexdigest() for text in (TEXT, OTHER))
    content = announcement(len(TEXT), ours) + piece(len(TEXT), ours, 0, TEXT[:9])
    read = read_pieces(content + piece(len(OTHER), theirs, 9, OTHER[9:20]))
    assert read is not None
    assert (read.size, read.sha256, read.pieces) == (len(TEXT), ours, ((0, TEXT[:9]),))


def test_bytes_that_come_again_take_no_room() -> None:
    disk = begun(9)
    before = sum(len(content.data) for content in disk.files.values())
    store = ReceptionStore(disk)
    for offset in range(len(TEXT)):
        store.take(offset, TEXT[offset:])
    assert sum(len(content.data) for content in disk.files.values()) == before


def test_a_wrong_whole_is_forgotten_also_after_a_restart() -> None:
    disk = Disk()
    store = ReceptionStore(disk)
    announce(store, TEXT)
    store.take(0, TEXT[:-1] + b"#")
    with pytest.raises(ReceptionError, match="send it again"):
        store.whole()
    again = ReceptionStore(disk)
    assert again.reception is not None
    assert again.reception.missing == [(0, len(TEXT))]
    again.take(0, TEXT)
    assert ReceptionStore(disk).whole() == TEXT


@pytest.mark.parametrize("room", [0, 10, 60, 100, 200])
def test_a_full_disk_keeps_the_reception_in_memory_until_there_is_room(room: int) -> None:
    disk = Disk()
    disk.room = room
    store = ReceptionStore(disk)
    announce(store, TEXT)
    for one in pieces(TEXT[:200]):
        store.take(*one)
    assert not store.written
    disk.room = None
    store.take(200, TEXT[200:])
    assert store.written
    assert store.whole() == ReceptionStore(disk).whole() == TEXT
    assert len(disk.files) == 1


def broken(disk: Disk) -> None:
    disk.broken = True


FILES: dict[str, Callable[[Disk], None]] = {
    "broken disk": broken,
    "no file of ours": lambda disk: disk.files.update(Disk({"reception-000004.pieces": b"hello"}).files),
    "a size beyond all": lambda disk: disk.files.update(
        Disk({"reception-000004.pieces": announcement(1 << 30, "0" * 64)}).files
    ),
}


@pytest.mark.parametrize("name", FILES)
def test_what_cannot_be_read_is_as_if_nothing_had_come(name: str) -> None:
    disk = Disk()
    FILES[name](disk)
    store = ReceptionStore(disk)
    assert store.reception is None
    announce(store, TEXT)
    store.take(0, TEXT)
    assert store.whole() == TEXT
    assert store.written == (name != "broken disk")


def test_a_folder_of_the_system_keeps_it(tmp_path: Path) -> None:
    store = ReceptionStore(FolderStorage(tmp_path))
    announce(store, TEXT)
    store.take(0, TEXT[:100])
    store = ReceptionStore(FolderStorage(tmp_path))
    store.take(100, TEXT[100:])
    assert ReceptionStore(FolderStorage(tmp_path)).whole() == TEXT
    store.discard()
    assert list(tmp_path.iterdir()) == []
