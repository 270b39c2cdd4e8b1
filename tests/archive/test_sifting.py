"""A row that no database takes is left out and told; everything beside it is stored, its frame too.

Oracle: the same batch without that row, stored by `store` in another archive's vehicle.
"""

import math
from pathlib import Path
from typing import Any

import pytest
from sqlalchemy import String, select

from stommel.archive import Archive, ArchiveRequestError, Batch, CtdRow, DiveRow, TextRow
from stommel.archive.columns import metadata
from stommel.archive.schema import minutes
from stommel.archive.wording import Name
from stommel.station.vehicles.command_rows import CommandRow, CommandRows
from stommel.station.vehicles.mission_rows import MissionRow, MissionRows
from tests.archive.every_sample import every_sample
from tests.archive.test_store import T, frame
from tests.station.speaker import speaker, until
from tests.station.stations import station

SOUND = Batch(
    [frame(k) for k in range(7)],
    [("depth_m", T + k, float(k)) for k in range(100)],
    [(T + k, 6, f"text {k}") for k in range(9)],
    [DiveRow(k, T + 60 * k, T + 60 * k + 50) for k in range(5)],
    [CtdRow(T + k, 1, float(k), 18.0, 4.5) for k in range(11)],
)
HUGE = 1 << 70
POISONS = {
    "text of no time": ("texts", (math.nan, 6, "x")),
    "text of a severity beyond 64 bits": ("texts", (T, HUGE, "x")),
    "dive of no time": ("dives", DiveRow(9, -1.0)),
    "dive that never ends": ("dives", DiveRow(9, T, 5e12)),
    "dive of a number beyond 64 bits": ("dives", DiveRow(HUGE, T)),
    "CTD sample of no time": ("ctd", CtdRow(math.inf, 1, 1.0, 1.0, 1.0)),
    "CTD sample of a dive beyond 64 bits": ("ctd", CtdRow(T + 999, HUGE, 1.0, 1.0, 1.0)),
    "frame of a number beyond 64 bits": ("frames", frame(3)._replace(sequence=HUGE)),
    "channel whose name has half a character": ("samples", ("half \ud800", T, 1.0)),
}


def content(archive: Archive, vehicle: int) -> tuple[object, ...]:
    """Everything that the archive has of a vehicle, cells too."""
    with archive.reading() as connection:
        cells = connection.execute(select(*list(minutes.c)[3:]).where(minutes.c.vehicle_id == vehicle)).all()
    samples = every_sample(archive, vehicle, T - 1e6, T + 1e6)
    frames = [stored.row for stored in archive.frames(vehicle)]
    return frames, samples, cells, archive.texts(vehicle), archive.dives(vehicle), archive.ctd(vehicle)


@pytest.mark.parametrize(
    ("poison", "place"), [*((poison, 3) for poison in POISONS), ("dive of no time", 0), ("dive of no time", 5)]
)
def test_a_row_that_no_database_takes_costs_that_row_alone(archive: Archive, poison: str, place: int) -> None:
    kind, row = POISONS[poison]
    rows = list(getattr(SOUND, kind))
    rows.insert(place, row)
    told: dict[str, Any] = {kind: rows}
    bad = SOUND._replace(**told)
    with pytest.raises(ArchiveRequestError):
        archive.store(1, bad)
    sifted = archive.store_sound(1, bad)
    archive.store(2, SOUND)
    assert content(archive, 1) == content(archive, 2)
    assert len(sifted.left_out) == 1
    assert [list(part) for part in sifted.batch[:5]] == [list(part) for part in SOUND[:5]]


def test_a_channel_that_was_left_out_can_be_stored_afterwards(archive: Archive) -> None:
    bad = [("half \ud800", T, 1.0), ("new", T, 2.0)]
    assert len(archive.store_sound(1, Batch(samples=bad)).left_out) == 1
    archive.store(1, Batch(samples=[("other", T, 3.0), ("new", T + 1, 4.0)]))
    assert archive.latest(1) == {"new": (T + 1, 4.0), "other": (T, 3.0)}


def test_a_batch_of_which_nothing_is_sound_leaves_nothing_and_holds_nothing_up(archive: Archive) -> None:
    sifted = archive.store_sound(1, Batch(texts=[(T, HUGE, "x")] * 40))
    assert len(sifted.left_out) == 40
    assert archive.texts(1) == []


def test_a_frame_of_no_time_is_kept_by_the_clock_of_the_station(archive: Archive) -> None:
    sifted = archive.store_sound(1, Batch([frame(0), frame(1)._replace(t=math.nan)]))
    assert sifted.left_out == []
    newest = archive.frames(1)[0]
    assert newest.row.frame == frame(1).frame
    assert newest.row.t == pytest.approx(newest.received, abs=5.0)


def test_numbers_that_have_no_sum_leave_the_minutes_sound(archive: Archive) -> None:
    """The sum of a minute would be infinite, then none, which no column of numbers takes."""
    archive.store(1, Batch(samples=[("a", T, 1.7e308), ("a", T + 1, 1.7e308), ("a", T + 2, -1e290), ("b", T, 1.0)]))
    archive.store(1, Batch(samples=[("a", T + 3, -1.7e308), ("a", T + 4, -1.7e308)]))
    assert archive.latest(1) == {"a": (T + 2, -1e290), "b": (T, 1.0)}


def test_what_an_instrument_tells_as_no_number_is_not_known(archive: Archive) -> None:
    archive.store(1, Batch(ctd=[CtdRow(T, 1, math.nan, math.inf, 4.5)], dives=[DiveRow(1, T, energy_j=math.nan)]))
    assert archive.ctd(1) == [CtdRow(T, 1, None, None, 4.5)]
    assert archive.dives(1) == [DiveRow(1, T)]


def test_every_column_of_words_makes_them_clean() -> None:
    """Of the others the station itself draws what stands in them: directions, ids and hashes."""
    rough = {
        f"{table.name}.{column.name}"
        for table in metadata.tables.values()
        for column in table.c
        if isinstance(column.type, String)
    }
    assert rough == {
        "frames.direction", "files.direction", "commands.id", "command_history.command_id", "missions.sha256",
        "files.sha256", "sessions.id_hash", "tokens.hash", "logs.sha256",
    }  # fmt: skip
    assert isinstance(metadata.tables["texts"].c.words.type, Name)


def test_words_of_a_vehicle_that_a_database_refuses_are_stored_without_what_it_refuses(archive: Archive) -> None:
    """Orders that are found aboard are the bytes of a file there, and a command's last word is the vehicle's."""
    archive.know(1, "Kelp", "")
    row = CommandRow("0" * 15 + "1", 1, "ada", T, T + 9, "hold", {}, "until_expiry", "given", "", T)
    commands = CommandRows(archive)
    commands.add(row)
    commands.change(row.id, "done", "d\0ne \udc80", T)
    found = commands.find(1, row.id)
    assert found is not None
    assert (found.state, found.words) == ("done", "dne ?")
    mission = MissionRow(0, 1, T, None, "a\0", "0" * 64, "orders\0", None, "replaced")
    assert MissionRows(archive).find(1, MissionRows(archive).add(mission, "found").id) is not None


def test_a_line_goes_on_when_something_that_came_cannot_be_stored(tmp_path: Path, database: str) -> None:
    with speaker() as vehicle, station(tmp_path, vehicle.address, database=database, start=False) as found:
        line = found.vehicles[1]
        line.ingest.texts += [(T, 6, "before"), (T + 1, HUGE, "never"), (T + 2, 6, "after")]
        found.start()
        vehicle.connect()
        vehicle.say("GLIDER_STATE", time_boot_ms=1, depth=3.5)
        until(lambda: found.archive.texts(1) == [TextRow(T, 6, "before"), TextRow(T + 2, 6, "after")])
        until(lambda: found.archive.latest(1).get("depth_m", (0.0, 0.0))[1] == 3.5)
        until(lambda: "TIMESYNC" in vehicle.names() or "HEARTBEAT" in vehicle.names())
        until(lambda: any("1 values were left out" in note for note in line.status().notes))
        assert line.archive_reason == ""


def test_a_simulated_clock_that_runs_out_of_years_stops_nothing(tmp_path: Path, database: str) -> None:
    """The archive has times to 2100."""
    told = {"speed": 1000.0, "simulated": True}
    with speaker() as vehicle, station(tmp_path, vehicle.address, database=database, vehicle=told) as found:
        vehicle.connect()
        vehicle.say("SYSTEM_TIME", time_unix_usec=4_102_444_799 * 10**6, time_boot_ms=1)
        until(lambda: found.vehicles[1].clock.now() == 4_102_444_800.0)
        vehicle.say("GLIDER_STATE", time_boot_ms=2, depth=3.5)
        until(lambda: found.archive.latest(1).get("depth_m", (0.0, 0.0))[1] == 3.5)


def test_a_defect_while_storing_holds_no_abort_back(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with speaker() as vehicle, station(tmp_path, vehicle.address) as found:
        vehicle.connect()
        vehicle.say("HEARTBEAT", type=12)
        until(lambda: found.vehicles[1].status().heard)

        def broken(*_: object) -> None:
            raise ZeroDivisionError("a defect")

        monkeypatch.setattr(found.archive, "store", broken)
        vehicle.say("HEARTBEAT", type=12)
        until(lambda: "ZeroDivisionError" in found.vehicles[1].status().archive)
        found.commands.abort(1, "ada")
        until(lambda: "GLIDER_COMMAND" in vehicle.names())
