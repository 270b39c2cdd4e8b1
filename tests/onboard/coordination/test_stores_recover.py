"""Every store aboard whose disk fails for a while: it goes on by itself when the disk is well again.

Oracle: what was told, and what a program finds that starts from the disk afterwards. The log has its own tests.
"""

import hashlib

import pytest

from stommel.messages.parameters import Parameter, ParameterServer, ParameterType, read_stored
from stommel.onboard.coordination.logbook.framing import LogIdentity
from stommel.onboard.coordination.logbook.logbook import Logbook, LogSettings
from stommel.onboard.coordination.stores.continuity import Continuity, ContinuityStore
from stommel.onboard.coordination.stores.missions import MissionStore, MissionStoreError
from tests.onboard.coordination.failing_disk import CASES, NAMES, FailingDisk
from tests.onboard.coordination.test_mission_store import LIMITS, NEW, OLD, held, send

failing = pytest.mark.parametrize("fault", CASES, ids=NAMES)


def holding(*texts: bytes) -> FailingDisk:
    disk = FailingDisk()
    for text in texts:
        send(store := MissionStore(disk, LIMITS), text)
        store.switch()
    return disk


@failing
def test_where_the_software_was(fault: tuple[str, int]) -> None:
    disk = FailingDisk()
    store = ContinuityStore(disk)
    store.keep(Continuity(starts=1))
    disk.fault = fault
    for k in range(5):
        store.keep(Continuity(starts=1, waypoint=k))
    assert not store.written
    assert ContinuityStore(disk.found()).kept == Continuity(starts=1)
    disk.fault = None
    store.keep(Continuity(starts=1, waypoint=4))
    assert store.written
    assert ContinuityStore(disk.found()).kept == Continuity(starts=1, waypoint=4)


@failing
def test_a_mission_that_comes(fault: tuple[str, int]) -> None:
    """Its pieces come while the disk fails, and the order to fly it when the disk is well."""
    disk = holding(OLD)
    store = MissionStore(disk, LIMITS)
    disk.fault = fault
    store.announce(len(NEW), hashlib.sha256(NEW).hexdigest())
    for offset in range(0, len(NEW), 200):
        store.take(offset, NEW[offset : offset + 200])
    with pytest.raises(MissionStoreError, match="cannot be kept"):
        store.switch()
    assert held(store) == held(MissionStore(disk.found(), LIMITS)) == ("old", None)
    disk.fault = None
    store.switch()
    assert held(store) == held(MissionStore(disk.found(), LIMITS)) == ("new", "old")


@failing
def test_a_mission_half_of_which_comes(fault: tuple[str, int]) -> None:
    """The half that came while the disk failed is on the disk with the next piece."""
    disk = holding(OLD)
    store = MissionStore(disk, LIMITS)
    disk.fault = fault
    store.announce(len(NEW), hashlib.sha256(NEW).hexdigest())
    store.take(0, NEW[:500])
    disk.fault = None
    store.take(500, NEW[500:600])
    assert MissionStore(disk.found(), LIMITS).missing == [(600, len(NEW))]


@failing
def test_when_a_mission_began(fault: tuple[str, int]) -> None:
    """The time that was told first is kept, when it can be; its end does not move by a restart."""
    disk = holding(OLD)
    store = MissionStore(disk, LIMITS)
    disk.fault = fault
    with pytest.raises(MissionStoreError, match="its start cannot be kept"):
        store.start(1000.0)
    assert not store.start_is_kept
    assert store.expires == 1000.0 + 48 * 3600.0
    disk.fault = None
    store.start(5000.0)
    assert store.start_is_kept
    assert MissionStore(disk.found(), LIMITS).expires == 1000.0 + 48 * 3600.0


@failing
def test_the_log(fault: tuple[str, int]) -> None:
    """What fits into memory is written when the disk is well, none is dropped, and the log says what was."""
    disk = FailingDisk()
    log = Logbook(disk, LogSettings(), LogIdentity("1", 2, "zju", 0.0), 0.0)
    log.event(0.0, "a")
    log.step(0.0)
    disk.fault = fault
    for t in range(1, 60):
        log.event(float(t), "b")
        log.step(float(t))
    # names alone need no new file
    assert log.blocked or fault[0] in ("create", "rename")
    disk.fault = None
    for t in range(60, 90):
        log.step(float(t))
    log.sync(90.0)
    assert not log.blocked
    counts = log.counts["essential"]
    assert counts.dropped == 0
    assert counts.committed == counts.taken


def test_parameters_of_a_node() -> None:
    """Saved again, they are there; and the copy before was never touched."""

    class Failing:
        def __init__(self) -> None:
            self.copies: list[bytes | None] = [None, None]
            self.fails = False

        def read(self, copy: int) -> bytes | None:
            return self.copies[copy]

        def write(self, copy: int, content: bytes) -> None:
            if self.fails:
                raise OSError(*CASES[0][1:], "No space left on device")
            self.copies[copy] = content

    store = Failing()
    kinds = [Parameter(0, "A", ParameterType.int32, 1, 0, 9)]
    node = ParameterServer(kinds, store)
    assert node.save() == "Ok"
    node.write(0, 5)
    store.fails = True
    assert [node.save() for _ in range(3)] == ["NotSaved"] * 3
    assert ParameterServer(kinds, store)["A"] == 1
    store.fails = False
    assert node.save() == "Ok"
    assert ParameterServer(kinds, store)["A"] == 5
    assert all(read_stored(copy) for copy in store.copies if copy is not None)
