"""The samples of a vehicle at the shore station: five million of the CTD, of which any view is answered."""

import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
from sqlalchemy import text

from figures.registry import Measurement, figure
from figures.timing import seconds
from stommel.archive import Archive, Batch, CtdRow
from stommel.archive.cells import LEVELS
from stommel.products.record import SampleRecords

DAY = 86400
DAYS = 58
DIVE_S = 2400
BEGIN = 19_675 * DAY
"""A midnight [s since 1970]."""
REPEATS = 5


@figure(unit="ms", bar=500.0)
def station_profile_query_ms() -> Measurement:
    """Measure the slowest answer of 5 million samples: a profile, all of them, section and T-S of a day [ms]."""
    with tempfile.TemporaryDirectory() as folder, Archive.open(str(Path(folder) / "ctd.sqlite")) as archive:
        _fill(archive)
        records = SampleRecords(archive)
        (first,) = seconds(lambda: records.profiles(1), 1)
        (after_restart,) = seconds(lambda: SampleRecords(archive).profiles(1), 1)
        taken = {name: min(seconds(ask, REPEATS)) * 1e3 for name, ask in _questions(records).items()}
        samples = records.count(1, 0.0, 4e9)
    about = {"asked_ms": taken, "samples": samples, "first_s": first, "after_restart_s": after_restart}
    return Measurement(max(taken.values()), about)


def _questions(records: SampleRecords) -> dict[str, Callable[[], object]]:
    begin = BEGIN + DAYS * DAY / 2
    names = ("absolute_salinity", "conservative_temperature", "depth")
    return {
        "profile": lambda: records.profile(1, 1000),
        "profiles": lambda: records.lines(1, 0.0, 4e9),
        "section": lambda: records.section(1, "conservative_temperature", begin, begin + DAY, 1.0),
        "diagram": lambda: list(records.thinned(1, begin, begin + DAY, names)),
    }


def _fill(archive: Archive) -> None:
    """Store a day of dives to 100 m, a sample a second, and copy it to the other days."""
    k = np.arange(DAY)
    depth = 200.0 * np.minimum(k % DIVE_S, DIVE_S - k % DIVE_S) / DIVE_S
    rows = [
        CtdRow(float(BEGIN + i), i // DIVE_S + 1, z * 1.009, 20.0 - 0.1 * z, 4.2 + 0.001 * z)
        for i, z in zip(k.tolist(), depth.tolist(), strict=True)
    ]
    places = [(key, float(BEGIN + i), value) for i in range(0, DAY, 60) for key, value in _PLACE]
    archive.store(1, Batch(samples=places, ctd=rows))
    with archive.writing() as connection:
        for day in range(1, DAYS):
            later = day * DAY * 1_000_000
            connection.execute(text(_CTD), {"later": later, "end": (BEGIN + DAY) * 1_000_000})
            connection.execute(text(_HOURS), {"later": day * 24, "end": (BEGIN + DAY) // 3600})
            for level in LEVELS:
                width = level.width_us // 1_000_000
                cells = {"cells": day * DAY // width, "later": later, "end": (BEGIN + DAY) // width}
                connection.execute(text(_CELLS.format(level.table.name, level.table.c[2].name)), cells)


_PLACE = (("latitude_deg", 28.0), ("longitude_deg", 126.0))
_CTD = (
    "INSERT INTO ctd (vehicle_id, t_us, dive, pressure_dbar, temperature_degc, conductivity_s_m)"
    " SELECT vehicle_id, t_us + :later, dive, pressure_dbar, temperature_degc, conductivity_s_m"
    " FROM ctd WHERE t_us < :end ORDER BY t_us"
)
_HOURS = (
    "INSERT INTO ctd_hours (vehicle_id, hour, count, change)"
    " SELECT vehicle_id, hour + :later, count, change FROM ctd_hours WHERE hour < :end"
)
_CELLS = (
    "INSERT INTO {0} SELECT vehicle_id, channel_id, {1} + :cells, count, total, first_t_us + :later, first,"
    " last_t_us + :later, last, low_t_us + :later, low, high_t_us + :later, high FROM {0} WHERE {1} < :end"
)
