"""Positions that can be true. Oracle: a vehicle that swims at 0.3 m/s, and what was put among its positions.

socib/glider_toolbox#2: after a reboot positions of 0, 0 stand in the data. They and leaps that are faster than 5 m/s
never become positions; the archive keeps what was told.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stommel.archive import Archive, Batch, DiveRow
from stommel.archive.schema import mission_history, missions
from stommel.archive.whereabouts.dive_ends import made_good, with_true_ends
from stommel.archive.whereabouts.sift import Places, believed
from stommel.archive.whereabouts.span import span_of
from stommel.archive.whereabouts.track import read_track

T0 = 1_700_000_000.0
DAY = 86_400.0
DEGREE = 111_195.0


def sailed(count: int, period: float = 5.0, sigma: float = 10.0) -> Places:
    """To the north at 0.3 m/s, in the East China Sea."""
    t = T0 + period * np.arange(count, dtype=np.float64)
    return Places(t, 30.0 + 0.3 * (t - T0) / DEGREE, np.full(count, 123.0), np.full(count, sigma))


def test_zero_zero_after_a_reboot_is_no_position() -> None:
    """socib/glider_toolbox#2; the reboot takes ten minutes, longer than any course needs to be believed."""
    places = sailed(2000)
    wrong = np.zeros(2000, dtype=bool)
    wrong[700:820] = wrong[0] = wrong[-1] = True
    for values in (places.latitude, places.longitude):
        values[wrong] = 0.0
    assert np.array_equal(believed(places), ~wrong)


@given(
    st.lists(
        st.tuples(st.integers(0, 999), st.integers(1, 12), st.floats(-80.0, 80.0), st.floats(-179.0, 179.0)), max_size=6
    )
)
def test_leaps_are_left_out_and_nothing_else(leaps: list[tuple[int, int, float, float]]) -> None:
    """For less than a minute each it stands elsewhere, also at the begin and the end, also leaping on from there."""
    places, wrong = sailed(1000), np.zeros(1000, dtype=bool)
    for first, count, latitude, longitude in leaps:
        if abs(latitude - 30.0) > 0.1 or abs(longitude - 123.0) > 0.1:
            chosen = slice(first, first + count)
            places.latitude[chosen], places.longitude[chosen], wrong[chosen] = latitude, longitude, True
    runs = np.diff(np.flatnonzero(np.diff(np.concatenate([[False], wrong, [False]]).astype(int))))[::2]
    if runs.max(initial=0) < 24:  # 2 min: what goes on for so long may be true
        assert np.array_equal(believed(places), ~wrong)


def test_an_hour_elsewhere_from_which_it_comes_back_at_once_was_never_sailed() -> None:
    places = sailed(3000)
    places.latitude[1000:1720] += 2.0
    found = believed(places)
    assert not found[1000:1720].any()
    assert found[:1000].all()
    assert found[1720:].all()


def test_a_correction_that_stays_is_believed_on_both_sides() -> None:
    """A dive of an hour was reckoned 3 km wrong, and its standard deviation told as 10 m."""
    places = sailed(2000)
    places.longitude[1000:] += 3000.0 / DEGREE
    assert believed(places).all()


def test_a_vehicle_that_a_ship_carried_is_believed_where_it_swims() -> None:
    """Two days at the quay, half a day at 10 m/s, a day at sea, and back; nothing of the sea is a detour."""
    quay = sailed(2 * 1440, 60.0)
    there, sea = sailed(720, 60.0), sailed(1440, 60.0)
    far = 10.0 * (there.t - T0) / DEGREE
    t = T0 + 60.0 * np.arange(2 * 1440 + 720 + 1440, dtype=np.float64)
    latitude = np.concatenate([quay.latitude, 30.5 + far, 30.5 + far[-1] + sea.latitude - 30.0])
    found = believed(Places(t, latitude, np.full(t.size, 123.0), np.full(t.size, 10.0)))
    assert found[:2880].all()
    assert found[3610:].all()
    assert np.count_nonzero(found[2880:3600]) < 10


def test_the_uncertainty_that_is_told_is_allowed_for() -> None:
    """Four kilometres in 5 s, and back: more than it swims, less than it may be wrong."""
    for sigma, is_true in ((10.0, False), (1000.0, True)):
        places = sailed(1000, sigma=sigma)
        places.latitude[500] += 4000.0 / DEGREE
        assert bool(believed(places)[500]) is is_true


def test_the_date_line_is_no_leap() -> None:
    places = sailed(1000)
    places.longitude[:500], places.longitude[500:] = 179.99999, -179.99999
    assert believed(places).all()


def test_the_first_of_two_positions_far_apart_is_believed() -> None:
    two = Places(*(np.array(one) for one in ([0.0, 5.0], [30.0, 50.0], [123.0, 3.0], [9.0, 9.0])))
    assert believed(two).tolist() == [True, False]
    assert believed(sailed(0)).tolist() == []


def store(archive: Archive, places: Places) -> None:
    archive.know(1, "one", "zju")
    rows = zip(*(values.tolist() for values in places), strict=True)
    archive.store(1, Batch(samples=[
        sample for t, latitude, longitude, sigma in rows for sample in (
            ("latitude_deg", t, latitude), ("longitude_deg", t, longitude), ("position_sigma_m", t, sigma),
        )
    ]))  # fmt: skip


def test_a_track_of_days_is_thinned_and_sifted_and_the_archive_keeps_all(archive: Archive) -> None:
    """Three days at a position in 6 s, with a reboot and a leap each day: what is shown lies on the way."""
    places = sailed(43_200, 6.0)
    for day in range(3):
        at = 14_400 * day + 7000
        places.latitude[at : at + 10], places.longitude[at : at + 10] = 0.0, 0.0
        places.latitude[at + 3000 : at + 3002] += 5.0
    store(archive, places)
    track = read_track(archive, 1, T0, T0 + 3 * DAY, 500)
    assert 200 <= len(track.t) <= 502
    assert track.latitude == pytest.approx([30.0 + 0.3 * (t - T0) / DEGREE for t in track.t], abs=1e-5)
    assert set(track.longitude) == {123.0}
    assert (track.t[0], track.t[-1]) == (T0, places.t[-1])
    assert track.left_out > 0
    assert archive.series(1, "latitude_deg", T0, T0 + 3 * DAY, 500).value.min() == 0.0


def test_a_thinned_track_shows_each_surfacing(archive: Archive) -> None:
    """Every four hours it has fixes for a minute: of 18 surfacings each is there."""
    places = sailed(43_200, 6.0)
    store(archive, places)
    archive.store(1, Batch(samples=[("fix_age_s", t, max(0.0, (t - T0) % 14_400.0 - 60.0)) for t in places.t.tolist()]))
    track = read_track(archive, 1, T0, T0 + 3 * DAY, 300)
    fixes = [t for t, source in zip(track.t, track.source, strict=True) if source == "gps"]
    assert {int((t - T0) // 14_400.0) for t in fixes} == set(range(18))
    assert len(track.t) <= 302


def test_a_track_ends_where_it_is_wanted(archive: Archive) -> None:
    """A replay shows nothing of later: not the end of the cell in which it stands."""
    store(archive, sailed(43_200, 6.0))
    until = T0 + 2 * DAY + 1234.5
    track = read_track(archive, 1, T0, until, 500)
    assert until - 6.0 <= track.t[-1] <= until


def switched(archive: Archive, t: float, user: str | None) -> None:
    with archive.writing() as connection:
        row = {"vehicle_id": 1, "t_us": int(t * 1e6), "user": user, "name": "m", "sha256": "", "orders": "",
               "state": "aboard"}  # fmt: skip
        number = connection.execute(missions.insert().values(row).returning(missions.c.id)).scalar_one()
        told = {"mission_id": number, "t_us": int(t * 1e6), "state": "aboard"}
        connection.execute(mission_history.insert().values(told))


def test_a_span_ends_with_the_last_position_and_begins_with_day_mission_or_all(archive: Archive) -> None:
    """Oracles: it told positions for five days, and is silent for two when somebody asks."""
    assert span_of(archive, 1, "mission", T0) == (T0, T0)
    store(archive, sailed(5 * 144 + 1, 600.0))
    last, now = T0 + 5 * DAY, T0 + 7 * DAY
    assert span_of(archive, 1, "day", now) == (last - DAY, last)
    assert span_of(archive, 1, "all", now) == (T0, last)
    assert span_of(archive, 1, "mission", now) == (T0, last), "no mission is known"
    switched(archive, T0 + 2 * DAY, "ling")
    assert span_of(archive, 1, "mission", now) == (T0 + 2 * DAY, last)
    switched(archive, last - 600.0, "ling")
    assert span_of(archive, 1, "mission", now) == (last - DAY, last), "no less than a day"
    assert span_of(archive, 1, "mission", T0 + 4 * DAY) == (T0 + 2 * DAY, T0 + 4 * DAY), "as it was then"
    assert span_of(archive, 1, "mission", T0 + DAY) == (T0, T0 + DAY), "no mission was known then"


def test_ends_of_dives_are_sifted_too() -> None:
    good = DiveRow(1, T0, T0 + 3600.0, 30.0, 123.0, 30.01, 123.0)
    assert with_true_ends(good) == good
    reset = with_true_ends(good._replace(latitude_begin=0.0, longitude_begin=0.0))
    assert reset == good._replace(latitude_begin=None, longitude_begin=None)
    leapt = with_true_ends(good._replace(latitude_end=31.0))
    assert [leapt.latitude_begin, leapt.longitude_begin, leapt.latitude_end, leapt.longitude_end] == [None] * 4


def test_a_dive_makes_good_what_lies_between_its_ends() -> None:
    """Oracle: lengths on WGS 84 of a minute of latitude and of longitude at 30 deg: 1847.54 m and 1608.11 m."""
    north = made_good(DiveRow(1, T0, T0 + 3600.0, 30.0, 123.0, 30.0 + 1.0 / 60.0, 123.0))
    assert north is not None
    assert (north.distance_m, north.bearing_deg) == (pytest.approx(1847.54, abs=0.2), pytest.approx(0.0, abs=1e-6))
    west = made_good(DiveRow(1, T0, T0 + 3600.0, 30.0, -180.0 + 1.0 / 120.0, 30.0, 180.0 - 1.0 / 120.0))
    assert west is not None
    assert (west.distance_m, west.bearing_deg) == (pytest.approx(1608.11, abs=0.2), pytest.approx(270.0, abs=0.01))
    assert made_good(DiveRow(2, T0, T0 + 3600.0, 30.0, 123.0)) is None
