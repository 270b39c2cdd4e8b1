"""`stommel station backup, export, check, migrate` as their users call them."""

import csv
from pathlib import Path

import pytest
import xarray as xr

from stommel.archive import Archive, Batch, CtdRow, FrameRow
from stommel.archive.migrating import CURRENT
from tests.support.command import Command

T = 1_700_000_000.0  # 2023-11-14T22:13:20Z


@pytest.fixture
def sea(tmp_path: Path) -> Path:
    """An archive of one vehicle that dived once."""
    file = tmp_path / "sea.sqlite"
    depths = [min(k, 120 - k) / 2 for k in range(121)]
    with Archive.open(str(file)) as archive:
        archive.know(1, "Kelp", "zju")
        samples = [("depth_m", T + k, depth) for k, depth in enumerate(depths)]
        samples += [("latitude_deg", T + k, 30.0 + k * 1e-5) for k in range(0, 121, 30)]
        samples += [("longitude_deg", T + k, 122.0) for k in range(0, 121, 30)]
        ctd = [CtdRow(T + k, 1, 1.01 * depth, 20.0 - depth / 10, 4.5) for k, depth in enumerate(depths)]
        archive.store(1, Batch([FrameRow(T, "in", 1, 1, 0, 0, True, b"frame")], samples, ctd=ctd))
    return file


def test_a_backup_is_an_archive(stommel: Command, sea: Path) -> None:
    made = stommel("station", "backup", "--database", sea, "copy.sqlite", "--json")
    assert made.status == 0, made.err
    assert made.json["written"] == ["copy.sqlite"]
    with Archive.open(str(sea.with_name("copy.sqlite"))) as copy:
        assert copy.vehicles() == {1: "Kelp"}
        assert copy.latest(1)["depth_m"] == (T + 120, 0.0)


def test_telemetry_as_csv_is_every_sample(stommel: Command, sea: Path) -> None:
    arguments = ("--database", sea, "--vehicle", 1, "--what", "telemetry", "--output", "all.csv")
    made = stommel("station", "export", *arguments, "--end", "2023-11-14T22:13:30")
    assert made.status == 0, made.err
    rows = list(csv.reader(sea.with_name("all.csv").read_text(encoding="utf-8").splitlines()))
    assert rows[0] == ["time [UTC]", "channel", "value"]
    assert rows[1] == ["2023-11-14T22:13:20.000Z", "depth_m", "0.0"]
    assert [float(row[2]) for row in rows if row[1] == "depth_m"] == [k / 2 for k in range(11)]
    assert [row[1] for row in rows[12:]] == ["latitude_deg", "longitude_deg"]


def test_telemetry_as_netcdf_is_every_sample(stommel: Command, sea: Path) -> None:
    arguments = ("--database", sea, "--vehicle", 1, "--what", "telemetry", "--output", "all.nc")
    made = stommel("station", "export", *arguments, "--end", "2023-11-14T22:13:30")
    assert made.status == 0, made.err
    with xr.open_dataset(sea.with_name("all.nc"), decode_times=False) as samples:
        assert samples["time"].values.tolist() == [T + k for k in range(11)]
        assert samples["depth_m"].values.tolist() == [k / 2 for k in range(11)]
        assert samples["latitude"].values == pytest.approx([30.0 + k * 1e-5 for k in range(11)])


def test_samples_of_the_ctd_as_netcdf_and_csv(stommel: Command, sea: Path) -> None:
    for name in ("sea.nc", "sea.csv"):
        made = stommel("station", "export", "--database", sea, "--vehicle", 1, "--output", name)
        assert made.status == 0, made.err
        assert "121 samples" in made.out
    with xr.open_dataset(sea.with_name("sea.nc"), decode_times=False) as samples:
        assert samples.sizes["obs"] == 121
        assert float(samples["pressure"].max()) == pytest.approx(1.01 * 30)
        assert float(samples["time"][0]) == pytest.approx(T)
    assert len(sea.with_name("sea.csv").read_text(encoding="utf-8").splitlines()) == 122


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--vehicle", 2, "--output", "x.nc"), "nothing of vehicle 2 is there; there are: 1 (Kelp)"),
        (("--vehicle", 1, "--output", "x.txt"), "the name must end with .nc or .csv"),
        (("--vehicle", 1, "--output", "x.nc", "--begin", "2030-01-01"), "no samples of the CTD in this time"),
        (("--vehicle", 1, "--output", "x.nc", "--begin", "noon"), "must be like"),
        (("--vehicle", 1, "--output", "x.nc", "--end", "1999-01-01", "--begin", "2000-01-01"), "must not be before"),
        (
            ("--vehicle", 1, "--output", "x.nc", "--begin", "1912-01-01"),
            "--begin 1912-01-01: allowed are times from 1970",
        ),
        (
            ("--vehicle", 1, "--output", "x.csv", "--what", "telemetry", "--end", "2400-01-01"),
            "--end 2400-01-01: allowed",
        ),
    ],
)
def test_an_export_that_cannot_be_says_why_and_writes_nothing(
    stommel: Command, sea: Path, arguments: tuple[object, ...], words: str
) -> None:
    made = stommel("station", "export", "--database", sea, *arguments)
    assert made.status == 2
    assert words in made.err
    assert [path.name for path in sea.parent.iterdir()] == ["sea.sqlite"]


def test_a_sound_archive_is_told_to_be_sound(stommel: Command, sea: Path) -> None:
    found = stommel("station", "check", "--database", sea)
    assert found.status == 0, found.err
    assert "sound" in found.out
    assert "131 rows" in found.out


def test_an_archive_that_is_not_sound_is_told_by_words_and_status(stommel: Command, sea: Path) -> None:
    from sqlalchemy import text

    with Archive.open(str(sea)) as archive, archive.writing() as connection:
        connection.execute(text("UPDATE minutes SET high = high + 1"))
    found = stommel("station", "check", "--database", sea, "--json")
    assert found.status == 1
    assert any("minutes do not fit the samples" in words for words in found.json["problems"])


def test_migrate_leaves_an_archive_of_today_as_it_is(stommel: Command, sea: Path) -> None:
    done = stommel("station", "migrate", "--database", sea)
    assert done.status == 0, done.err
    assert f"up to date ({CURRENT})" in done.out


@pytest.mark.parametrize(
    "verb", [("backup", "copy"), ("check",), ("migrate",), ("export", "--vehicle", 1, "--output", "x.nc")]
)
def test_no_verb_makes_an_archive(stommel: Command, tmp_path: Path, verb: tuple[object, ...]) -> None:
    done = stommel("station", *verb, "--database", "none.sqlite")
    assert done.status == 2
    assert "there is no archive" in done.err
    assert list(tmp_path.iterdir()) == []
