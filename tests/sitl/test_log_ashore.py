"""What the radio left out is there once the log is ashore.

Oracle: the simulator's own NetCDF of the flight, whose CTD has the same water but noise of its own.
"""

import random
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

from stommel.archive import Batch
from stommel.link.shore.shore_end import ShoreEnd, ShoreSettings
from stommel.link.signing.guard import Guard
from stommel.messages.log.reader import read_log
from stommel.simulation.flight import Flown
from stommel.simulation.results.dataset import dataset_of, write_netcdf
from stommel.simulation.scenario.mission import Mission
from stommel.sitl.faults.disk import MemoryDisk
from stommel.sitl.flight import fly
from stommel.sitl.log_folder import logbook_in
from stommel.sitl.radio.station import SYSTEM
from stommel.sitl.system import System
from stommel.station.clock import VehicleClock
from stommel.station.vehicles.ingest import Ingest
from tests.station.client import Client
from tests.station.served import served
from tests.station.speaker import until
from tests.station.stations import station

CTD_EVERY = 10.0
"""Of the mission [s]; it sinks and rises at some 0.2 m/s, so that a sample is 2 m or less from the next."""
APART = 2.5
"""Between two samples, and the band in which a profile has not begun [dbar]."""
SILENT = 300.0
"""Shorter than a dive [s]."""


class Listener:
    """A shore that keeps what it hears as the station does."""

    def __init__(self, mission: Mission) -> None:
        self.start = mission.scenario.start_time.timestamp()
        draw = random.Random(1)
        guard = Guard.unsigned(255)
        self.end = ShoreEnd(ShoreSettings(SYSTEM, 115_200.0), guard, draw, draw.randbytes, MemoryDisk(), self.start)
        clock = VehicleClock(utc=lambda: self.start, monotonic=lambda: 0.0)
        self.ingest = Ingest(SYSTEM, clock, self.end.heard)

    def take(self, data: bytes, t: float) -> None:
        self.ingest.hear(data, self.end.session.take(data, self.start + t), self.start + t)

    def poll(self, t: float, room: int) -> bytes:
        return self.end.poll(self.start + t, room)


class Flight:
    """A flight without a tether: what came by radio, the log, and what the simulator says."""

    def __init__(self, mission: Mission, folder: Path) -> None:
        shore, logbook = Listener(mission), logbook_in(folder / "log", mission)
        flown: Flown = fly(System(mission, logbook, shore=shore), logbook=logbook)
        self.radio: Batch = shore.ingest.batch()
        self.logs = {path.name: path.read_bytes() for path in (folder / "log").iterdir()}
        write_netcdf(dataset_of(flown), folder / "truth.nc")
        with xr.open_dataset(folder / "truth.nc", decode_times=False) as truth:
            self.truth = truth.load()
        start = np.datetime64(mission.scenario.start_time.replace(tzinfo=None), "s").astype(np.int64)
        self.start = float(start)


@pytest.fixture(scope="module")
def flight(trial: Mission, tmp_path_factory: pytest.TempPathFactory) -> Flight:
    return Flight(trial, tmp_path_factory.mktemp("flight"))


def longest_silence(client: Client, channel: str, begin: float, end: float) -> float:
    """Between two values in a range [s]."""
    found = client.get("/vehicles/1/series", channels=channel, begin=begin, end=end, points=20_000, method="raw")
    told = found["channels"][channel]
    known = [t for t, value in zip(told["t"], told["value"], strict=True) if value is not None]
    return float(np.max(np.diff([begin, *known, end])))


def profiles(client: Client) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = client.get("/vehicles/1/profiles")
    return found


def require_complete(client: Client, truth: xr.Dataset) -> None:
    """Each profile of the simulator is there, with its water, to within what a sample each ten seconds tells."""
    time, number = truth["sample_time"].values, truth["sample_profile"].values
    ours = [client.get(f"/vehicles/1/profiles/{row['number']}")["values"] for row in profiles(client)]
    compared = 0
    for profile in np.unique(number[number > 0]):
        inside = number == profile
        t, p = time[inside], truth["sample_pressure"].values[inside]
        if t.size < 10:
            continue  # the flight ends in it
        middle = float(np.median(t))
        values = next(v for v in ours if v["time"][0] <= middle <= v["time"][-1])
        columns = {name: np.array(v, dtype=float) for name, v in values.items()}
        under_way = columns["time"] <= t[-1] + CTD_EVERY  # at the surface the CTD is off
        columns = {name: v[under_way] for name, v in columns.items()}
        within = (t >= columns["time"][0]) & (t <= columns["time"][-1])
        assert len(columns["time"]) >= within.sum() - 1
        assert np.max(np.diff(columns["time"])) <= 1.5 * CTD_EVERY
        # a profile begins where the vehicle leaves the surface or the turning point, the simulator's with its phase
        assert np.min(columns["pressure"]) <= np.min(p) + APART
        assert np.max(columns["pressure"]) >= np.max(p) - APART
        for name, known, tolerance in (
            ("pressure", p, 0.5),
            ("temperature", truth["sample_temperature"].values[inside], 0.15),
        ):
            found = np.interp(t[within], columns["time"], columns[name])
            assert found == pytest.approx(known[within], abs=tolerance), (profile, name)
        compared += 1
    assert compared >= 15


def require_told(client: Client, flight: Flight) -> None:
    """What happened aboard stands once, at its time by the log, also what the radio said at the next surfacing."""
    contents = [read_log(data) for data in flight.logs.values()]
    happened = [
        (flight.start + record.values[0], record.values[2])
        for each in contents
        for record in each.records
        if record.kind == "event" and record.values[1] == "executive"
    ]
    assert len(happened) > 10
    told = client.get("/vehicles/1/texts", limit=1000)
    for t, words in happened:
        found = [one["t"] for one in told if one["words"] == words and abs(one["t"] - t) < CTD_EVERY]
        assert found == [pytest.approx(t, abs=1.5)], words
    assert {words for _, words in happened} >= {words for _, _, words in flight.radio.texts if ": control" in words}
    assert len({one["t"] for one in told if one["words"].startswith("mission: ascent")}) == sum(
        words.startswith("mission: ascent") for _, words in happened
    )


def test_a_log_that_is_fetched_fills_what_the_radio_left_out(flight: Flight, tmp_path: Path) -> None:
    with served() as vehicle, station(tmp_path, vehicle.address) as found:
        found.archive.store(1, flight.radio._replace(frames=()))
        client = Client(found)
        dives = client.get("/vehicles/1/dives")
        first = dives[0]
        assert len(dives) >= 7
        assert longest_silence(client, "depth_m", first["t_begin"], first["t_end"]) > SILENT
        for name, data in flight.logs.items():
            vehicle.files.files["log", name] = data
            client.post("/vehicles/1/transfers", {"path": f"log/{name}"})

        def is_in_the_archive() -> bool:
            told = [row["log"]["state"] for row in client.get("/vehicles/1/files")]
            return told == ["taken"] * len(flight.logs)

        until(is_in_the_archive, within=120.0)
        assert sum(row["log"]["dives"] for row in client.get("/vehicles/1/files")) >= len(dives)
        for channel in ("depth_m", "pitch_deg", "ballast_ml", "latitude_deg"):
            assert longest_silence(client, channel, first["t_begin"], first["t_end"]) <= 2.0
        after = client.get("/vehicles/1/dives")
        assert [row["t_begin"] for row in after[: len(dives)]] == [row["t_begin"] for row in dives]  # none twice
        require_complete(client, flight.truth)
        require_told(client, flight)
