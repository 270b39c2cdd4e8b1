"""Alarms of a station: one row for each raising, kept over restarts, told even while the archive fails."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from threading import Event, Thread
from typing import Any

import pytest

from stommel.archive.archive import Archive
from stommel.archive.errors import ArchiveFullError
from stommel.archive.rows import Batch
from stommel.station.alarms.alarm import Alarm
from stommel.station.alarms.alert_words import Sender
from stommel.station.alarms.contact_watch import Contact
from stommel.station.alarms.defaults import default_limits
from stommel.station.alarms.history import AlarmError
from stommel.station.alarms.limits import ChannelWords, Limit
from stommel.station.alarms.station_alarms import ARCHIVE_FAILING, StationAlarms
from stommel.vehicle import Vehicle

DEPTH = Limit(channel="depth_m", high=200.0, hysteresis=5.0, severity="critical")
T0 = 1_700_000_000.0


class Scene:
    """A station's alarms with a clock that tests set."""

    def __init__(self, archive: Archive, limits: tuple[Limit, ...] = (DEPTH,)) -> None:
        self.now, self.contact = T0, Contact(heard=T0)
        self.told: list[Mapping[str, Any]] = []
        sender = Sender("Test station", lambda number: f"vehicle {number}")
        self.alarms = StationAlarms(
            archive, lambda key: ChannelWords(key, "m"), lambda kind, vehicle, row: self.told.append(row), sender
        )
        for vehicle in (1, 2):
            self.alarms.watch(vehicle, lambda: self.now, lambda: self.contact, limits)

    def samples(self, *samples: tuple[str, float, float], vehicle: int = 1) -> list[Alarm]:
        """Bring samples, times after T0; returns what the archive has, the oldest first."""
        self.alarms.take(vehicle, [(key, T0 + t, value) for key, t, value in samples])
        self.alarms.look()
        return self.alarms.history.listed()[::-1]


@contextmanager
def disk_full(archive: Archive, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    def fail() -> Any:
        raise ArchiveFullError("archive.sqlite: the disk is full")

    with monkeypatch.context() as patch:
        patch.setattr(archive, "writing", fail)
        yield


def test_one_row_for_each_raising(archive: Archive) -> None:
    scene = Scene(archive)
    values = [150.0, 201.0, 210.0, 199.0, 201.0, 195.0, 220.0]
    rows = scene.samples(*(("depth_m", float(n), value) for n, value in enumerate(values)))
    assert [(row.key, row.raised - T0, row.value) for row in rows] == [
        ("limit:depth_m:high", 1.0, 201.0), ("limit:depth_m:high", 6.0, 220.0),
    ]  # fmt: skip
    assert [row.cleared for row in rows] == [T0 + 5.0, None]
    assert scene.alarms.open_of(1) == [rows[1]]
    assert scene.alarms.open_of(2) == []
    assert [(row["raised"] - T0, row["cleared"]) for row in scene.told][-1] == (6.0, None)


def test_open_alarms_survive_a_restart_without_a_second_row(archive: Archive) -> None:
    Scene(archive).samples(("depth_m", 1.0, 250.0), ("vehicle_alarms", 1.0, 1.0))
    again = Scene(archive)
    assert {alarm.key for alarm in again.alarms.open_of(1)} == {"limit:depth_m:high", "vehicle:leak"}
    rows = again.samples(("depth_m", 10.0, 250.0), ("vehicle_alarms", 10.0, 1.0))
    assert len(rows) == 2
    assert [alarm.cleared for alarm in rows] == [None, None]
    rows = again.samples(("depth_m", 20.0, 100.0), ("vehicle_alarms", 21.0, 0.0))
    assert {alarm.key: alarm.cleared for alarm in rows} == {
        "limit:depth_m:high": T0 + 20.0, "vehicle:leak": T0 + 21.0,
    }  # fmt: skip
    assert again.alarms.open_of(1) == []


def test_what_the_archive_knew_at_the_start_is_held_against_the_limits(archive: Archive) -> None:
    """A station that died between the sample and its alarm raises it when it is back."""
    archive.store(1, Batch([], [("depth_m", T0, 300.0)], [], [], []))
    scene = Scene(archive)
    assert [row.raised for row in scene.samples()] == [T0]


def test_an_alarm_is_acknowledged_once_by_a_name_with_a_note(archive: Archive) -> None:
    scene = Scene(archive)
    (row,) = scene.samples(("depth_m", 1.0, 250.0))
    scene.now = T0 + 100.0
    seen = scene.alarms.acknowledge(row.id or 0, "ana", "diving to 250 m on purpose")
    assert (seen.acknowledged_by, seen.note, seen.acknowledged) == ("ana", "diving to 250 m on purpose", T0 + 100.0)
    assert scene.told[-1] == seen.as_row()
    with pytest.raises(AlarmError, match="ana has acknowledged it already"):
        scene.alarms.acknowledge(row.id or 0, "ben", "")
    with pytest.raises(AlarmError, match="alarm 999: there is none"):
        scene.alarms.acknowledge(999, "ben", "")
    (row,) = scene.samples(("depth_m", 2.0, 10.0))
    assert (row.acknowledged_by, row.cleared) == ("ana", T0 + 2.0)


def test_while_the_archive_fails_alarms_are_told_and_kept_afterwards(
    archive: Archive, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = Scene(archive)
    with disk_full(archive, monkeypatch):
        scene.alarms.take(1, [("depth_m", T0 + 1.0, 250.0)])
        scene.alarms.look()
        scene.alarms.look()
        assert [(row["key"], row["id"]) for row in scene.told] == [
            ("limit:depth_m:high", None),
            (ARCHIVE_FAILING, None),
        ]
        assert scene.told[1]["words"] == "The archive does not take what comes: archive.sqlite: the disk is full"
        assert [alarm.key for alarm in scene.alarms.open_of(None)] == [ARCHIVE_FAILING]
        scene.alarms.take(1, [("depth_m", T0 + 2.0, 10.0)])
        scene.alarms.take(1, [("depth_m", T0 + 3.0, 260.0)])
        scene.alarms.look()
    scene.alarms.look()
    rows = [row for row in scene.alarms.history.listed(vehicle=1)[::-1] if row.vehicle == 1]
    assert [(row.raised - T0, row.cleared and row.cleared - T0) for row in rows] == [(1.0, 2.0), (3.0, None)]
    scene.alarms.look()
    (own,) = [row for row in scene.alarms.history.listed() if row.vehicle is None]
    assert own.cleared is not None
    assert scene.alarms.open_of(None) == []


def test_a_missed_surfacing_is_an_alarm(archive: Archive) -> None:
    scene = Scene(archive)
    scene.alarms.look()
    scene.contact = Contact(heard=T0, expected=T0 + 3600.0)
    scene.now = T0 + 4000.0
    assert scene.samples() == []
    scene.now = T0 + 4600.0
    assert {(row.vehicle, row.key) for row in scene.samples()} == {(1, "surfacing_missed"), (2, "surfacing_missed")}
    scene.contact = Contact(heard=T0 + 5000.0)
    assert {row.cleared for row in scene.samples()} == {T0 + 5000.0}


def test_a_defect_in_one_vehicle_does_not_silence_the_others(archive: Archive) -> None:
    scene = Scene(archive)

    def broken() -> Contact:
        raise ZeroDivisionError

    scene.alarms.watch(1, lambda: T0, broken, ())
    assert [row.vehicle for row in scene.samples(("depth_m", 1.0, 250.0), vehicle=2)] == [2]


def test_limits_are_kept_changed_and_taken_away(archive: Archive) -> None:
    scene = Scene(archive)
    scene.alarms.put_limit(1, DEPTH.model_copy(update={"high": 100.0}), "ana")
    assert [row.words for row in scene.samples(("depth_m", 1.0, 150.0))] == ["Depth_m greater than 100 m"]
    assert Scene(archive).alarms.limits_of(1)[0].high == 100.0
    assert scene.alarms.remove_limit(1, "depth_m", "ana")
    assert not scene.alarms.remove_limit(1, "depth_m", "ana")
    assert [row.cleared is not None for row in scene.samples()] == [True]
    assert Scene(archive).alarms.limits_of(1) == []  # the default does not come back
    assert Scene(archive).alarms.limits_of(2) == [DEPTH]


def test_a_limit_that_the_archive_does_not_take_changes_nothing(
    archive: Archive, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = Scene(archive)
    with disk_full(archive, monkeypatch), pytest.raises(ArchiveFullError):
        scene.alarms.put_limit(1, DEPTH.model_copy(update={"high": 1.0}), "ana")
    assert scene.alarms.limits_of(1) == [DEPTH]


def test_the_thread_keeps_what_it_has_when_it_ends(archive: Archive) -> None:
    scene = Scene(archive)
    scene.alarms.start()
    scene.alarms.take(1, [("depth_m", T0, 250.0)])
    scene.alarms.stop()
    assert len(scene.alarms.history.listed()) == 1


def test_limits_to_begin_with_are_those_of_the_vehicle_file(zju: Vehicle) -> None:
    """Oracle: Table 3 of the paper: 200 m, 50 deg; whatever the file says of the battery, 30 % is time to go home."""
    limits = {limit.channel: limit for limit in default_limits(zju)}
    assert limits["depth_m"].high == 200.0
    assert limits["depth_m"].severity == "critical"
    assert (limits["pitch_deg"].low, limits["pitch_deg"].high) == (-60.0, 60.0)
    assert (limits["battery_left_share"].low or 0.0) >= 0.3
    assert [limit.channel for limit in default_limits(None)] == ["battery_left_share"]


def test_pages_of_the_history_leave_nothing_out(archive: Archive) -> None:
    scene = Scene(archive)
    for n in range(25):
        scene.samples(("depth_m", 2.0 * n, 250.0), ("depth_m", 2.0 * n + 1.0, 10.0))
    seen: list[int | None] = []
    before = None
    while page := scene.alarms.history.listed(before=before, limit=7):
        seen += [alarm.id for alarm in page]
        before = page[-1].id
    assert len(seen) == len(set(seen)) == 25
    assert scene.alarms.history.listed(is_open=True) == []
    assert len(scene.alarms.history.listed(is_acknowledged=False, limit=100)) == 25


def test_a_sample_of_an_impossible_time_stops_nothing(archive: Archive) -> None:
    scene = Scene(archive)
    rows = scene.samples(("depth_m", 1e12, 250.0), ("depth_m", float("nan"), 250.0), ("depth_m", 2.0, 260.0))
    assert [(row.raised - T0, row.value) for row in rows] == [(2.0, 260.0)]


def test_an_alarm_that_breaks_a_rule_of_the_archive_keeps_no_other_waiting(archive: Archive) -> None:
    scene = Scene(archive)
    scene.alarms.watch(3, lambda: T0, lambda: None, ())  # no row of the archive is vehicle 3
    scene.samples(("vehicle_alarms", 1.0, 1.0), vehicle=3)
    assert [row.vehicle for row in scene.samples(("depth_m", 1.0, 250.0))] == [1]


def test_two_people_who_change_a_limit_at_once_leave_watched_what_is_kept(
    archive: Archive, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = Scene(archive)
    table = scene.alarms._limits
    put, is_written, goes_on = table.put, Event(), Event()

    def slow_put(vehicle: int, limit: Limit, user: str) -> None:
        put(vehicle, limit, user)
        is_written.set()
        goes_on.wait(30.0)

    monkeypatch.setattr(table, "put", slow_put)
    first = Thread(target=scene.alarms.put_limit, args=(1, DEPTH.model_copy(update={"high": 99.0}), "ada"))
    first.start()
    is_written.wait(30.0)
    second = Thread(target=scene.alarms.remove_limit, args=(1, "depth_m", "paul"))
    second.start()
    second.join(0.5)
    goes_on.set()
    first.join()
    second.join()
    assert scene.alarms.limits_of(1) == table.limits_of(1) == []
