"""Every store of the link whose disk fails for a while: it goes on by itself, and nobody has to do anything.

Oracle: what was told before and during the failure, and what a program finds that starts from the disk afterwards.
"""

import hashlib
import random

import pytest

from stommel.link.commands.client import CommandClient
from stommel.link.commands.ledger import Entry, Ledger, LedgerError
from stommel.link.commands.states import Command, Progress, State, When
from stommel.link.commands.table import START
from stommel.link.endings import Ending
from stommel.link.files.received_file import Identity, ReceivedFile, ReceivedFileError
from stommel.link.outbox import Outbox
from stommel.link.parameters.known import KnownParameters
from stommel.link.signing.refusals import Refusal
from stommel.link.signing.stamps import NAME, PER_SECOND, Stamps, stamp_of
from tests.link.commands.quay import SHORE, Quay
from tests.link.files.fakes import MemoryDisk
from tests.link.parameters.test_lists import joined, refreshed
from tests.link.parameters.vehicle import Vehicle
from tests.link.signing.ends import CLOCK, End, KeyDisk, keys_of, shore, talk, understand
from tests.onboard.coordination.failing_disk import CASES, NAMES, FailingDisk

PEER = (1, 1, 0)
LEAST = stamp_of(CLOCK)
failing = pytest.mark.parametrize("fault", CASES, ids=NAMES)


@failing
@pytest.mark.parametrize("begins_failing", [False, True])
def test_stamps(fault: tuple[str, int], begins_failing: bool) -> None:
    """None goes back and none is accepted twice, while the disk fails and after a restart when it is well again."""
    disk = FailingDisk()
    disk.fault = fault if begins_failing else None
    stamps, said, heard = Stamps(disk, LEAST, CLOCK, fresh=True), list[int](), list[int]()
    stamps.keep_now()

    def live(begin: int, end: int) -> None:
        for k in range(begin, end):
            said.append(stamps.next(float(k)))
            stamp = stamps.now(float(k)) + 1
            assert stamps.check(PEER, stamp, float(k)) is None
            stamps.accept(PEER, stamp, float(k))
            heard.append(stamp)

    live(0, 20)
    disk.fault = fault
    live(20, 100)
    assert disk.refused
    assert not stamps.written
    assert {stamps.check(PEER, stamp, 100.0) for stamp in heard} == {Refusal.REPLAYED}
    disk.fault = None
    live(100, 103)
    assert stamps.written
    assert said == sorted(set(said))
    again = Stamps(disk.found(), LEAST, 0.0, fresh=False)
    assert not again.in_doubt
    assert again.next(0.0) > said[-1]
    assert {again.check(PEER, stamp, 0.0) for stamp in heard} <= {Refusal.REPLAYED, Refusal.STALE}


@failing
def test_stamps_of_an_end_in_doubt(fault: tuple[str, int]) -> None:
    """Its proof comes while the disk fails: it is heard at once, and still after a restart."""
    boat, land = End(1, KeyDisk(keys_of(unused=False)), FailingDisk(), CLOCK), shore()
    talk(land, shore(), 0.0)
    assert isinstance(boat.disk, FailingDisk)
    assert boat.guard.in_doubt
    boat.disk.fault = fault
    recorded = land.say(1.0)
    t = talk(boat, land, 1.0, 12.0)
    assert understand(boat, land, t)
    assert boat.guard.alarm
    boat.disk.fault = None
    t = talk(boat, land, t, 40.0)
    assert not boat.guard.alarm
    boat.disk = boat.disk.found()
    boat.start(0.0)
    assert not boat.guard.in_doubt
    assert not boat.hears(recorded, t)
    assert understand(boat, land, talk(boat, land, t, 2.0))


@pytest.mark.parametrize("what", ["key file", "stamps", "both"])
def test_a_key_is_marked_as_used_when_its_file_can_be_written(what: str) -> None:
    """Unmarked, it would need no proof after a loss of the stamps, and recordings would be believed."""
    keys, disk = KeyDisk(keys_of()), FailingDisk()
    keys.broken = what != "stamps"
    disk.fault = None if what == "key file" else CASES[0]
    boat, land = End(1, keys, disk, CLOCK), shore()
    recorded = [land.say(0.1 * k) for k in range(5)]
    assert all(boat.hears(raw, 1.0) for raw in recorded)
    t = talk(boat, land, 1.0, 20.0)
    assert keys.read().unused
    assert boat.guard.alarm
    keys.broken, disk.fault = False, None
    t = talk(boat, land, t, 20.0)
    assert not keys.read().unused
    assert not boat.guard.alarm
    disk.remove(NAME)
    boat.start(CLOCK)
    assert not any(boat.hears(raw, t) for raw in recorded)


def test_a_new_key_is_committed_when_its_file_can_be_written() -> None:
    boat, land = End(1, KeyDisk(keys_of()), FailingDisk(), CLOCK), shore()
    t = talk(boat, land, 0.0)
    land.offer.start(t)
    for _ in range(30):
        t = talk(boat, land, t, 1.0)
        land.keys.broken = land.guard.keys is not None and land.guard.keys.next is not None
        if land.guard.peer_has_next:
            break
    assert land.guard.peer_has_next
    t = talk(boat, land, t, 20.0)
    assert land.keys.read().next is not None
    land.keys.broken = False
    talk(boat, land, t, 20.0)
    assert land.keys.read().next is None
    assert land.keys.read().current == boat.keys.read().current


@failing
def test_commands_ashore(fault: tuple[str, int]) -> None:
    """The last word of a command comes while the disk fails; nobody gives another one."""
    quay, disk = Quay(), FailingDisk()
    quay.shore_disk = disk
    quay.start_shore()
    quay.port.outcome = Progress(State.IN_PROGRESS, 0)
    id = quay.give("start")
    quay.run(2.0)
    disk.fault = fault
    quay.port.running[id] = Progress(State.DONE)
    quay.run(15.0)
    assert quay.state(id) is State.DONE
    assert [note for note in quay.client.notes if "cannot be kept" in note]
    disk.fault = None
    quay.run(15.0)
    assert quay.client.notes == []
    quay.shore_disk = disk.found()
    quay.start_shore()
    assert quay.state(id) is State.DONE, "the vehicle need not be asked"


@failing
def test_an_abort_that_no_disk_kept(fault: tuple[str, int]) -> None:
    """It is said all the same, and kept when the disk takes it."""
    disk = FailingDisk()
    client = CommandClient(*SHORE, 3, disk, random.Random(1), 1.8e9)
    disk.fault = fault
    id = client.abort(1.8e9, valid_for=600.0)
    client.poll(1.8e9, outbox := Outbox())
    assert outbox.waiting
    disk.fault = None
    client.poll(1.8e9 + 20.0, Outbox())
    assert [report.id for report in CommandClient(*SHORE, 3, disk.found(), random.Random(1), 1.8e9).reports(1.8e9)] == [
        id
    ]


@failing
def test_the_ledger_aboard(fault: tuple[str, int]) -> None:
    """What it does not keep is not executed; the same command is taken when the disk is well."""
    disk = FailingDisk()
    ledger = Ledger(disk)
    command = Command(7, START, (), When.UNTIL_EXPIRY, 1000, 900_000)
    disk.fault = fault
    for _ in range(3):
        with pytest.raises(LedgerError, match="disk does not keep it"):
            ledger.put([Entry(command, Progress(State.WAITING))], 2000)
        assert ledger.get(7) is None
    disk.fault = None
    ledger.put([Entry(command, Progress(State.WAITING))], 2000)
    assert Ledger(disk.found()).get(7) == ledger.get(7)


@failing
def test_parameters_ashore(fault: tuple[str, int]) -> None:
    disk = FailingDisk()
    client, line = joined(Vehicle(), KnownParameters(1, disk))
    disk.fault = fault
    assert set(refreshed(client, line).values()) == {Ending.WHOLE}
    assert len(client.known.notes) == 1
    assert KnownParameters(1, disk.found()).sets == {}
    for after in (1.0, 12.0, 24.0):
        client.poll(line.t + after, Outbox())
    assert len(client.known.notes) == 1
    disk.fault = None
    client.poll(line.t + 36.0, Outbox())
    assert client.known.notes == []
    assert set(KnownParameters(1, disk.found()).sets) == set(client.known.sets)


def test_a_file_that_is_received() -> None:
    """What did not fit is missing, and is taken when there is room; a new program asks for nothing that is there."""
    content = random.Random(1).randbytes(50_000)
    identity = Identity("log/1", len(content), hashlib.sha256(content).hexdigest())
    disk = MemoryDisk(room=20_000)
    file = ReceivedFile(disk, "1", identity)
    refused = 0
    for offset in range(0, len(content), 1000):
        try:
            file.write(offset, content[offset : offset + 1000], 0.0)
        except ReceivedFileError:
            refused += 1
    assert 30 <= refused < 40
    disk.room = None
    file.close()
    file = ReceivedFile(disk, "1", identity)
    assert file.missing.bytes == 1000 * refused
    for gap in list(file.missing):
        file.write(gap.first, content[gap.first : gap.last], 1.0)
    assert file.finish() == "1"
    assert bytes(disk.files["1"]) == content


def test_a_block_of_stamps_is_not_passed_while_the_disk_fails() -> None:
    """Told, but not refused: with stamps in memory the vehicle can be brought home; `alarm` says so all the time."""
    disk = FailingDisk()
    stamps = Stamps(disk, LEAST, CLOCK, fresh=True)
    stamps.keep_now()
    disk.fault = CASES[0]
    last = [stamps.next(float(t)) for t in range(0, 100, 7)][-1]
    assert last >= LEAST + 90 * PER_SECOND
    assert not stamps.written
