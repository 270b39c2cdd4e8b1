"""A line with a key: start order, clocks and full disks do not keep a vehicle from being heard.

Oracle: what the vehicle says, which has a guard and a clock of its own, and what the station says it has accepted.
"""

import time
from pathlib import Path
from typing import Any

import pytest

from stommel.link.signing.key_file import KeyFile, new_keys
from stommel.station.vehicles import ingest
from tests.station.client import Client
from tests.station.signed_speaker import DAY, signed_vehicle
from tests.station.speaker import speaker, until
from tests.station.stations import station
from tests.station.vehicles.test_failing_archive import fail


def key_in(folder: Path, *, made: float | None = None, unused: bool = True) -> Path:
    path = folder / "zju-1.key"
    KeyFile(path).write(new_keys(1, time.time() if made is None else made)._replace(unused=unused))
    return path


OLD = 20.0 * DAY
"""Age of a key: a clock is believed from there on."""


def told(path: Path, speed: float) -> dict[str, Any]:
    return {"key": path, "unsigned": False, "speed": speed, "simulated": True}


@pytest.mark.parametrize("unused", [True, False])
def test_a_disk_that_fills_before_the_vehicle_is_heard_keeps_nobody_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, unused: bool
) -> None:
    """The station is silent while nothing can be kept, and its key was used before: both ends must still meet."""
    key = key_in(tmp_path, unused=unused)
    with speaker() as line, station(tmp_path, line.address, start=False, vehicle=told(key, 20.0)) as found:
        with monkeypatch.context() as broken:
            fail(found.archive, broken)
            found.vehicles[1].archive_reason = "the disk is full"
            found.start()
            with signed_vehicle(line, key, time.time(), 20.0) as vehicle:
                vehicle.until(lambda: found.vehicles[1].end.guard.refusals.by_reason or found.vehicles[1].ingest.came)
        vehicle.until(lambda: found.vehicles[1].status().heard)
        vehicle.until(lambda: not found.vehicles[1].status().archive)


@pytest.mark.parametrize("behind", [0.0, 3600.0, 3.0 * DAY, -5.0 * DAY])
@pytest.mark.parametrize("unused", [True, False])
def test_neither_start_order_nor_clock_keeps_a_simulated_vehicle_from_being_heard(
    tmp_path: Path, unused: bool, behind: float
) -> None:
    """The station waits in silence for the vehicle's clock, which it may believe only when it has been heard itself."""
    now = time.time()
    key = key_in(tmp_path, made=now - OLD, unused=unused)
    with speaker() as line, station(tmp_path, line.address, vehicle=told(key, 20.0)) as found:
        with signed_vehicle(line, key, now - behind, 20.0) as vehicle:
            vehicle.until(lambda: found.vehicles[1].status().heard)
            vehicle.until(lambda: found.vehicles[1].ingest.heard_at)
        figures = Client(found).get("/vehicles/1/link")["figures"]
        assert figures["unsigned_refused"] == figures["wrongly_signed_refused"] == figures["replayed_refused"] == 0
        assert figures["out_of_step_refused"] < 100


def test_a_stranger_does_not_make_the_station_deaf_before_its_vehicle_is_heard(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What is not believed waits for the vehicle's clock too, and is bounded; the line is read on."""
    monkeypatch.setattr(ingest, "MOST_REFUSED", 50)
    monkeypatch.setattr(ingest, "MOST_FRAMES", 100)
    key = key_in(tmp_path)
    with speaker() as line, station(tmp_path, line.address, vehicle=told(key, 20.0)) as found:
        with signed_vehicle(line, key, time.time(), 20.0) as vehicle:
            for k in range(200):
                line.say("HEARTBEAT", type=12)
                until(lambda: found.vehicles[1].end.guard.refusals.unsigned > k)  # noqa: B023
            vehicle.until(lambda: found.vehicles[1].ingest.heard_at)
        assert found.vehicles[1].end.guard.refusals.unsigned == 200
