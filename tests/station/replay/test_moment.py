"""How a vehicle was at a moment of a replay. Oracle: what was stored, looked at by eye; nothing of later shows."""

from typing import Any

import pytest

from stommel.archive import Batch, DiveRow
from stommel.station.alarms.alarm import Alarm
from stommel.station.station import Station
from tests.station.client import Client

T0 = 1_700_000_000.0
HOUR = 3600.0
SURFACE, DESCENT = 0.0, 1.0


def dive(number: int, begin: float, north: float) -> DiveRow:
    """An hour to the north at a degree a dive, with a current of its own."""
    return DiveRow(number, begin, begin + HOUR, 29.0 + number, 123.0, 30.0 + number, 123.0, 200.0, north, 0.0, 1e4)


@pytest.fixture
def past(station: Station) -> None:
    """Two dives of an hour each; the waypoint comes 1 m closer each 2 s; the second dive is under way at T0 + 2 h."""
    hourly = [
        sample
        for k in (0, 1)
        for sample in (
            ("phase", T0 + k * 1.5 * HOUR, SURFACE),
            ("phase", T0 + k * 1.5 * HOUR + 60.0, DESCENT),
            ("dive", T0 + k * 1.5 * HOUR + 60.0, 1.0 + k),
        )
    ]
    way = [("waypoint_distance_m", T0 + t, 9000.0 - t / 2.0) for t in range(0, 9000, 10)]
    place = [("latitude_deg", T0 + t, 30.0 + t / 9000.0) for t in range(0, 9000, 10)]
    east = [("longitude_deg", T0 + t, 123.0) for t in range(0, 9000, 10)]
    samples = [("waypoint", T0, 1.0), ("battery_left_share", T0 + 10.0, 0.8), *hourly, *way, *place, *east]
    dives = [dive(1, T0 + 60.0, 0.1), dive(2, T0 + 1.5 * HOUR + 60.0, 0.3)]
    station.archive.store(1, Batch(samples=samples, dives=dives))


def at(client: Client, t: float) -> dict[str, Any]:
    """How the vehicle was at a time of a replay that stands still there."""
    made = client.post("/replays", {"vehicle": 1, "begin": T0, "end": T0 + 3.0 * HOUR})
    changed = client.request("PUT", f"/replays/{made['replay']}", json={"at": t, "paused": True}).json()
    client.request("DELETE", f"/replays/{made['replay']}")
    found: dict[str, Any] = changed["summary"]
    return found


@pytest.mark.usefixtures("past")
def test_it_is_what_was_known_then(client: Client) -> None:
    first = at(client, T0 + 30.0)
    assert (first["phase"], first["dive"], first["current"]) == ("surface", None, None)
    assert first["missing"]["speed_made_good"] == "no dive has ended yet with a position at both ends"
    second = at(client, T0 + 2.0 * HOUR)
    assert (second["phase"], second["dive"]) == ("descent", 2)
    assert second["position"]["latitude"] == pytest.approx(30.0 + 7200.0 / 9000.0, abs=1e-3)
    current = {"north_m_s": 0.1, "east_m_s": 0.0, "dive": 1, "t": T0 + HOUR + 60.0}
    assert second["current"] == current, "the second dive had not ended"
    assert second["waypoint_distance_m"] == 9000.0 - 3600.0
    assert second["battery"]["share"] == 0.8
    assert second["heard"] is True
    assert second["holder"] is None


@pytest.mark.usefixtures("past")
def test_what_is_expected_is_reckoned_from_then(client: Client) -> None:
    """Oracles: the dive before took an hour; at half a metre a second 5400 m take 10 800 s."""
    found = at(client, T0 + 2.0 * HOUR)
    assert found["next_surfacing"]["t"] == pytest.approx(T0 + 1.5 * HOUR + 60.0 + HOUR)
    assert found["eta"]["t"] == pytest.approx(T0 + 2.0 * HOUR + 10_800.0, abs=60.0)


@pytest.mark.usefixtures("past")
def test_a_vehicle_that_is_silent_then_is_not_heard_then(client: Client) -> None:
    found = at(client, T0 + 2.9 * HOUR)
    assert found["heard"] is False
    assert found["last_contact"] == T0 + 8990.0
    assert found["link_reason"] == "nothing was received at that time"


@pytest.mark.usefixtures("past")
def test_alarms_are_those_of_then_and_say_nothing_of_what_came_later(station: Station, client: Client) -> None:
    """Raised after 10 min, acknowledged after 20, over after 30; one of the station is of another clock."""
    history = station.alarms.history
    number = history.add(Alarm(None, 1, "limit:depth_m:high", "Depth greater than 200 m", "warning", T0 + 600.0))
    history.add(Alarm(None, None, "alerts_failing", "Alerts do not go out", "warning", T0))
    history.acknowledge(number, "ana", "seen it", T0 + 1200.0)
    history.clear(number, T0 + 1800.0)
    told = [at(client, T0 + minutes * 60.0)["alarms"] for minutes in (5.0, 15.0, 25.0, 35.0)]
    assert [[alarm["key"] for alarm in alarms] for alarms in told] == [
        [], ["limit:depth_m:high"], ["limit:depth_m:high"], [],
    ]  # fmt: skip
    assert (told[1][0]["raised"], told[1][0]["acknowledged_by"]) == (T0 + 600.0, None)
    assert (told[2][0]["acknowledged"], told[2][0]["acknowledged_by"]) == (T0 + 1200.0, "ana")


def test_alarms_that_only_a_log_brought_home_are_shown(station: Station, client: Client) -> None:
    """Bits of GLIDER_ALARM: 1 leak, 64 sinking on; the station kept no alarm, since nobody was told at that time."""
    bits = [("vehicle_alarms", T0 + 10.0, 65.0), ("vehicle_alarms", T0 + 600.0, 0.0), ("depth_m", T0 + 9000.0, 1.0)]
    station.archive.store(1, Batch(samples=bits))
    found = at(client, T0 + 60.0)["alarms"]
    assert [(alarm["words"], alarm["severity"], alarm["raised"]) for alarm in found] == [
        ("Leak", "critical", None), ("Sinking on", "critical", None),
    ]  # fmt: skip
    assert at(client, T0 + 900.0)["alarms"] == []
