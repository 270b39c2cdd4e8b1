"""Where the station says that a vehicle is. Oracle: what the test lets it say; the archive keeps all of it.

socib/glider_toolbox#2: positions of 0, 0 after a reboot stand in the raw data. They never become the position, nor
part of the track, nor that of a sample.
"""

import time
from pathlib import Path

import numpy as np
import pytest

from stommel.archive import Archive, Batch
from stommel.products.positions import positions
from stommel.station.vehicles.whereabouts import Whereabouts, position_of
from tests.station.client import Client
from tests.station.speaker import speaker, until
from tests.station.stations import station

T0 = 1_700_000_000.0


def told(t: float, latitude: float, longitude: float, sigma: float = 9.0) -> list[tuple[str, float, float]]:
    """What comes with a position, in the order in which it comes."""
    return [("position_sigma_m", t, sigma), ("fix_age_s", t, 1.0), ("latitude_deg", t, latitude),
            ("longitude_deg", t, longitude)]  # fmt: skip


def test_the_last_position_that_can_be_true_is_shown_with_why_later_ones_are_not() -> None:
    where = Whereabouts()
    assert where.last() == (None, "")
    where.take(told(T0, 0.0, 0.0))
    place, why = where.last()
    assert place is None
    assert "without a fix" in why
    for k in range(30):
        where.take(told(T0 + 5.0 + 5.0 * k, 30.0, 123.0))
    found = position_of(where.last())
    assert found == {
        "latitude": 30.0, "longitude": 123.0, "t": T0 + 150.0, "sigma_m": 9.0, "source": "gps", "doubt": None,
    }  # fmt: skip
    where.take(told(T0 + 155.0, 31.0, 123.0))
    place, why = where.last()
    assert place is not None
    assert (place.latitude, place.t) == (30.0, T0 + 150.0)
    assert why == "31.000, 123.000 was told since, which is farther than the vehicle can have come"
    for k in range(30):
        where.take(told(T0 + 160.0 + 5.0 * k, 31.0, 123.0))
    place, why = where.last()
    assert place is not None
    assert (place.latitude, why) == (31.0, ""), "what lasts is believed"


def test_a_clock_that_is_set_back_takes_what_is_told_then() -> None:
    where = Whereabouts()
    for k in range(10):
        where.take(told(T0 + 5.0 * k, 30.0, 123.0))
    where.take(told(T0 - 3600.0, 30.001, 123.0))
    place, _ = where.last()
    assert place is not None
    assert place.t == T0 - 3600.0


@pytest.fixture
def archive(tmp_path: Path) -> Archive:
    """An hour at one place, with a reboot of five minutes in its midst and another at its end."""
    archive = Archive.open(str(tmp_path / "archive.sqlite"))
    archive.know(1, "one", "zju")
    rows = []
    for k in range(720):
        away = 300 <= k < 360 or k >= 700
        rows += told(T0 + 5.0 * k, 0.0 if away else 30.0, 0.0 if away else 123.0)
    archive.store(1, Batch(samples=rows))
    return archive


def test_samples_and_a_restart_get_no_position_of_a_reboot(archive: Archive) -> None:
    with archive:
        latitude, longitude = positions(archive, 1, T0 + np.arange(0.0, 3600.0, 7.0))
        assert set(latitude.round(6)) == {30.0}
        assert set(longitude.round(6)) == {123.0}
        where = Whereabouts()
        where.restore(archive, 1, T0 + 3600.0)
        place, why = where.last()
        assert place is not None
        assert (place.latitude, place.t) == (30.0, T0 + 3495.0)
        assert why
        where.restore(archive, 1, T0 + 1000.0)
        assert where.last()[0] == (T0 + 1000.0, 30.0, 123.0, 9.0, 1.0), "as it was then, for a replay"
        assert archive.latest(1)["latitude_deg"][1] == 0.0


def test_zero_zero_is_told_by_no_summary_and_no_track(tmp_path: Path) -> None:
    now = time.time()
    with speaker() as vehicle, station(tmp_path, vehicle.address) as found:
        vehicle.connect()
        vehicle.say("SYSTEM_TIME", time_unix_usec=int(now * 1e6), time_boot_ms=100_000)
        for k in range(6):
            there = (0, 0) if k in (2, 5) else (290_000_000, 1_260_000_000)
            vehicle.say("GLOBAL_POSITION_INT", time_boot_ms=60_000 + 5000 * k, lat=there[0], lon=there[1])
        until(lambda: len(found.archive.series(1, "longitude_deg", now - 60, now + 60).t) == 6)
        client = Client(found)
        until(lambda: client.get("/vehicles/1")["position"]["doubt"])
        position = client.get("/vehicles/1")["position"]
        assert (position["latitude"], position["longitude"]) == (29.0, 126.0)
        assert position["t"] == pytest.approx(now - 20.0, abs=0.01)
        track = client.get("/vehicles/1/track", span="all")
        assert (set(track["latitude"]), len(track["t"]), track["left_out"]) == ({29.0}, 4, 2)
        raw = client.get("/vehicles/1/series", channels="latitude_deg", begin=now - 60, end=now)
        assert raw["channels"]["latitude_deg"]["value"].count(0.0) == 2
