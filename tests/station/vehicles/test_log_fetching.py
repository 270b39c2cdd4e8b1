"""Logs that come ashore by themselves. Oracle: the files aboard, byte for byte, and what the vehicle was asked for."""

from pathlib import Path
from typing import Any

import pytest

from stommel.errors import FileError
from stommel.messages.log.names import LogName
from stommel.station.settings import load_settings
from stommel.station.station import Station
from stommel.station.vehicles import log_fetching
from tests.link.commands.quay import FakePort
from tests.link.files.fakes import noise
from tests.station.client import Client
from tests.station.served import Served, served
from tests.station.speaker import until
from tests.station.stations import station

ESSENTIAL = {"vehicle": {"fetch": "essential"}}


def name(number: int, series: str = "essential", *, sent: bool = False) -> str:
    return LogName(3, number, series, sent).text


@pytest.fixture(autouse=True)
def _soon(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(log_fetching, "AT_LEAST", 0.5)
    monkeypatch.setattr(log_fetching, "AGAIN", 0.5)
    monkeypatch.setattr(log_fetching, "EVERY", 0.05)


def with_logs(vehicle: Served, *names: str, size: int = 3000) -> Served:
    vehicle.files.folders.add(("log",))
    for k, each in enumerate(names):
        vehicle.files.files["log", each] = noise(size, k)
    return vehicle


def transfers(found: Station) -> list[Any]:
    """The newest first."""
    return found.files.transfers(1, 100)


def ashore(found: Station) -> set[str]:
    return {row.path for row in found.files.whole(1, 100)}


def test_logs_of_the_series_come_by_themselves_and_once(tmp_path: Path) -> None:
    """Neither other series nor what was sent already; the same again after a restart costs nothing."""
    logs = name(1), name(2), name(3)
    with served() as vehicle:
        with_logs(vehicle, *logs, name(1, "detail"), name(1, "raw"), name(4, sent=True))
        with station(tmp_path, vehicle.address, **ESSENTIAL) as found:
            until(lambda: ashore(found) == {f"log/{each}" for each in logs})
            assert {row["user"] for row in transfers(found)} == {None}
            for row in found.files.whole(1, 100):
                assert found.files.stored(1, row.id)[1].read_bytes() == vehicle.files[row.path]
            first, second = transfers(found)[-2:]
            assert second["path"] == f"log/{name(2)}", "the newest that has certainly ended comes first"
            assert first["path"] == f"log/{name(1)}"
        with station(tmp_path, vehicle.address, **ESSENTIAL) as again:
            vehicle.files.files["log", name(5)] = noise(3000, 9)
            until(lambda: f"log/{name(5)}" in ashore(again))
            assert len(transfers(again)) == 4


def test_nothing_comes_by_itself_where_nobody_said_so(tmp_path: Path) -> None:
    with served() as vehicle, station(tmp_path, with_logs(vehicle, name(1), name(2)).address) as found:
        until(lambda: found.vehicles[1].status().heard)
        assert [type(each).__name__ for each in found.vehicles[1].followers].count("LogFetching") == 0


def test_what_matters_more_comes_first(tmp_path: Path) -> None:
    with served() as vehicle:
        with_logs(vehicle, name(1, "raw"), name(1), name(1, "detail"), name(2, "raw"), name(2, "detail"), name(2))
        with station(tmp_path, vehicle.address, vehicle={"fetch": "detail"}) as found:
            until(lambda: len(ashore(found)) == 4)
            assert transfers(found)[-1]["path"] == f"log/{name(1)}"
            assert not any("raw" in row["path"] for row in transfers(found))


def test_it_waits_for_the_surface_and_goes_on_at_the_next(tmp_path: Path) -> None:
    """A vehicle on a cable is heard under water: it dives, and its files are written."""
    with served() as vehicle:
        with_logs(vehicle, name(1), name(2))
        with station(tmp_path, vehicle.address, start=False, **ESSENTIAL) as found:
            (fetching,) = [each for each in found.vehicles[1].followers if isinstance(each, log_fetching.LogFetching)]
            dives: list[bool] = [True]
            with pytest.MonkeyPatch.context() as patch:
                patch.setattr(log_fetching, "is_under_water", lambda _line: dives[0])
                found.start()
                until(lambda: found.vehicles[1].status().heard)
                until(lambda: fetching._due > 0.0)
                assert not fetching._is_there
                assert transfers(found) == []
                dives[0] = False
                until(lambda: len(ashore(found)) == 2)


def test_while_one_is_paused_no_other_is_begun_and_a_cancelled_one_stays_so(tmp_path: Path) -> None:
    with served(rate=200_000.0) as vehicle:
        with_logs(vehicle, *(name(k) for k in range(1, 5)), size=20_000)
        with station(tmp_path, vehicle.address, **ESSENTIAL) as found:
            client = Client(found)
            until(lambda: len(transfers(found)) >= log_fetching.MOST_AT_ONCE)
            vehicle.under_water = True  # nothing comes whole meanwhile
            begun = transfers(found)
            assert len(begun) == log_fetching.MOST_AT_ONCE
            for row in begun:
                client.post(f"/transfers/{row['id']}/pause")
            client.post(f"/transfers/{begun[0]['id']}/cancel")
            vehicle.under_water = False
            (fetching,) = [each for each in found.vehicles[1].followers if isinstance(each, log_fetching.LogFetching)]
            listed = fetching._count
            until(lambda: fetching._count >= listed + 2)
            assert [row["path"] for row in transfers(found)] == [row["path"] for row in begun]
            client.post(f"/transfers/{begun[1]['id']}/resume")
            until(lambda: len(ashore(found)) == 3)
            assert begun[0]["path"] not in ashore(found)
        with station(tmp_path, vehicle.address, **ESSENTIAL) as again:
            vehicle.files.files["log", name(9)] = noise(300, 9)
            until(lambda: f"log/{name(9)}" in ashore(again))
            assert [row["path"] for row in transfers(again)].count(begun[0]["path"]) == 1, "over a restart too"


def test_a_command_does_not_wait_for_a_log(tmp_path: Path) -> None:
    """Oracle: the vehicle has begun the command while the log, of a minute and more, is on its way."""
    with served(rate=60_000.0) as vehicle:
        assert isinstance(vehicle.port, FakePort)
        with_logs(vehicle, name(1), name(2), size=600_000)
        with station(tmp_path, vehicle.address, **ESSENTIAL) as found:
            until(lambda: bool(transfers(found)) and transfers(found)[0]["done"] > 2000)
            Client(found).post("/vehicles/1/abort")
            until(lambda: vehicle.port.begun)
            assert not transfers(found)[0]["is_over"]


def test_what_the_setting_may_be_is_told(tmp_path: Path) -> None:
    vehicle = {"vehicle": 1, "link": "tcp:127.0.0.1:1", "unsigned": True, "fetch": "everything"}
    with pytest.raises(FileError, match="essential"):
        load_settings(None, {"folder": tmp_path, "vehicles": [vehicle]})
