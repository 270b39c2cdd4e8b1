"""What the station keeps outside of its archive, while the disk fails for a while: it goes on by itself.

Oracle: the bytes aboard, and what the services say. The archive has tests of its own.
"""

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from stommel.link.files.folder_disk import FolderDisk
from stommel.station.vehicles import file_follower, line
from stommel.station.vehicles.file_follower import FileFollower
from tests.station.served import served
from tests.station.speaker import until
from tests.station.stations import station
from tests.station.vehicles.test_files import CONTENT, LOG, fetched, is_whole, with_log

REASONS = (errno.ENOSPC, errno.EIO, errno.EROFS)


@contextmanager
def failing(owner: type, method: str, reason: int) -> Iterator[list[int]]:
    """Let a method raise OSError until the block ends; what it gives counts how often."""
    refused = [0]

    def fails(*_: object) -> None:
        refused[0] += 1
        raise OSError(reason, os.strerror(reason))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(owner, method, fails)
        yield refused


@pytest.fixture(autouse=True)
def _soon(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(file_follower, "DISK_AGAIN", 0.2)
    monkeypatch.setattr(line, "CLOCK_EVERY", 0.1)


@pytest.mark.parametrize("reason", REASONS, ids=os.strerror)
def test_a_download_goes_on_when_there_is_room_again(tmp_path: Path, reason: int) -> None:
    """It says why it waits, loses nothing that has come, and asks for none of it again."""
    with served(rate=200_000.0) as vehicle, station(tmp_path, with_log(vehicle).address) as found:
        id = found.files.download(1, "ada", LOG).id
        until(lambda: fetched(found, id)["done"] > 4000)
        with failing(FolderDisk, "write", reason) as refused:
            until(lambda: os.strerror(reason) in fetched(found, id)["reason"])
            until(lambda: refused[0] >= 2)
            until(lambda: "it goes on by itself" in fetched(found, id)["reason"])
            assert not fetched(found, id)["is_over"]
            assert (tmp_path / "vehicle-1" / "transfers" / str(id) / "file.part").stat().st_size > 4000
        until(lambda: fetched(found, id)["done"] > 4000 or is_whole(found, id))
        until(lambda: is_whole(found, id))
        _, place = found.files.stored(1, id)
        assert place.read_bytes() == CONTENT


def test_a_download_that_waits_for_the_disk_can_be_cancelled(tmp_path: Path) -> None:
    with served(rate=200_000.0) as vehicle, station(tmp_path, with_log(vehicle).address) as found:
        with failing(FolderDisk, "write", errno.ENOSPC):
            id = found.files.download(1, "ada", LOG).id
            until(lambda: "it goes on by itself" in fetched(found, id)["reason"])
            found.files.cancel(id)
            until(lambda: fetched(found, id)["state"] == "cancelled")
        assert list((tmp_path / "vehicle-1" / "transfers").iterdir()) == []


@pytest.mark.parametrize("reason", REASONS, ids=os.strerror)
def test_a_whole_file_is_brought_to_its_place_when_that_can_be_made(tmp_path: Path, reason: int) -> None:
    with served() as vehicle, station(tmp_path, with_log(vehicle).address) as found:
        with failing(FileFollower, "_store", reason) as refused:
            id = found.files.download(1, "ada", LOG).id
            until(lambda: refused[0] >= 2)
            until(lambda: "cannot be stored" in fetched(found, id)["reason"])
        until(lambda: is_whole(found, id))
        _, place = found.files.stored(1, id)
        assert place.read_bytes() == CONTENT


def test_a_transfer_of_before_a_restart_is_taken_up_when_the_disk_is_well(tmp_path: Path) -> None:
    with served(rate=200_000.0) as vehicle:
        with station(tmp_path, with_log(vehicle).address) as found:
            id = found.files.download(1, "ada", LOG).id
            until(lambda: fetched(found, id)["done"] > 4000)
        with station(tmp_path, vehicle.address, start=False) as found:
            with failing(FolderDisk, "__init__", errno.EROFS) as refused:
                found.start()
                until(lambda: refused[0] >= 2)
                assert not fetched(found, id)["is_over"]
            until(lambda: is_whole(found, id))


def test_the_clock_of_a_simulated_vehicle_is_kept_when_it_can_be(tmp_path: Path) -> None:
    """People are told while it is not, and no longer when it is."""
    from stommel.station.clock import VehicleClock

    with served() as vehicle, station(tmp_path, vehicle.address, start=False) as found:
        found.start()
        until(lambda: found.vehicles[1].status().heard)
        with failing(VehicleClock, "keep", errno.ENOSPC):
            until(lambda: any("clock: cannot be kept" in note for note in found.vehicles[1].status().notes))
        until(lambda: not any("clock" in note for note in found.vehicles[1].status().notes))
