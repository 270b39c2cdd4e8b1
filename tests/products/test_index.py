"""Profiles that are kept up are those of the whole record. Oracle: all samples at once, by `stommel.data.profiles`."""

import random
from pathlib import Path

import numpy as np
import pytest
from pyproj import Geod

from stommel.archive import Archive, Batch, CtdRow
from stommel.archive.ctd_reading import count_between
from stommel.data.profiles import profiles_of
from stommel.geometry.geodesics import lengths_along
from stommel.products import index
from stommel.products.index import ProfileIndex
from stommel.products.record import SampleRecords

BEGIN = 1_782_864_000.0
WGS84_DEGREE_AT_30_5 = 110_860.0
"""Length of the degree of latitude from 30 to 31 deg [m]."""


def mission(seed: int, dives: int = 12) -> list[CtdRow]:
    """Dives of any depth, waits, silences of any length, noise, and pressures that are missing."""
    draw = random.Random(seed)
    t, rows = BEGIN, []
    for dive in range(1, dives + 1):
        depth = draw.uniform(2.0, 80.0)
        way = [*np.arange(0.0, depth, 1.0), *np.arange(depth, 0.0, -1.3), *([0.0] * draw.randrange(40))]
        for p in way:
            t += draw.choice([1.0, 4.0, 4.0, 30.0])
            known = None if draw.random() < 0.02 else p + draw.gauss(0.0, 0.3)
            rows.append(CtdRow(t, dive, known, 10.0, 4.0))
        t += draw.choice([10.0, 300.0, 700.0, 5000.0])
    return rows


def store(archive: Archive, rows: list[CtdRow]) -> None:
    places = [
        (key, row.t, value) for row in rows[::20] for key, value in (("latitude_deg", 30.0), ("longitude_deg", 122.0))
    ]
    archive.store(1, Batch(samples=places, ctd=rows))


def expected(rows: list[CtdRow]) -> list[tuple[float, float, int]]:
    rows = sorted(rows)
    t = np.array([row.t for row in rows])
    p = np.array([np.nan if row.pressure_dbar is None else row.pressure_dbar for row in rows])
    return [(round(t[k.first], 3), round(t[k.last], 3), k.direction) for k in profiles_of(t, p)]


def known(found: ProfileIndex) -> list[tuple[float, float, int]]:
    lines = [each.line for each in found.profiles()]
    assert [line.number for line in lines] == list(range(1, len(lines) + 1))
    return [(round(line.begin, 3), round(line.end, 3), line.direction) for line in lines]


@pytest.mark.parametrize("seed", range(8))
def test_in_whatever_order_the_samples_come(tmp_path: Path, seed: int) -> None:
    """Live, late, and out of logs that fill holes; looked at after each."""
    rows, draw = mission(seed), random.Random(seed)
    cuts = sorted(draw.sample(range(1, len(rows)), 9))
    parts = [rows[a:b] for a, b in zip([0, *cuts], [*cuts, len(rows)], strict=True)]
    draw.shuffle(parts)
    with Archive.open(str(tmp_path / "a.sqlite")) as archive:
        found, stored = ProfileIndex(archive, 1), list[CtdRow]()
        for part in parts:
            store(archive, part)
            stored += part
            assert known(found) == expected(stored)
            assert known(ProfileIndex(archive, 1)) == expected(stored)  # as after a restart


def test_in_small_pieces_it_is_the_same(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pieces = index.ctd_pieces
    monkeypatch.setattr(index, "ctd_pieces", lambda *args: pieces(*args, size=37))
    rows = mission(99)
    with Archive.open(str(tmp_path / "a.sqlite")) as archive:
        store(archive, rows)
        assert known(ProfileIndex(archive, 1)) == expected(rows)


def test_what_is_known_is_not_read_again(tmp_path: Path) -> None:
    rows = mission(5, dives=60)
    last = rows[-1].t
    with Archive.open(str(tmp_path / "a.sqlite")) as archive:
        store(archive, rows)
        found = ProfileIndex(archive, 1)
        found.profiles()
        assert found.read == len(rows)
        found.profiles()
        assert found.read == len(rows)
        store(archive, [CtdRow(last + 4.0, 60, 1.0, 10.0, 4.0)])
        found.profiles()
        assert 0 < found.read - len(rows) < len(rows) / 4
        again = ProfileIndex(archive, 1)
        again.profiles()
        assert again.read == 0  # the archive keeps it over a restart
        before = found.read
        store(archive, [CtdRow(rows[len(rows) // 2].t + 0.5, 30, None, 10.0, 4.0)])  # of the past
        assert len(found.profiles()) == len(again.profiles())
        assert found.read - before <= 100_000


def test_two_that_keep_profiles_do_not_mix_them(tmp_path: Path) -> None:
    """A station and an export look at the same archive; the one who is late keeps nothing."""
    rows = mission(3)
    half = len(rows) // 2
    with Archive.open(str(tmp_path / "a.sqlite")) as archive:
        store(archive, rows[:half])
        one, other = ProfileIndex(archive, 1), ProfileIndex(archive, 1)
        one.profiles()
        other.profiles()
        store(archive, rows[half:])
        for found in (other, one, ProfileIndex(archive, 1)):
            assert known(found) == expected(rows)


def test_samples_are_counted_without_being_read(tmp_path: Path) -> None:
    rows = mission(1)
    times = [round(row.t * 1e6) for row in rows]
    draw = random.Random(1)
    with Archive.open(str(tmp_path / "a.sqlite")) as archive:
        store(archive, rows)
        with archive.reading() as connection:
            for _ in range(200):
                low, high = sorted(draw.choice(times) + draw.randrange(-2, 3) for _ in range(2))
                count = sum(low <= t <= high for t in times)
                assert count_between(connection, 1, low, high) == count
            assert count_between(connection, 1, 0, 10**16) == len(times)


def test_a_section_of_very_many_profiles_shows_some(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Oracle: the section of all, before which no profile was left out."""
    with Archive.open(str(tmp_path / "a.sqlite")) as archive:
        store(archive, mission(2))
        records = SampleRecords(archive)
        whole, one = records.section(1, "temperature", 0.0, 4e9, 1.0)
        assert one == 1
        assert whole.sizes["profile"] == len(records.profiles(1))
        monkeypatch.setattr("stommel.products.record.MOST_COLUMNS", 5)
        some, stride = records.section(1, "temperature", 0.0, 4e9, 1.0)
        assert stride > 1
        assert some.sizes["profile"] <= 5
        expected_one = whole.isel(profile=slice(None, None, stride)).sel(depth=some["depth"])
        assert (some["profile_number"].values == expected_one["profile_number"].values).all()
        # the sample at which one profile ends and the next begins is of the next, unless that is left out
        more = some["samples_in_cell"].values - expected_one["samples_in_cell"].values
        assert (more >= 0).all()
        assert (more.sum(axis=1) <= 1).all()


def test_the_distance_along_the_track_does_not_depend_on_what_is_shown(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Oracle: geodesics through the places of all profiles; one without a place lies nowhere, and the way goes past."""
    rows = mission(2)
    places = [
        (key, row.t, value)
        for row in rows
        for key, value in (
            ("latitude_deg", 30.0 + 1e-3 * np.sin(row.t / 9e3)),
            ("longitude_deg", 122.0 + row.t % 1e5 * 1e-6),
        )
    ]
    with Archive.open(str(tmp_path / "a.sqlite")) as archive:
        archive.store(1, Batch(samples=places, ctd=rows))
        records = SampleRecords(archive)
        lines = [found.line for found in records.profiles(1)]
        there = [(line.longitude, line.latitude) for line in lines]
        expected_m = [Geod(ellps="WGS84").line_length(*zip(*there[: k + 1], strict=True)) for k in range(len(there))]
        whole, _ = records.section(1, "temperature", 0.0, 4e9, 1.0)
        assert whole["distance"].values == pytest.approx(expected_m)
        monkeypatch.setattr("stommel.products.record.MOST_COLUMNS", 5)
        some, stride = records.section(1, "temperature", 0.0, 4e9, 1.0)
        assert some["distance"].values == pytest.approx(expected_m[::stride])
    nowhere = lengths_along(np.array([30.0, np.nan, 31.0]), np.array([122.0, 122.0, 122.0]))
    assert nowhere == pytest.approx([0.0, np.nan, WGS84_DEGREE_AT_30_5], rel=1e-4, nan_ok=True)


def test_pieces_hold_each_sample_once_with_its_profile(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from stommel.products import record

    pieces = record.ctd_pieces
    monkeypatch.setattr(record, "ctd_pieces", lambda *args: pieces(*args, size=50))
    rows = mission(4)
    with Archive.open(str(tmp_path / "a.sqlite")) as archive:
        store(archive, rows)
        records = SampleRecords(archive)
        begin, end = rows[100].t, rows[-100].t
        made = list(records.pieces(1, begin, end))
        assert len(made) > 5
        times = np.concatenate([piece["time"].values for piece in made])
        assert np.round(times, 6).tolist() == [round(row.t, 6) for row in rows[100:-99]]
        number = np.concatenate([piece["profile_number"].values for piece in made])
        for line in records.lines(1, begin, end):
            inside = (times >= line.begin - 1e-6) & (times <= line.end + 1e-6)
            own = number[inside][:-1]  # the last sample may be the first of the next profile
            assert own.size
            assert set(own) == {line.number}
