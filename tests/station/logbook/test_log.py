"""The log book: notes with author and time, found by words, beside what people did, alarms and transfers."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any, get_args

import pytest
from pyproj import Geod
from sqlalchemy import insert

from stommel.archive import Batch, DiveRow
from stommel.archive.schema import alarms, commands, files, missions, parameter_writes
from stommel.station.logbook.feed import SOURCES, Kind, page_of
from stommel.station.logbook.notes import Notes
from stommel.station.people.holders import Hold, taking
from stommel.station.people.roles import Role
from stommel.station.station import Station
from tests.station.client import Client
from tests.station.stations import station as running

T0 = 1_700_000_000.0
DIVE = DiveRow(7, T0, T0 + 3600.0, 28.0, 126.0, 28.01, 126.02, 197.6, 0.1, -0.2, 5200.0)


ALL_KINDS = ["alarm", "command", "dive", "mission", "note", "parameter", "transfer"]
"""Of what is in `filled`, in the order of the list."""


@pytest.fixture
def station(tmp_path: Path) -> Iterator[Station]:
    with running(tmp_path, "tcp:127.0.0.1:9", "tcp:127.0.0.1:10", start=False) as made:
        yield made


@pytest.fixture
def client(station: Station) -> Client:
    return Client(station)


@pytest.mark.parametrize("before", ["x", "1700000000000000-door-1", "-note-1", "1-note-"])
def test_a_page_that_is_none_is_refused_in_words(client: Client, before: str) -> None:
    refused = client.refused("GET", "/vehicles/1/log", 422, params={"before": before})
    assert refused["key"] == "before"
    assert "must be the `next` of the page before" in str(refused)
    assert "(" not in str(refused), "nobody is shown a pattern"


def test_every_kind_of_entry_has_a_source() -> None:
    assert list(get_args(Kind)) == list(SOURCES)


def filled(station: Station) -> None:
    """One of each kind of a vehicle's own tables at the same second, and an alarm of another vehicle."""
    us = round(T0 * 1e6)
    alarm = {
        "key": "k", "words": "Depth greater than 200 m", "severity": "critical", "raised_us": us, "cleared_us": us,
        "acknowledged_us": us, "acknowledged_by": "ana", "note": "seen it",
    }  # fmt: skip
    command = {
        "id": "00ff", "vehicle_id": 1, "user": "ben", "given_us": us, "expires_us": us, "name": "surface",
        "parameters": {"why": 3}, "occasion": "at_once", "state": "done", "outcome": "executed", "changed_us": us,
    }  # fmt: skip
    mission = {
        "vehicle_id": 1, "t_us": us, "user": "ana", "name": "Zhoushan", "sha256": "", "orders": "", "state": "aboard",
    }  # fmt: skip
    parameter = {
        "vehicle_id": 1, "component": 1, "name": "DEPTH_MAX", "value": 150.0, "user": "ben", "t_us": us,
        "state": "refused", "words": "out of range",
    }  # fmt: skip
    file = {
        "vehicle_id": 1, "path": "logs/3.bin", "t_us": us, "direction": "download", "user": "ben", "state": "going",
    }  # fmt: skip
    with station.archive.writing() as connection:
        connection.execute(insert(parameter_writes), parameter)
        connection.execute(insert(files), file)
        connection.execute(insert(alarms), [{"vehicle_id": vehicle, **alarm} for vehicle in (1, 2)])
        connection.execute(insert(commands), {key: value for key, value in command.items() if key in commands.c})
        connection.execute(insert(missions), mission)
    station.archive.store(1, Batch(dives=[DIVE]))
    Notes(station.archive).add(1, T0, "ana", "Launched from the pier")


def test_a_note_keeps_its_author_its_vehicle_and_its_time(station: Station, client: Client) -> None:
    news = station.hub.watch()
    made = client.post("/notes", {"vehicle": 1, "t": T0, "words": "  Strong current\nto the <b>east</b> "})
    event = news.collect()
    assert (made["user"], made["vehicle"], made["t"]) == ("local", 1, T0)
    assert made["words"] == "Strong current\nto the <b>east</b>"
    assert event == {"type": "event", "kind": "note", "vehicle": 1, "data": made}
    assert client.get("/notes") == client.get("/notes", vehicle=1) == [made]
    assert client.get("/notes", vehicle=2) == []
    about_all = client.post("/notes", {"words": "Storm"})
    assert about_all["vehicle"] is None
    assert abs(about_all["t"] - about_all["written"]) < 5.0


@pytest.mark.parametrize(
    ("body", "status", "key"),
    [
        ({"words": ""}, 422, "words"),
        ({"words": " \n"}, 422, "words"),
        ({"words": "x" * 10_001}, 422, "words"),
        ({"words": "x", "t": 4_000_000_000}, 422, "t"),
        ({"words": "x", "t": -1}, 422, "t"),
        ({"words": "x", "vehicle": 7}, 404, "vehicle"),
        ({"words": "x", "user": "somebody else"}, 422, "user"),
    ],
)
def test_a_note_that_cannot_be_is_refused(client: Client, body: dict[str, Any], status: int, key: str) -> None:
    assert client.refused("POST", "/notes", status, json=body)["key"] == key


@pytest.mark.parametrize(
    ("search", "found"),
    [
        ("pier", 1), ("PIER launched", 1), ("pier boat", 0), ("100%", 1), ("%", 1), ("_", 1), ("a_b", 1), ("ana", 3),
        ("'; drop", 0),
    ],
)  # fmt: skip
def test_notes_are_found_by_their_words(station: Station, client: Client, search: str, found: int) -> None:
    for words in ("Launched from the pier", "Battery at 100%", "file a_b"):
        Notes(station.archive).add(1, T0, "ana", words)
    assert len(client.get("/notes", search=search)) == found


def test_everything_about_a_vehicle_is_in_one_list(station: Station, client: Client) -> None:
    filled(station)
    page = client.get("/vehicles/1/log")
    told = [(entry["kind"], entry["user"], entry["words"], entry["state"]) for entry in page["entries"]]
    assert told == [
        ("alarm", None, "Depth greater than 200 m", "over, seen by ana: seen it"),
        ("command", "ben", "Command surface: why 3", "done: executed"),
        ("dive", None, "Dive 7 to 198 m", "ended"),
        ("mission", "ana", "Mission Zhoushan", "aboard"),
        ("note", "ana", "Launched from the pier", None),
        ("parameter", "ben", "Parameter DEPTH_MAX of component 1 set to 150", "refused: out of range"),
        ("transfer", "ben", "File logs/3.bin from the vehicle", "under way"),
    ]
    assert {entry["t"] for entry in page["entries"]} == {T0}
    assert page["next"] is None
    assert [entry["kind"] for entry in client.get("/vehicles/1/log", kinds=["note", "alarm"])["entries"]] == [
        "alarm", "note",
    ]  # fmt: skip
    assert [entry["kind"] for entry in client.get("/vehicles/1/log", search="seen")["entries"]] == ["alarm"]


@pytest.mark.parametrize("limit", [1, 2, 3, 7])
def test_pages_of_the_list_leave_nothing_out_and_repeat_nothing(station: Station, limit: int) -> None:
    """Oracle: the whole list at once; many entries share their time."""
    filled(station)
    for n in range(9):
        Notes(station.archive).add(1, T0 + n // 3, "ana", f"note {n}")
    # each mission counts its dives from 1
    station.archive.store(
        1, Batch(dives=[DIVE._replace(dive=n % 4, t_begin=T0 + 100.0 * (n // 2)) for n in range(1, 9)])
    )
    whole = page_of(station.archive, 1, limit=500).entries
    assert len(whole) == 24
    assert len({(entry.kind, entry.id) for entry in whole}) == 24
    assert [entry.t for entry in whole] == sorted((entry.t for entry in whole), reverse=True)
    found, before = [], None
    for _ in range(30):
        page = page_of(station.archive, 1, limit=limit, before=before)
        found += page.entries
        before = page.next
        if before is None:
            break
    assert found == whole


def test_a_dive_is_told_with_all_that_is_known_of_it(station: Station, client: Client) -> None:
    filled(station)
    (entry,) = client.get("/vehicles/1/log", kinds=["dive"])["entries"]
    way = Geod(ellps="WGS84").inv(126.0, 28.0, 126.02, 28.01)[2]
    assert entry["dive"] == DIVE._asdict() | {"distance_m": pytest.approx(way, rel=1e-6)}
    assert client.get("/vehicles/2/log", kinds=["dive"])["entries"] == []
    assert client.get("/vehicles/1/log", search="dive 7")["entries"] == [entry]
    assert client.get("/vehicles/1/log", search="dive 8")["entries"] == []


@pytest.mark.parametrize(
    ("until", "state", "t_end", "depth"),
    [(T0 - 1.0, None, None, None), (T0 + 3599.0, "under way", None, None), (T0 + 3600.0, "ended", T0 + 3600.0, 197.6)],
)
def test_until_a_time_only_what_had_happened_is_told(
    station: Station, client: Client, until: float, state: str | None, t_end: float | None, depth: float | None
) -> None:
    """A replay shows nothing of what is still to come: not how deep a dive will be, nor where it will end."""
    filled(station)
    Notes(station.archive).add(1, T0 + 7200.0, "ana", "Recovered")
    found = client.get("/vehicles/1/log", until=until)["entries"]
    assert [entry["kind"] for entry in found] == ([] if state is None else ALL_KINDS)
    for entry in found:
        if entry["kind"] == "dive":
            told = entry["dive"]
            assert (entry["state"], told["t_end"], told["greatest_depth_m"]) == (state, t_end, depth)
            assert (told["latitude_end"] is None, told["latitude_begin"]) == (t_end is None, 28.0)
            assert ("198 m" in entry["words"]) == (depth is not None)


def test_who_held_command_and_set_limits_is_told_at_the_time_of_the_vehicle(tmp_path: Path) -> None:
    """The whole way: by the routes, at a vehicle whose clock is not the station's."""
    with running(tmp_path, "tcp:127.0.0.1:9", start=False) as station:
        client, clock = Client(station), station.vehicles[1].clock
        now = clock.now
        clock.now = lambda: now() + 86_400.0  # type: ignore[method-assign]
        client.request("POST", "/vehicles/1/holder", json={}).raise_for_status()
        limit = {"low": None, "high": 150, "hysteresis": 2, "delay_s": 30, "severity": "critical"}
        client.request("PUT", "/vehicles/1/limits/depth_m", json=limit).raise_for_status()
        client.request("DELETE", "/vehicles/1/limits/depth_m").raise_for_status()
        client.request("DELETE", "/vehicles/1/holder").raise_for_status()
        page = client.get("/vehicles/1/log", kinds=["hold", "limit"])
        assert sorted((entry["kind"], entry["user"], entry["words"]) for entry in page["entries"]) == [
            ("hold", "local", "Gave up command"),
            ("hold", "local", "Took command"),
            ("limit", "local", "Limit of depth removed"),
            ("limit", "local", "Limit of depth: at most 150 m, hysteresis 2 m, after 30 s; critical"),
        ]
        assert all(abs(entry["t"] - now() - 86_400.0) < 60.0 for entry in page["entries"])
        assert client.get("/vehicles/1/log", search="gave")["entries"][0]["kind"] == "hold"


def test_command_that_was_taken_from_somebody_says_from_whom_and_why() -> None:
    hold = Hold(1, "ben", Role.PILOT, T0, "ana", "she sleeps")
    assert taking(hold) == "Took command from ana: she sleeps"


def test_what_is_of_the_station_stands_in_the_log_of_each_vehicle(station: Station, client: Client) -> None:
    """An archive that fails is everybody's trouble, and a note about all was written to be read."""
    client.post("/notes", {"words": "Storm"})
    client.post("/notes", {"vehicle": 2, "words": "Only of the other"})
    with station.archive.writing() as connection:
        alarm = {"key": "archive_failing", "words": "Disk full", "severity": "critical", "raised_us": round(T0 * 1e6)}
        connection.execute(insert(alarms), alarm)
    told = [(entry["kind"], entry["vehicle"], entry["words"]) for entry in client.get("/vehicles/1/log")["entries"]]
    assert told == [("note", None, "Storm"), ("alarm", None, "Disk full")]


@pytest.mark.parametrize("before", ["1", "1-note", "1-note-x", "1-frog-1", f"1-note-{'f' * 17}", "1-note-1 or 1"])
def test_a_place_in_the_list_that_is_none_is_refused(client: Client, before: str) -> None:
    client.refused("GET", "/vehicles/1/log", 422, params={"before": before})


def test_a_number_that_fits_no_table_is_an_empty_page(client: Client) -> None:
    assert client.get("/vehicles/1/log", before="1-note-ffff")["entries"] == []
    assert client.get("/vehicles/1/log", before="99999999999999999-note-9999999999999999")["entries"] == []
