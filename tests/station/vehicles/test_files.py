"""Files of vehicles at the station. Oracle: the bytes of the vehicle, and their SHA-256."""

import hashlib
import random
from pathlib import Path
from typing import Any

import pytest

from stommel.archive import ArchiveBusyError
from stommel.station.station import Station
from stommel.station.vehicles import asking
from stommel.station.vehicles.file_rows import FileRow, FileRows
from stommel.station.vehicles.files import TransferError
from tests.station.client import Client
from tests.station.served import Served, served
from tests.station.speaker import until
from tests.station.stations import station

CONTENT = random.Random(1).randbytes(40_000)
LOG = "logs/00001.log"


def fetched(found: Station, id: int) -> Any:
    return next(each for each in found.files.transfers(1, 100) if each["id"] == id)


def is_whole(found: Station, id: int) -> bool:
    told = fetched(found, id)
    assert told["state"] in ("going", "paused", "whole"), told
    return bool(told["state"] == "whole")


def with_log(vehicle: Served, content: bytes = CONTENT) -> Served:
    vehicle.files.files["logs", "00001.log"] = content
    return vehicle


def test_a_file_is_fetched_whole_and_given_out_as_it_was(tmp_path: Path) -> None:
    with served() as vehicle, station(tmp_path, with_log(vehicle).address) as found:
        client = Client(found)
        until(lambda: found.vehicles[1].status().heard)
        entries = client.get("/vehicles/1/listing", folder="logs")["entries"]
        assert entries == [{"name": "00001.log", "size": len(CONTENT), "is_folder": False}]
        row = client.post("/vehicles/1/transfers", {"path": LOG})
        until(lambda: is_whole(found, row["id"]))
        (stored,) = client.get("/vehicles/1/files")
        assert stored["sha256"] == hashlib.sha256(CONTENT).hexdigest()
        answer = client.request("GET", f"/vehicles/1/files/{stored['id']}")
        assert answer.content == CONTENT
        assert "00001.log" in answer.headers["content-disposition"]
        assert list((tmp_path / "vehicle-1" / "transfers").iterdir()) == []


def test_no_byte_is_asked_for_twice_over_restarts_of_the_station(tmp_path: Path) -> None:
    """mavlink/MAVSDK#2764: a transfer goes on where it was, however often the station is started anew."""
    with served(rate=200_000.0) as vehicle:
        with_log(vehicle)
        with station(tmp_path, vehicle.address) as found:
            id = found.files.download(1, "ada", LOG).id
            until(lambda: fetched(found, id)["done"] > 4000)
        for _ in range(2):
            with station(tmp_path, vehicle.address) as found:
                before = fetched(found, id)["done"]
                until(lambda: fetched(found, id)["done"] > before + 4000 or is_whole(found, id))  # noqa: B023
        with station(tmp_path, vehicle.address) as found:
            until(lambda: is_whole(found, id))
            _, place = found.files.stored(1, id)
            assert place.read_bytes() == CONTENT


def test_paused_by_a_person_it_rests_until_resumed(tmp_path: Path) -> None:
    """yamcs/yamcs#956, #1153: after a resume the missing part is asked for."""
    with served(rate=100_000.0) as vehicle, station(tmp_path, with_log(vehicle).address) as found:
        client = Client(found)
        id = client.post("/vehicles/1/transfers", {"path": LOG})["id"]
        until(lambda: fetched(found, id)["done"] > 2000)
        assert client.post(f"/transfers/{id}/pause")["is_paused"]
        vehicle.under_water = True
        until(lambda: not found.vehicles[1].status().heard)
        vehicle.under_water = False
        until(lambda: found.vehicles[1].status().heard)
        assert fetched(found, id)["is_paused"]
        client.post(f"/transfers/{id}/resume")
        until(lambda: is_whole(found, id))


def test_a_file_is_sent_and_goes_on_after_a_restart(tmp_path: Path) -> None:
    with served() as vehicle:
        vehicle.under_water = True
        with station(tmp_path, vehicle.address) as found:
            form = {"path": (None, "inbox/notes.bin"), "file": ("notes.bin", CONTENT)}
            answer = Client(found).request("POST", "/vehicles/1/files", files=form)
            assert answer.status_code == 202, answer.text
            id = answer.json()["id"]
        with station(tmp_path, vehicle.address) as again:
            assert fetched(again, id)["state"] == "going"
            vehicle.under_water = False
            until(lambda: is_whole(again, id))
            assert vehicle.files["inbox/notes.bin"] == CONTENT


@pytest.mark.parametrize("path", ["../../etc/passwd", "/", "..", "a\\b", "logs/../../x", "a\nb", "C:x"])
def test_no_path_leads_out_of_the_vehicle(tmp_path: Path, path: str) -> None:
    with served() as vehicle, station(tmp_path, vehicle.address, start=False) as found:
        client = Client(found)
        client.refused("POST", "/vehicles/1/transfers", 422, json={"path": path})
        client.refused("POST", "/vehicles/1/files", 422, files={"path": (None, path), "file": ("x", b"x")})
        assert found.files.transfers(1, 10) == []


def test_what_is_no_form_and_what_is_not_there_is_told(tmp_path: Path) -> None:
    with served() as vehicle, station(tmp_path, vehicle.address) as found:
        client = Client(found)
        until(lambda: found.vehicles[1].status().heard)
        client.refused("POST", "/vehicles/1/files", 422, content=b"junk")
        client.refused("POST", "/vehicles/1/files", 422, files={"file": ("x", b"x")})
        client.refused("POST", "/vehicles/1/files", 422, files={"path": (None, "inbox/x"), "file": ("x", b"")})
        client.refused("GET", "/vehicles/1/files/77", 404)
        client.refused("POST", "/transfers/77/pause", 404)
        id = client.post("/vehicles/1/transfers", {"path": "logs/none.log"})["id"]
        until(lambda: fetched(found, id)["state"] == "refused")
        client.refused("POST", f"/transfers/{id}/resume", 404)
        vehicle.under_water = True
        until(lambda: not found.vehicles[1].status().heard)
        assert "not heard" in client.refused("GET", "/vehicles/1/listing", 409)["reason"]


def test_a_whole_file_is_kept_though_the_archive_was_busy_at_its_end(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    change, failed = FileRows.change, list[str]()

    def busy_once(rows: FileRows, row: FileRow) -> None:
        if row.is_over and not failed:
            failed.append(row.state)
            raise ArchiveBusyError("archive.sqlite: another program is writing to the archive")
        change(rows, row)

    monkeypatch.setattr(FileRows, "change", busy_once)
    with served() as vehicle, station(tmp_path, with_log(vehicle).address) as found:
        id = found.files.download(1, "ada", LOG).id
        until(lambda: is_whole(found, id))
        _, place = found.files.stored(1, id)
        assert place.read_bytes() == CONTENT
        assert failed == ["whole"]


def test_what_was_begun_before_the_first_look_is_begun_once(tmp_path: Path) -> None:
    """The first look may come after its row is written, and before or after it is begun."""
    with served() as vehicle, station(tmp_path, vehicle.address, start=False) as found:
        line, follower = found.vehicles[1], found.files._followers[1]
        row = FileRows(found.archive).add(FileRow(0, 1, LOG, "download", "ada", line.clock.now(), "going"))
        follower.look(line, line.clock.link_now())
        assert follower.transfers == {}
        follower.begin(line.end, row)
        begun = follower.transfers[row.id].service
        follower.look(line, line.clock.link_now())
        assert follower.transfers[row.id].service is begun


def test_what_a_busy_line_does_not_take_leaves_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(asking, "ANSWER_WITHIN", 0.1)
    with served() as vehicle, station(tmp_path, vehicle.address, start=False) as found:
        with pytest.raises(TransferError, match="nothing was done"):
            found.files.upload(1, "ada", "inbox/x", b"x")
        assert [row["state"] for row in found.files.transfers(1, 10)] == ["failed"]
        assert list((tmp_path / "vehicle-1" / "transfers").iterdir()) == []


def test_a_cancelled_transfer_leaves_nothing(tmp_path: Path) -> None:
    with served(rate=50_000.0) as vehicle, station(tmp_path, with_log(vehicle).address) as found:
        client = Client(found)
        id = client.post("/vehicles/1/transfers", {"path": LOG})["id"]
        until(lambda: fetched(found, id)["done"] > 1000)
        assert client.post(f"/transfers/{id}/cancel")["state"] == "cancelled"
        assert not (tmp_path / "vehicle-1" / "transfers" / str(id)).exists()
