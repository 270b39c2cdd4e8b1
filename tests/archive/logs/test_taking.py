"""What a log tells is in the archive as the vehicle wrote it. Oracle: the values and times that were written down."""

import math
from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from sqlalchemy import select

from stommel.archive import Archive, ArchiveBusyError, Batch, CtdRow, DiveRow
from stommel.archive.columns import metadata
from stommel.archive.log_tables import logs
from stommel.archive.logs import decoding
from stommel.archive.logs.decoding import AT_ONCE
from stommel.archive.logs.rows import GOING, REFUSED, TAKEN, LogRow
from stommel.archive.logs.taking import is_log, take_log
from stommel.archive.schema import ctd
from stommel.errors import FileError
from stommel.messages.log.reader import read_log
from stommel.station.channels import channel_named
from tests.archive.logs.written import CTD_EVERY, DIVE, STAY, UTC, current_of, depth_at
from tests.archive.logs.written import logs as written

PERIOD = DIVE + STAY


def no_rest(_seconds: float) -> None:
    """Tests need not wait."""


def take(archive: Archive, data: bytes, name: str = "a.log", told: Callable[[LogRow], bool] = lambda _: True) -> LogRow:
    return take_log(archive, 1, data, name, told, rest=no_rest)


def content(archive: Archive) -> dict[str, list[tuple[Any, ...]]]:
    """Everything that is there, but for when it was written."""
    with archive.reading() as connection:
        return {
            name: sorted(
                (tuple(row) for row in connection.execute(
                    select(*(c for c in table.c if c.name not in ("changed_us", "added_us", "change", "ctd_changes")))
                )),
                key=repr,
            )
            for name, table in metadata.tables.items()
        }  # fmt: skip


def series(archive: Archive, key: str) -> dict[int, float]:
    """Values by second of the run."""
    found = archive.series(1, key, UTC - 1.0, UTC + 10_000.0, 20_000, "raw")
    known = np.isfinite(found.value)
    return {round(t - UTC): v for t, v in zip(found.t[known].tolist(), found.value[known].tolist(), strict=True)}


@pytest.fixture(scope="module")
def files() -> dict[str, bytes]:
    return written()


@pytest.fixture
def essential(files: dict[str, bytes]) -> bytes:
    return next(data for name, data in files.items() if "essential" in name)


def test_values_are_those_of_the_vehicle_at_its_times(archive: Archive, files: dict[str, bytes]) -> None:
    rows = [take(archive, data, name) for name, data in files.items()]
    assert {row.state for row in rows} == {TAKEN}
    assert all(row.words.startswith("whole") for row in rows)
    for second, depth in series(archive, "depth_m").items():
        assert depth == pytest.approx(depth_at(second))
    assert len(series(archive, "depth_m")) == 3 * PERIOD
    expected = {
        "pitch_deg": math.degrees(-0.5), "heading_deg": 180.0, "roll_deg": 0.0, "ballast_ml": 250.0,
        "moving_mass_mm": 12.5, "steering_deg": math.degrees(0.25), "longitude_deg": 122.0, "pump_current_a": 2.0,
        "current_north_m_s": 0.125, "current_east_m_s": -0.25, "voltage_v": 12.5, "waypoint": 3.0,
    }  # fmt: skip
    for key, value in expected.items():
        assert series(archive, key)[30] == pytest.approx(value, rel=1e-6), key
    assert series(archive, "fix_age_s")[30] == pytest.approx(37.0)
    assert series(archive, "energy_used_kj")[30] == pytest.approx(0.3)
    assert series(archive, "position_sigma_m")[15] == pytest.approx(5.0 / math.sqrt(2.0))
    assert series(archive, "phase")[STAY] == 1.0
    assert series(archive, "altitude_m") == {}  # infinite: no bottom was heard
    samples = archive.ctd(1)
    assert [round(row.t - UTC) for row in samples] == [
        k for k in range(3 * PERIOD) if k % PERIOD >= STAY and k % PERIOD % CTD_EVERY == 0
    ]
    assert [row.dive for row in samples] == [1 + k * 3 // len(samples) for k in range(len(samples))]
    assert samples[5].temperature_degc == pytest.approx(20.0 - 0.1 * depth_at(round(samples[5].t - UTC)))


def test_every_channel_of_a_log_is_one_of_the_station(archive: Archive, files: dict[str, bytes]) -> None:
    for name, data in files.items():
        take(archive, data, name)
    keys = archive.latest(1)
    assert len(keys) >= 25
    assert [key for key in keys if channel_named(key) is None] == []


def test_dives_are_found_with_what_the_log_knows_of_them(archive: Archive, files: dict[str, bytes]) -> None:
    for name, data in files.items():
        take(archive, data, name)
    found = archive.dives(1)
    assert [row.dive for row in found] == [1, 2, 3]
    for k, row in enumerate(found):
        assert row.t_begin == UTC + k * PERIOD + STAY
        assert row.latitude_begin == pytest.approx(30.0, abs=1e-3)
    assert [row.t_end for row in found] == [UTC + PERIOD, UTC + 2 * PERIOD, None]
    assert [row.greatest_depth_m for row in found] == [pytest.approx(DIVE / 4)] * 2 + [None]  # known at its end
    assert found[0].energy_j == pytest.approx(10.0 * DIVE, abs=100.0)
    assert found[0].latitude_end == pytest.approx(30.0 + math.degrees(1e-8 * (PERIOD + 11)), abs=1e-9)
    assert found[2].latitude_end is None
    currents = [(row.current_north_m_s, row.current_east_m_s) for row in found]
    assert currents == [(current_of(1), -0.25), (current_of(2), -0.25), (None, None)]  # known when the next begins


SAID = {
    0: (6, "communicate: control is at the surface"),
    STAY: (6, "mission: descent: control dives"),
    STAY + 7: (4, "alarm: over-depth"),
    STAY + 9: (5, "log:dropped: 12 records of the series detail"),
}
"""Severity and words, by the step of each dive."""


def test_what_happened_aboard_is_told_in_the_words_of_the_radio(archive: Archive, essential: bytes) -> None:
    row = take(archive, essential)
    said = [(dive * PERIOD + k, *words) for dive in range(3) for k, words in SAID.items()]
    assert [(round(text.t - UTC), text.severity, text.words) for text in archive.texts(1)] == said
    assert row.texts == len(said)


def test_what_the_radio_told_later_is_told_once_and_at_its_time(archive: Archive, essential: bytes) -> None:
    """Under water nobody hears it; at the surface it is said, and how bad it is stays as it was said."""
    late = PERIOD + 5.0  # at the surface after the first dive
    heard = [(UTC + late, 0, "alarm: over-depth"), (UTC + late, 6, "only by radio")]
    archive.store(1, Batch(texts=heard))
    take(archive, essential)
    before = archive.texts(1)
    alarms = [(round(text.t - UTC), text.severity) for text in before if text.words == "alarm: over-depth"]
    assert alarms == [(STAY + 7, 0), (PERIOD + STAY + 7, 4), (2 * PERIOD + STAY + 7, 4)]
    assert [round(text.t - UTC) for text in before if text.words == "only by radio"] == [late]
    assert len(before) == 3 * len(SAID) + 1


def test_rows_that_no_archive_takes_are_counted(
    archive: Archive, essential: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    store = archive.store_sound
    monkeypatch.setattr(
        archive, "store_sound", lambda vehicle, batch: store(vehicle, batch)._replace(left_out=["one", "two"])
    )
    steps: list[LogRow] = []
    assert take(archive, essential, told=lambda row: steps.append(row) is None).left_out == 2 * (len(steps) - 1) > 0


def test_a_dive_over_two_files_is_one_in_any_order(
    archive: Archive, opened: Callable[..., Archive], tmp_path: Any
) -> None:
    """Files are closed where they are full: the second begins under water and knows since when."""
    files = written(seconds=PERIOD + STAY, file_bytes=1 << 14)
    parts = [(name, data) for name, data in sorted(files.items()) if "essential" in name]
    assert len(parts) == 2
    for name, data in parts:
        take(archive, data, name)
    other = opened(str(tmp_path / "other.sqlite"))
    for name, data in reversed(parts):
        take(other, data, name)
    assert archive.dives(1) == other.dives(1)
    (dive,) = archive.dives(1)
    assert (dive.dive, dive.t_begin, dive.t_end) == (1, UTC + STAY, UTC + PERIOD)


def test_twice_changes_nothing(archive: Archive, files: dict[str, bytes]) -> None:
    for name, data in files.items():
        take(archive, data, name)
    before = content(archive)
    for name, data in files.items():
        take(archive, data, name)
        take(archive, data, name.replace(".log", ".sent.log"))
    assert content(archive) == before


def test_interrupted_after_any_step_it_goes_on_from_there(
    opened: Callable[..., Archive], essential: bytes, tmp_path: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As when the station is stopped, and asked for nothing again that is there."""
    monkeypatch.setattr(decoding, "AT_ONCE", 100)
    whole = opened(str(tmp_path / "whole.sqlite"))
    steps: list[LogRow] = []
    take(whole, essential, told=lambda row: steps.append(row) is None)
    assert len(steps) > 3
    broken = opened(str(tmp_path / "broken.sqlite"))
    offsets: list[int] = []
    for _ in range(len(steps) + 1):
        row = take(broken, essential, told=lambda row: bool(offsets.append(row.offset)))
        if row.state == TAKEN:
            break
        assert row.state == GOING
    assert offsets[:-1] == sorted(set(offsets[:-1]))  # each step once
    assert content(broken) == content(whole)


def test_a_log_that_is_cut_off_yields_what_is_before_the_cut(archive: Archive, essential: bytes) -> None:
    cut = essential[: len(essential) // 2 + 3]
    row = take(archive, cut)
    before = [record for record in read_log(cut).records if record.kind == "ctd"]
    assert row.state == TAKEN
    assert row.words.startswith("truncated after record")
    assert len(archive.ctd(1)) == len(before) > 10


def test_damage_ends_what_is_taken(archive: Archive, essential: bytes) -> None:
    at = 2 * len(essential) // 3
    damaged = essential[:at] + bytes([essential[at] ^ 0x10]) + essential[at + 1 :]
    row = take(archive, damaged)
    before = [record for record in read_log(damaged).records if record.kind == "ctd"]
    assert row.words.startswith("corrupt after record")
    assert len(archive.ctd(1)) == len(before) > 10


@pytest.mark.parametrize("utc", [None, 1000.0, 5e9])
def test_a_log_that_nobody_can_date_is_refused(archive: Archive, utc: float | None) -> None:
    data = next(iter(written(seconds=50, utc=utc).values()))
    row = take(archive, data)
    assert row.state == REFUSED
    assert "clock" in row.words
    assert archive.latest(1) == {}


def test_what_is_no_log_is_told_and_leaves_nothing(archive: Archive) -> None:
    with pytest.raises(FileError, match="is no log of a vehicle"):
        take(archive, b"[orders]\n")
    assert not is_log(b"[orders]\n")
    with archive.reading() as connection:
        assert connection.execute(select(logs)).all() == []


@pytest.mark.parametrize("log_first", [True, False])
def test_the_log_stands_for_the_few_samples_that_came_by_radio(
    archive: Archive, essential: bytes, log_first: bool
) -> None:
    """The radio rounds to milliseconds and single precision, and its clock may drift by parts of a second."""
    exact = {round(row.t - UTC) for row in _ctd_of(essential)}
    few = [CtdRow(UTC + t + 0.3004, 9, 1.0, 2.0, 3.0) for t in sorted(exact)[::7]]
    alone = CtdRow(UTC + 5.0, 0, 1.0, 2.0, 3.0)  # of a time at which the log has none
    radio = Batch(ctd=[*few, alone], dives=[DiveRow(1, UTC + STAY + 0.0004, UTC + PERIOD - 2.0, energy_j=7.0)])
    for step in (True, False):
        if step is log_first:
            take(archive, essential)
        else:
            archive.store(1, radio)
    samples = archive.ctd(1)
    assert {round(row.t - UTC) for row in samples} == exact | {5}
    assert len(samples) == len(exact) + 1
    with archive.reading() as connection:
        by_radio = connection.execute(select(ctd.c.t_us).where(ctd.c.log_id.is_(None))).scalars().all()
    assert by_radio == [round((UTC + 5.0) * 1e6)]
    first, *others = archive.dives(1)
    assert [row.dive for row in (first, *others)] == [1, 2, 3]
    assert (first.t_end, first.energy_j) == (UTC + PERIOD - 2.0, 7.0)  # as the vehicle itself told it
    assert first.latitude_begin == pytest.approx(30.0, abs=1e-3)  # which the log alone knows


def _ctd_of(data: bytes) -> list[CtdRow]:
    contents = read_log(data)
    clock = contents.header["clock"]
    return [
        CtdRow(clock["utc"] + record.values[0] - clock["t"], 0, 0.0, 0.0, 0.0)
        for record in contents.records
        if record.kind == "ctd"
    ]


def test_a_busy_archive_is_waited_for(archive: Archive, essential: bytes, monkeypatch: pytest.MonkeyPatch) -> None:
    store, refuse = archive.store, [False, True, True, False, True]

    def busy(vehicle: int, batch: Batch) -> None:
        if refuse and refuse.pop(0):
            raise ArchiveBusyError("busy")
        store(vehicle, batch)

    monkeypatch.setattr(archive, "store", busy)
    assert take(archive, essential).state == TAKEN


def test_a_batch_is_small(essential: bytes, archive: Archive) -> None:
    steps: list[LogRow] = []
    take(archive, essential, told=lambda row: steps.append(row) is None)
    counts = [0, *(row.records for row in steps)]
    assert all(b - a <= AT_ONCE for a, b in pairwise(counts))
