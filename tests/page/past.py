"""A real station whose archive has a past, and a vehicle that says what a test wants."""

import math
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

import numpy as np

from stommel.archive import Archive, Batch, CtdRow, DiveRow
from tests.page.conftest import serve, station_command
from tests.station.speaker import Speaker, speaker

HOURS = 6
STEP = 2.0
"""Between samples [s]."""
DIVE = 3600.0
GAP = (2.2, 2.7)
"""Hours after the begin between which nothing was received."""
EARTH_M = 111_195.0


class Past(NamedTuple):
    """Where the station answers, and what it knows."""

    address: str
    database: str
    begin: float
    end: float
    speaker: Speaker


def values(key: str, t: float) -> float:
    """Of the vehicle at a time: hourly dives to 200 m, flown by a closed form."""
    turn = 2.0 * math.pi * (t % DIVE) / DIVE
    depth = 100.0 * (1.0 - math.cos(turn))
    wobble = math.sin(12.9898 * t) * 43758.5453
    noise = wobble - math.floor(wobble) - 0.5
    return {
        "depth_m": depth + 0.2 * noise,
        "pitch_deg": -26.0 * math.sin(turn) + noise,
        "roll_deg": 2.0 * noise,
        "heading_deg": 95.0 + 5.0 * math.sin(t / 700.0) + noise,
        "ballast_ml": -220.0 * math.sin(turn),
        "ballast_setpoint_ml": math.copysign(220.0, -math.sin(turn)),
        "phase": 1.0 if math.sin(turn) > 0.0 else 3.0,
        "latitude_deg": 30.0 + 0.25 * (t % (HOURS * DIVE)) / EARTH_M,
        "longitude_deg": 123.0,
    }[key]


KEYS = (
    "depth_m", "pitch_deg", "roll_deg", "heading_deg", "ballast_ml", "ballast_setpoint_ml", "phase", "latitude_deg",
    "longitude_deg",
)  # fmt: skip


def fill(database: str, begin: float, end: float) -> None:
    """Write what the vehicle sent between two times: samples, dives, the CTD's samples."""
    missing = [begin + hours * 3600.0 for hours in GAP]
    times = [t for t in np.arange(begin, end, STEP).tolist() if not missing[0] < t < missing[1]]
    first = math.ceil(begin / DIVE)
    with Archive.open(database) as archive:
        archive.know(1, "Donghai", "zju")
        for key in KEYS:
            archive.store(1, Batch(samples=[(key, t, values(key, t)) for t in times]))
        dives = [_dive(number, (first + number - 1) * DIVE) for number in range(1, int(end / DIVE) - first + 1)]
        archive.store(1, Batch(dives=dives, ctd=[row for dive in dives for row in _ctd(dive)]))
        archive.store(1, Batch(texts=[text for dive in dives for text in said(dive)]))


def said(dive: DiveRow) -> list[tuple[float, int, str]]:
    """What the vehicle says of a dive: time, severity, words."""
    return [
        (dive.t_begin, 6, f"mission: descent: dive {dive.dive}"),
        (dive.t_begin + DIVE / 2, 6, f"mission: ascent: dive {dive.dive}"),
    ]


def _dive(number: int, t: float) -> DiveRow:
    first = values("latitude_deg", t)
    last = first + 0.25 * DIVE / EARTH_M  # also where the closed form begins again, at each sixth hour of the day
    east = values("longitude_deg", t)
    return DiveRow(number, t, t + DIVE, first, east, last, east, 200.0, 0.1, 0.2, 12_000.0)


def _ctd(dive: DiveRow) -> list[CtdRow]:
    rows = []
    for t in np.arange(dive.t_begin, dive.t_begin + DIVE, 10.0).tolist():
        depth = 100.0 * (1.0 - math.cos(2.0 * math.pi * (t % DIVE) / DIVE))
        warm = 24.0 - 14.0 / (1.0 + math.exp(-(depth - 45.0) / 12.0))
        rows.append(CtdRow(t, dive.dive, depth * 1.0065, warm, 3.2 + 0.08 * warm))
    return rows


@contextmanager
def past_station(folder: Path) -> Iterator[Past]:
    """A station with six hours of the past until the block ends; its vehicle is connected and says nothing."""
    end = math.floor(time.time()) - 60.0
    begin = end - HOURS * 3600.0
    database = f"sqlite:///{folder / 'archive.sqlite'}"
    fill(database, begin, end)
    with speaker() as vehicle, station(folder, database, vehicle.address) as address:
        vehicle.connect()
        yield Past(address, database, begin, end, vehicle)


@contextmanager
def station(folder: Path, database: str, link: str) -> Iterator[str]:
    """Address of `stommel station` with one vehicle until the block ends."""
    told = ["--database", database, "--link", link, "--unsigned", "--model", "zju"]
    for process, address in serve(station_command(folder, *told)):
        yield address
        assert process.poll() is None, "the station ended during the test"
