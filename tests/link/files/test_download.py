"""Files over a bad radio. Oracles: the bytes aboard, counts of the channel, and the bound that losses leave."""

import hashlib
import random
from collections.abc import Callable

import pytest

from stommel.link.channel.settings import ChannelSettings
from stommel.link.files.download import Download
from stommel.link.files.fetching import MOST_WAIT
from stommel.link.files.loss import MOST_SEGMENT
from stommel.link.files.progress import State
from stommel.link.files.server import FileServer
from stommel.link.service import Received
from tests.link.files.fakes import MemoryDisk, MemoryFiles, noise
from tests.link.files.pair import SHORE, VEHICLE, Pair, is_over

FRAME = 280
"""Bytes of a signed frame with a whole segment: 10 of header, 255, 2 of checksum, 13 of signature."""
DATA = noise(60_000, 1)


class Transfer:
    """A vehicle with a file, and a shore that wants it."""

    def __init__(self, settings: ChannelSettings, data: bytes = DATA, seed: int = 0, **more: object) -> None:
        self.pair = Pair(settings, seed, more.pop("linked", None))  # type: ignore[arg-type]
        self.files = MemoryFiles({"logs/a.log": data})
        self.disk = MemoryDisk()
        self.more = more
        self.sent = self.arrived = 0
        self.boot()
        self.start()

    def boot(self) -> None:
        """The vehicle's software starts."""
        self.server = FileServer(*VEHICLE, self.files)
        self.pair.serve(self.server)

    def start(self) -> None:
        """The shore's program starts."""
        self.download = Download(SHORE, VEHICLE, "logs/a.log", self.disk, "a.log", **self.more)  # type: ignore[arg-type]
        self.pair.ask(self, self.download)

    def take(self, received: Received, t: float) -> None:
        if received.name == "FILE_DATA":
            self.arrived += int(received.values["length"])  # type: ignore[arg-type]

    def poll(self, t: float, outbox: object) -> None:
        pass

    def run(self, most: float = 1000.0) -> State:
        self.pair.run(lambda: self.download.state.is_over, most)
        return self.download.state

    @property
    def kept(self) -> bytes:
        return bytes(self.disk.files["a.log"])


def share_of_bound(size: int, seconds: float, loss: float, bytes_a_second: float) -> float:
    """Goodput over what the losses and the headers leave of the line."""
    return size / seconds / ((1.0 - loss) * MOST_SEGMENT / FRAME * bytes_a_second)


@pytest.mark.parametrize("loss", [0.0, 0.1, 0.2, 0.4])
@pytest.mark.parametrize("latency", [0.05, 0.5])
def test_goodput_is_near_the_bound(loss: float, latency: float) -> None:
    """ArduPilot/MissionPlanner#3044: a gap restarted the burst. The whole grid with 1 MB is `make bench`."""
    data = noise(250_000, 2)
    settings = ChannelSettings(latency=latency, loss=loss, whole_frames=True)
    transfer = Transfer(settings, data)
    assert transfer.run() is State.WHOLE
    assert transfer.kept == data
    # a quarter of the file has the same start and end as the whole: they weigh four times
    least = 0.85 - 0.25 * latency - 0.15 * loss
    assert share_of_bound(len(data), transfer.pair.t, loss, settings.bytes_a_second) >= least


@pytest.mark.parametrize("loss", [0.0, 0.2])
def test_a_round_trip_of_two_seconds_makes_no_duplicates(loss: float) -> None:
    """PX4/PX4-Autopilot#11078: a fixed time-out flooded a slow link."""
    transfer = Transfer(ChannelSettings(latency=1.0, loss=loss, whole_frames=True), noise(300_000, 3))
    assert transfer.run() is State.WHOLE
    counts = transfer.download.counts
    assert counts.duplicate <= 0.05 * counts.received
    assert counts.requests < 80


def test_any_one_packet_may_be_lost() -> None:
    """mavlink/qgroundcontrol#10418: the download hung for ever if the last packet was lost."""
    data = noise(2500, 4)
    clean = Transfer(ChannelSettings(whole_frames=True), data)
    clean.run()
    packets = (clean.pair.channel.vehicle.counts.packets, clean.pair.channel.shore.counts.packets)
    assert min(packets) >= 2
    for end in range(2):
        for lost in range(packets[end] + 1):
            transfer = Transfer(ChannelSettings(whole_frames=True), data)
            drop(transfer.pair, end, lost)
            assert transfer.run(30.0) is State.WHOLE
            assert transfer.kept == data


def drop(pair: Pair, end: int, lost: int) -> None:
    """Lose one packet of an end."""
    channel = pair.channel
    counts = (channel.vehicle, channel.shore)[end].counts

    def is_lost(t: float) -> bool:
        speaking = channel._turn is (channel.vehicle, channel.shore)[end]
        return speaking and counts.packets - 1 == lost

    channel._is_lost = is_lost  # type: ignore[method-assign]


def test_half_a_minute_of_silence_is_survived() -> None:
    """mavlink/MAVSDK#3106: ten time-outs ended a good transfer."""
    settings = ChannelSettings(whole_frames=True, outages=((2.0, 32.0),))
    transfer = Transfer(settings)
    assert transfer.run() is State.WHOLE
    assert transfer.kept == DATA
    assert transfer.download.counts.duplicate <= 5 * MOST_SEGMENT
    assert transfer.pair.t < 32.0 + MOST_WAIT + 10.0


def test_after_a_dive_of_an_hour_it_goes_on_at_once_when_the_vehicle_is_heard() -> None:
    settings = ChannelSettings(whole_frames=True, outages=((2.0, 3600.0),))
    transfer = Transfer(settings, patience=None)
    transfer.pair.run(lambda: False, 5.0)
    transfer.pair.wait(3595.0)
    done = transfer.download.progress.done
    assert 0 < done < len(DATA)
    heartbeat = Received(*VEHICLE, "HEARTBEAT", {})
    transfer.download.take(heartbeat, transfer.pair.t)
    transfer.pair.run(lambda: False, 1.0)
    assert transfer.download.progress.done > done


def test_no_answer_is_a_failure_within_its_time() -> None:
    transfer = Transfer(ChannelSettings(outages=((0.0, 1e9),)), patience=40.0)
    assert transfer.run(60.0) is State.FAILED
    assert transfer.download.reason == "logs/a.log: no answer for 40 s; nothing has come"
    transfer = Transfer(ChannelSettings(whole_frames=True, outages=((2.0, 1e9),)), patience=40.0)
    assert transfer.run(60.0) is State.FAILED
    assert "bytes are kept" in transfer.download.reason
    assert transfer.pair.channel.shore.counts.packets < 40


def test_a_vehicle_that_only_beats_its_heart_is_no_answer() -> None:
    transfer = Transfer(ChannelSettings(outages=((0.0, 1e9),)), patience=40.0)
    while transfer.pair.t < 60.0 and not transfer.download.state.is_over:
        transfer.pair.step()
        transfer.download.take(Received(*VEHICLE, "HEARTBEAT", {}), transfer.pair.t)
    assert transfer.download.state is State.FAILED


def surfacings(seed: int, data: bytes, bit_rate: float, *, power_cuts: bool) -> tuple[Transfer, int]:
    """Sixty seconds at the surface, again and again, both ends killed at random; and how often."""
    draw = random.Random(seed)
    settings = ChannelSettings(bit_rate=bit_rate, latency=0.2, loss=0.2, whole_frames=True)
    transfer = Transfer(settings, data, seed, linked=lambda t: t % 100.0 < 60.0, patience=None)
    transfer.pair.pace = transfer.pair.usual = 0.05
    kills = 0
    for surfacing in range(40):
        ends = [(100.0 * surfacing + draw.uniform(0.0, 60.0), end) for end in ("shore", "vehicle")]
        for at, end in sorted(ends):
            if transfer.pair.run(lambda: transfer.download.state.is_over, at - transfer.pair.t):
                return transfer, kills
            kills += 1
            if end == "vehicle":
                transfer.boot()
            else:
                if power_cuts:
                    transfer.disk.power_cut()
                transfer.start()
        transfer.pair.run(lambda: transfer.download.state.is_over, 100.0 * surfacing + 60.5 - transfer.pair.t)
        transfer.pair.wait(100.0 * (surfacing + 1) - transfer.pair.t)
    return transfer, kills


@pytest.mark.parametrize("seed", range(2))
def test_twenty_surfacings_with_both_ends_killed_ask_no_byte_twice(seed: int) -> None:
    """mavlink/MAVSDK#2764, nasa/nos3#743: no resume after power-off or loss of signal."""
    data = noise(300_000, 7)
    transfer, kills = surfacings(seed, data, 4800.0, power_cuts=False)
    assert transfer.kept == data
    assert kills >= 16
    assert transfer.arrived - len(data) < 0.01 * len(data)


def test_power_cuts_ashore_cost_what_was_not_synced() -> None:
    data = noise(150_000, 8)
    transfer, kills = surfacings(5, data, 9600.0, power_cuts=True)
    assert transfer.kept == data
    assert transfer.arrived - len(data) < kills * 20_000


def test_a_file_that_changes_while_it_is_read_is_told() -> None:
    transfer = Transfer(ChannelSettings(whole_frames=True))
    transfer.pair.run(lambda: transfer.download.progress.done > 20_000, 100.0)
    other = noise(60_000, 99)
    transfer.files.files["logs", "a.log"] = other
    assert transfer.run() is State.WHOLE
    assert "begun again" in transfer.download.reason
    assert transfer.kept == other


def test_a_file_that_changes_all_the_time_fails_and_has_no_name() -> None:
    transfer = Transfer(ChannelSettings(whole_frames=True), noise(20_000))

    def change() -> bool:
        data = bytearray(transfer.files["logs/a.log"])
        data[random.Random(transfer.pair.t).randrange(len(data))] ^= 1
        transfer.files.files["logs", "a.log"] = bytes(data)
        return transfer.download.state.is_over

    transfer.pair.run(change, 100.0)
    assert transfer.download.state is State.FAILED
    assert "a.log" not in transfer.disk.files


def test_a_file_that_becomes_shorter_is_told() -> None:
    transfer = Transfer(ChannelSettings(whole_frames=True))
    transfer.pair.run(lambda: transfer.download.progress.done > 20_000, 100.0)
    transfer.files.files["logs", "a.log"] = DATA[:10_000]
    assert transfer.run() is State.WHOLE
    assert "begun again" in transfer.download.reason
    assert transfer.kept == DATA[:10_000]


def test_a_log_that_grows_is_fetched_as_it_was() -> None:
    transfer = Transfer(ChannelSettings(whole_frames=True))

    def grow() -> bool:
        transfer.files.files["logs", "a.log"] += b"more"
        return transfer.download.state.is_over

    transfer.pair.run(lambda: transfer.download.state is State.FETCHING, 10.0)
    transfer.pair.run(grow, 100.0)
    assert transfer.download.state is State.WHOLE
    size = len(transfer.kept)
    assert transfer.files["logs/a.log"][:size] == transfer.kept
    assert len(DATA) <= size < len(transfer.files["logs/a.log"])
    # the rest comes with the next download, in place of the beginning
    transfer.start()
    assert transfer.run() is State.WHOLE
    assert transfer.kept == transfer.files["logs/a.log"]


def test_a_full_disk_ends_it_with_the_part_kept_and_it_goes_on() -> None:
    transfer = Transfer(ChannelSettings(whole_frames=True))
    transfer.disk.room = 30_000
    assert transfer.run() is State.FAILED
    assert "No space left on device" in transfer.download.reason
    kept = transfer.download.progress.done
    assert kept > 20_000
    transfer.disk.room = None
    arrived = transfer.arrived
    transfer.pair.run(lambda: False, 2.0)  # what was on its way
    transfer.start()
    assert transfer.run() is State.WHOLE
    assert transfer.kept == DATA
    assert transfer.download.counts.received == len(DATA) - kept
    assert arrived < len(DATA)


def test_what_is_refused_says_why() -> None:
    transfer = Transfer(ChannelSettings(whole_frames=True))
    transfer.download = Download(SHORE, VEHICLE, "logs/none.log", transfer.disk, "n")
    transfer.pair.ask(transfer.download)
    assert transfer.run() is State.REFUSED
    assert transfer.download.reason == "logs/none.log: there is no such file"
    transfer.download = Download(SHORE, VEHICLE, "../etc/passwd", transfer.disk, "n")
    transfer.pair.ask(transfer.download)
    assert transfer.run() is State.REFUSED
    assert "plain names" in transfer.download.reason


def test_bytes_that_were_garbled_on_the_way_never_count(monkeypatch: pytest.MonkeyPatch) -> None:
    """mavlink/MAVSDK#3106: done only with the right SHA-256."""
    transfer = Transfer(ChannelSettings(whole_frames=True))
    real = transfer.files.read
    reads = 0

    def garbled(path: tuple[str, ...], offset: int, length: int) -> bytes:
        nonlocal reads
        data = real(path, offset, length)
        reads += 1
        return bytes(len(data)) if reads == 50 else data

    monkeypatch.setattr(transfer.files, "read", garbled)
    assert transfer.run() is State.WHOLE
    assert "begun again" in transfer.download.reason
    assert hashlib.sha256(transfer.kept).digest() == hashlib.sha256(DATA).digest()


@pytest.mark.parametrize("size", [0, 1, MOST_SEGMENT, MOST_SEGMENT + 1, 0x10000, 0x10001])
def test_sizes_at_the_edges(size: int) -> None:
    data = bytes(size)  # zeros: their frames are cut short
    transfer = Transfer(ChannelSettings(whole_frames=True, loss=0.1), data)
    assert transfer.run(100.0) is State.WHOLE
    assert transfer.kept == data


@pytest.mark.parametrize(
    "settings",
    [
        ChannelSettings(jitter=0.3, duplication=0.2, reordering=0.2, loss=0.1, whole_frames=True),
        ChannelSettings(fade_every=3.0, fade_length=0.5),
        ChannelSettings(half_duplex=False, latency=0.3, whole_frames=True),
        ChannelSettings(bit_rate=2400.0, loss=0.2, whole_frames=True),
    ],
    ids=["disorder", "fades", "full duplex", "slow"],
)
def test_other_radios(settings: ChannelSettings) -> None:
    data = noise(20_000, 11)
    transfer = Transfer(settings, data)
    assert transfer.run(400.0) is State.WHOLE
    assert transfer.kept == data


@pytest.mark.parametrize("bit_error_rate", [1e-4, 1e-3])
def test_segments_become_short_where_bits_flip(bit_error_rate: float) -> None:
    """Against what whole segments would carry, and the best ones, if every other byte of the line were free."""
    settings = ChannelSettings(bit_error_rate=bit_error_rate, whole_frames=True)
    data = noise(100_000, 12)
    transfer = Transfer(settings, data)
    assert transfer.run(2000.0) is State.WHOLE
    goodput = len(data) / transfer.pair.t / settings.bytes_a_second
    carried = [s / (s + 36) * (1.0 - bit_error_rate) ** (8 * (s + 36)) for s in range(1, MOST_SEGMENT + 1)]
    assert goodput > 0.5 * max(carried)
    assert goodput > 1.4 * carried[-1] or bit_error_rate < 1e-3


def test_segments_stay_long_where_frames_are_lost_whatever_their_size() -> None:
    transfer = Transfer(ChannelSettings(loss=0.3, whole_frames=True), noise(300_000, 13))
    assert transfer.run() is State.WHOLE
    assert transfer.download._fetch is not None
    assert transfer.download._fetch.loss.segment >= 180


def test_two_files_at_once_share_the_line() -> None:
    transfer = Transfer(ChannelSettings(loss=0.1, whole_frames=True))
    transfer.files.files["logs", "b.log"] = DATA[::-1]
    second = Download(SHORE, VEHICLE, "logs/b.log", transfer.disk, "b.log")
    transfer.pair.ask(transfer.download, second)
    half: Callable[[], bool] = lambda: transfer.download.progress.share > 0.5  # noqa: E731
    transfer.pair.run(half, 100.0)
    assert 0.3 < second.progress.share < 0.7
    assert transfer.pair.run(is_over((transfer.download, second)), 200.0)
    assert transfer.kept == DATA
    assert bytes(transfer.disk.files["b.log"]) == DATA[::-1]


def test_a_pause_stops_the_vehicle_and_loses_nothing() -> None:
    transfer = Transfer(ChannelSettings(whole_frames=True))
    transfer.pair.run(lambda: transfer.download.progress.done > 20_000, 100.0)
    transfer.download.pause()
    transfer.pair.run(lambda: False, 2.0)
    sent = transfer.pair.channel.vehicle.counts.packets
    done = transfer.download.progress.done
    transfer.pair.wait(700.0)
    assert transfer.pair.channel.vehicle.counts.packets == sent
    transfer.download.resume(transfer.pair.t)
    assert transfer.run() is State.WHOLE
    assert transfer.kept == DATA
    assert transfer.download.counts.duplicate == 0
    assert transfer.arrived == len(DATA)
    assert done < 40_000


def test_progress_tells_how_long_it_will_take() -> None:
    transfer = Transfer(ChannelSettings(whole_frames=True), noise(300_000, 1))
    transfer.pair.run(lambda: transfer.download.progress.done > 100_000, 100.0)
    progress = transfer.download.progress
    assert progress.size == 300_000
    assert progress.seconds_left == pytest.approx(200_000 / (11_520 * 244 / 280), rel=0.2)
