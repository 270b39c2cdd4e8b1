"""Files to the vehicle, releases and lists. Oracle: what stands aboard."""

import hashlib
import random

import pytest

from stommel.link.channel.settings import ChannelSettings
from stommel.link.files.download import Download
from stommel.link.files.listing import Listing
from stommel.link.files.loss import MOST_SEGMENT
from stommel.link.files.progress import State
from stommel.link.files.received_file import Identity
from stommel.link.files.release import Release
from stommel.link.files.server import FileServer
from stommel.link.files.upload import Upload
from stommel.link.outbox import Outbox
from stommel.link.service import Received
from stommel.link.traffic import Traffic
from tests.link.files.fakes import MemoryDisk, MemoryFiles, noise
from tests.link.files.pair import SHORE, VEHICLE, Pair, is_over

DATA = noise(20_000, 31)
CLEAN = ChannelSettings(whole_frames=True)


class Count:
    """Counts what arrives."""

    arrived = 0

    def take(self, received: Received, t: float) -> None:
        if received.name == "FILE_DATA":
            self.arrived += int(received.values["length"])  # type: ignore[arg-type]

    def poll(self, t: float, outbox: Outbox) -> None:
        pass


def identity(data: bytes, path: str = "logs/a.log") -> Identity:
    return Identity(path, len(data), hashlib.sha256(data).hexdigest())


@pytest.mark.parametrize("loss", [0.0, 0.4])
def test_a_file_arrives_aboard(loss: float) -> None:
    files, pair = MemoryFiles(), Pair(ChannelSettings(latency=0.5, loss=loss, whole_frames=True))
    upload = Upload(SHORE, VEHICLE, DATA, "missions/m.orders")
    pair.serve(FileServer(*VEHICLE, files))
    pair.ask(upload)
    assert pair.run(is_over((upload,)), 100.0)
    assert upload.state is State.WHOLE
    assert files["missions/m.orders"] == DATA
    assert upload.progress.share == 1.0


def test_any_one_packet_may_be_lost() -> None:
    from tests.link.files.test_download import drop

    data = noise(1500, 32)
    for end in range(2):
        for lost in range(12):
            files, pair = MemoryFiles(), Pair(CLEAN)
            drop(pair, end, lost)
            upload = Upload(SHORE, VEHICLE, data, "missions/m")
            pair.serve(FileServer(*VEHICLE, files))
            pair.ask(upload)
            assert pair.run(is_over((upload,)), 30.0)
            assert upload.state is State.WHOLE
            assert files["missions/m"] == data


def test_an_upload_goes_on_after_both_ends_were_killed() -> None:
    """mavlink/MAVSDK#2764: no resume after power-off."""
    draw = random.Random(3)
    files, pair = MemoryFiles(), Pair(ChannelSettings(bit_rate=9600.0, loss=0.1, whole_frames=True))
    uploads, count = [Upload(SHORE, VEHICLE, DATA, "missions/m")], Count()
    pair.serve(FileServer(*VEHICLE, files), count)
    pair.ask(uploads[-1])
    kills = 0
    while not pair.run(lambda: uploads[-1].state.is_over, draw.uniform(4.0, 9.0)):
        kills += 1
        if kills % 2:
            pair.serve(FileServer(*VEHICLE, files), count)
        else:
            uploads.append(Upload(SHORE, VEHICLE, DATA, "missions/m"))
            pair.ask(uploads[-1])
    assert uploads[-1].state is State.WHOLE
    assert kills >= 3
    assert files["missions/m"] == DATA
    assert count.arrived - len(DATA) <= kills * 5 * MOST_SEGMENT, "what was on its way to a dead end"


def test_what_the_vehicle_refuses_is_said_with_its_reason() -> None:
    files, pair = MemoryFiles(), Pair(CLEAN)
    pair.serve(FileServer(*VEHICLE, files))
    upload = Upload(SHORE, VEHICLE, DATA, "logs/a.log")
    pair.ask(upload)
    assert pair.run(is_over((upload,)), 30.0)
    assert upload.state is State.REFUSED
    assert "data of the vehicle" in upload.reason
    files.refuse_received = "mission: waypoint 3 lies on land"
    upload = Upload(SHORE, VEHICLE, DATA, "missions/m")
    pair.ask(upload)
    assert pair.run(is_over((upload,)), 30.0)
    assert (upload.state, upload.reason) == (State.REFUSED, "mission: waypoint 3 lies on land")
    assert ("missions", "m") not in files.files


def test_a_full_disk_aboard_is_said() -> None:
    files, pair = MemoryFiles(), Pair(CLEAN)
    files.disk.room = 5000
    pair.serve(FileServer(*VEHICLE, files))
    upload = Upload(SHORE, VEHICLE, DATA, "missions/m")
    pair.ask(upload)
    assert pair.run(is_over((upload,)), 30.0)
    assert upload.state is State.REFUSED
    assert "No space left on device" in upload.reason


def test_no_answer_is_a_failure_within_its_time() -> None:
    pair = Pair(CLEAN)
    upload = Upload(SHORE, VEHICLE, DATA, "missions/m", patience=20.0)
    release = Release(SHORE, VEHICLE, identity(DATA), patience=20.0)
    listing = Listing(SHORE, VEHICLE, "/", patience=20.0)
    pair.ask(upload, release, listing)
    assert pair.run(is_over((upload, release, listing)), 25.0)
    assert {service.state for service in (upload, release, listing)} == {State.FAILED}
    assert release.reason == "logs/a.log: no answer for 20 s; it may still be aboard"
    assert pair.channel.shore.counts.packets < 40


@pytest.mark.parametrize("loss", [0.0, 0.4])
def test_a_release_deletes_what_is_whole_ashore_and_nothing_else(loss: float) -> None:
    files = MemoryFiles({"logs/a.log": DATA, "logs/b.log": DATA, "logs/c.log": DATA})
    pair = Pair(ChannelSettings(loss=loss, whole_frames=True))
    pair.serve(FileServer(*VEHICLE, files))
    other = bytes(len(DATA))
    releases = (
        Release(SHORE, VEHICLE, identity(DATA)),
        Release(SHORE, VEHICLE, identity(other, "logs/b.log")),
        Release(SHORE, VEHICLE, identity(DATA[:-1], "logs/c.log")),
        Release(SHORE, VEHICLE, identity(DATA, "missions/../logs/b.log")),
    )
    pair.ask(*releases)
    assert pair.run(is_over(releases), 60.0)
    assert [release.state for release in releases] == [State.WHOLE, *[State.REFUSED] * 3]
    assert releases[1].reason == "logs/b.log: another SHA-256: not deleted"
    assert releases[2].reason == "has 20000 bytes, not 19999: not deleted"
    assert set(files.files) == {("logs", "b.log"), ("logs", "c.log")}


def test_a_release_whose_answer_was_lost_is_a_release() -> None:
    from tests.link.files.test_download import drop

    files, pair = MemoryFiles({"logs/a.log": DATA}), Pair(CLEAN)
    drop(pair, 0, 0)
    pair.serve(FileServer(*VEHICLE, files))
    release = Release(SHORE, VEHICLE, identity(DATA))
    pair.ask(release)
    assert pair.run(is_over((release,)), 30.0)
    assert release.state is State.WHOLE
    assert not files.files


@pytest.mark.parametrize("loss", [0.0, 0.4])
def test_a_folder_is_listed(loss: float) -> None:
    names = {f"logs/dive-{k:04}.log": bytes(k) for k in range(50)}
    files, pair = MemoryFiles(names), Pair(ChannelSettings(loss=loss, whole_frames=True))
    pair.serve(FileServer(*VEHICLE, files))
    listing, none = Listing(SHORE, VEHICLE, "/logs"), Listing(SHORE, VEHICLE, "/none")
    pair.ask(listing)
    assert pair.run(is_over((listing,)), 100.0)
    assert listing.state is State.WHOLE
    assert [(entry.name, entry.size) for entry in listing.entries] == [(f"dive-{k:04}.log", k) for k in range(50)]
    pair.ask(none)
    assert pair.run(is_over((none,)), 100.0)
    assert (none.state, none.reason) == (State.REFUSED, "/none: file not found")


def test_a_file_that_was_removed_aboard_is_sent_again() -> None:
    """That it came once does not make it be there; what was refused may be taken when there is room."""
    files, pair = MemoryFiles(), Pair(CLEAN)
    pair.serve(FileServer(*VEHICLE, files))
    for change in (lambda: None, lambda: files.remove(("missions", "m"))):
        change()
        upload = Upload(SHORE, VEHICLE, DATA, "missions/m")
        pair.ask(upload)
        assert pair.run(is_over((upload,)), 30.0)
        assert upload.state is State.WHOLE
        assert files["missions/m"] == DATA


def test_an_upload_that_was_refused_may_be_taken_later() -> None:
    files, pair = MemoryFiles(), Pair(CLEAN)
    files.refuse_received = "mission: waypoint 3 lies on land"
    pair.serve(FileServer(*VEHICLE, files))
    for refused, state in ((files.refuse_received, State.REFUSED), (None, State.WHOLE)):
        files.refuse_received = refused
        upload = Upload(SHORE, VEHICLE, DATA, "missions/m")
        pair.ask(upload)
        assert pair.run(is_over((upload,)), 60.0)
        assert upload.state is state
        pair.ask()
        pair.wait(25.0)


def test_a_folder_is_listed_as_it_is_now() -> None:
    """The answer to the same question of before is none, nor one to a question for another folder."""
    files, pair = MemoryFiles(), Pair(CLEAN)
    pair.serve(FileServer(*VEHICLE, files))
    for names in ([], ["m"]):
        for name in names:
            files.files["missions", name] = b"1234"
        listing = Listing(SHORE, VEHICLE, "/missions")
        pair.ask(listing)
        assert pair.run(is_over((listing,)), 30.0)
        assert [entry.name for entry in listing.entries] == names


@pytest.mark.parametrize("loss", [0.0, 0.3])
def test_both_ends_count_what_was_of_use_and_what_was_sent_again(loss: float) -> None:
    """Oracle: the sizes of the files; without loss nothing is sent again."""
    files, pair = MemoryFiles({"logs/a.log": DATA}), Pair(ChannelSettings(loss=loss, whole_frames=True))
    aboard, ashore, disk = Traffic(), Traffic(), MemoryDisk()
    pair.serve(FileServer(*VEHICLE, files, aboard))
    transfers = (
        Download(SHORE, VEHICLE, "logs/a.log", disk, "a.log", traffic=ashore),
        Upload(SHORE, VEHICLE, DATA[:5000], "missions/m", traffic=ashore),
    )
    pair.ask(*transfers)
    assert pair.run(is_over(transfers), 60.0)
    assert (ashore.new_bytes, aboard.new_bytes) == (len(DATA), 5000)
    assert (aboard.sent_bytes - aboard.again_bytes, ashore.sent_bytes - ashore.again_bytes) == (len(DATA), 5000)
    assert (aboard.retransmit_ratio > 0.1) is (loss > 0.0)
    assert loss > 0.0 or aboard.again_bytes == ashore.again_bytes == 0
    assert ashore.goodput(pair.t) > 0.0
