"""A real station beside a vehicle that answers as one does: files, parameters, missions, commands; over a slow line.

Its disk is full while a test wants that.
"""

import hashlib
import sqlite3
import sys
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import NamedTuple

from stommel.archive import Archive, Batch, DiveRow
from stommel.station.vehicles.mission_rows import ABOARD, REPLACED, MissionRow, MissionRows
from tests.link.files.fakes import noise
from tests.page.conftest import serve
from tests.plans.plans import place, plan_with
from tests.station.served import Served, served
from tests.support.orders import ORDERS

RATE = 100_000.0
"""Of the line [bit/s]."""
BEFORE, NOW = ORDERS.replace("There and back", "The way before"), ORDERS
"""The mission that the vehicle held before, and the one that it holds."""
SHORT, LONG = ("missions", "chart.bin"), ("missions", "survey.bin")
"""Files aboard: of some seconds, and of minutes."""
LOGS = ("00003-000001-essential.log", "00003-000002-essential.log")
"""Of the vehicle's log; they come ashore by themselves."""
FILES = {SHORT: noise(60_000), LONG: noise(2_000_000, 1)} | {("log", each): noise(500, 2) for each in LOGS}
FENCE = ((29.7, 119.6), (30.5, 119.6), (30.5, 120.5), (29.7, 120.5))
"""Corners of the plan of the mission aboard [deg]; around its waypoints and the dives."""
HOUR = 3600.0
TRACK = [{"t": 0.0, "lat": 29.8, "lon": 120.0}, {"t": 3.0 * HOUR, "lat": 30.1, "lon": 120.0}]
"""That the preview foretold: straight north."""


class Quay(NamedTuple):
    """Where the station answers, the vehicle, and what its past holds."""

    address: str
    vehicle: Served
    begin: float
    """When the mission began [s since 1970]."""
    archive: Path
    """The file of its archive."""
    full: Path
    """While this file is there, the disk is full."""

    @contextmanager
    def full_disk(self) -> Iterator[None]:
        """Leave the archive no room until the block ends, nor in pages of it that others have left."""
        with closing(sqlite3.connect(self.archive, timeout=60.0)) as archive:
            archive.execute("VACUUM")
        self.full.touch()
        try:
            yield
        finally:
            self.full.unlink()


def predicted(number: int, begin: float) -> dict[str, float | None]:
    """A dive of the preview: each an hour, 100 m deep, a tenth of a degree to the north, 10 kJ."""
    latitude = 29.8 + 0.1 * number
    return {
        "dive": number, "t_begin": begin + (number - 1) * HOUR, "t_end": begin + number * HOUR,
        "latitude_begin": latitude - 0.1, "longitude_begin": 120.0, "latitude_end": latitude, "longitude_end": 120.0,
        "greatest_depth_m": 100.0, "current_north_m_s": None, "current_east_m_s": None, "energy_j": 10_000.0,
    }  # fmt: skip


def fill(database: str, begin: float) -> None:
    """Write down the mission aboard with its plan and preview, the one before, and a dive of before and one of it."""
    missions = [(BEFORE, REPLACED, None, None), (NOW, ABOARD, plan_with(geofence=[place(*each) for each in FENCE]),
                {"dives": [predicted(number, begin) for number in (1, 2, 3)], "track": TRACK})]  # fmt: skip
    first = predicted(1, begin)
    with Archive.open(database) as archive:
        archive.know(1, "Quay", "zju")
        for k, (orders, state, plan, preview) in enumerate(missions):
            name = orders.split('mission = "')[1].split('"')[0]
            sha256 = hashlib.sha256(orders.encode()).hexdigest()
            row = MissionRow(0, 1, begin - HOUR + k * HOUR, "ada", name, sha256, orders, plan, state)
            MissionRows(archive).add(row, "taken by the vehicle, whole", preview)
        flown = first | {"dive": 8, "t_begin": begin + 60.0, "t_end": begin + HOUR + 120.0,
                         "latitude_end": 29.91, "greatest_depth_m": 97.0, "energy_j": 11_500.0}  # fmt: skip
        archive.store(1, Batch(dives=[DiveRow(7, begin - HOUR, begin - 60.0), DiveRow(**flown)]))  # type: ignore[arg-type]


@contextmanager
def quay_station(folder: Path) -> Iterator[Quay]:
    """The station until the block ends."""
    begin = float(int(time.time())) - 3.0 * HOUR
    archive, full = folder / "archive.sqlite", folder / "full"
    database = f"sqlite:///{archive}"
    fill(database, begin)
    with served(RATE) as vehicle:
        vehicle.missions.files = [BEFORE.encode(), NOW.encode()]
        vehicle.files.files |= FILES
        vehicle.files.folders.add(("log",))
        settings = folder / "station.toml"
        settings.write_text(
            f'[[vehicles]]\nvehicle = 1\nlink = "{vehicle.address}"\nunsigned = true\nfetch = "essential"\n'
        )
        program = [sys.executable, "-m", "tests.page.narrow_disk", str(full)]
        told = ["--folder", str(folder), "--database", database, "--settings", str(settings), "--port", "0"]
        for process, address in serve([*program, "station", *told]):
            yield Quay(address, vehicle, begin, archive, full)
            assert process.poll() is None, "the station ended during the test"
