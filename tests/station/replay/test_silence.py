"""Stretches of the past in which nothing was received: told, left at once if that is wanted, refused as a whole."""

from typing import Any

import pytest

from stommel.archive import Batch
from stommel.station.live.subscription import LatestValues
from stommel.station.replay.silence import LEAST, NOTED_AFTER
from stommel.station.station import Station
from tests.station.client import Client
from tests.station.speaker import until

T0 = 1_700_000_000.0
DAY = 86_400.0
AGAIN = T0 + 3.0 * DAY
"""When the vehicle is heard again."""


@pytest.fixture
def gap(station: Station) -> None:
    """A minute of values, three days of nothing but what is measured ashore, and another minute."""
    told = [("depth_m", begin + n, float(n)) for begin in (T0, AGAIN) for n in range(60)]
    ashore = [("link_loss_share", T0 + n * 600.0, 0.0) for n in range(432)]
    station.archive.store(1, Batch(samples=[*told, *ashore]))


def begun(station: Station, client: Client, begin: float, end: float, **more: Any) -> tuple[str, object]:
    """A replay to which somebody listens; its address, and who listens."""
    made = client.post("/replays", {"vehicle": 1, "begin": begin, "end": end, "speed": 1000.0})
    if more:
        client.request("PUT", f"/replays/{made['replay']}", json=more)
    return f"/replays/{made['replay']}", station.hub.subscribe("a", f"replay:{made['replay']}", ["depth_m"])


@pytest.mark.usefixtures("gap")
def test_a_silence_is_told_with_its_end_and_time_goes_on_in_it(station: Station, client: Client) -> None:
    """Oracle: the samples that were stored; what is measured ashore is no word of the vehicle."""
    path, _ = begun(station, client, T0, AGAIN + 59.0)
    until(lambda: client.get(path)["silence"])
    state = client.get(path)
    assert state["silence"] == {"begin": T0 + 59.0, "end": AGAIN, "is_last": False}
    assert T0 + 59.0 + NOTED_AFTER <= state["at"] < AGAIN - DAY
    client.request("PUT", path, json={"at": AGAIN - 1.0})
    until(lambda: client.get(path)["at"] > AGAIN)
    until(lambda: client.get(path)["silence"] is None)


@pytest.mark.usefixtures("gap")
def test_silences_are_jumped_over_and_no_sample_is(station: Station, client: Client) -> None:
    made = client.post("/replays", {"vehicle": 1, "begin": T0, "end": AGAIN + 59.0, "speed": 200.0})
    path, name = f"/replays/{made['replay']}", f"replay:{made['replay']}"
    client.request("PUT", path, json={"skip_silence": True})
    reader = station.hub.subscribe("a", name, ["depth_m"], True)
    found: list[float] = []

    def at_end() -> bool:
        is_over = client.get(path)["at"] == AGAIN + 59.0
        message = reader.collect()
        found.extend(message["samples"]["depth_m"][0] if message else ())
        return message is None and is_over

    until(at_end, within=60.0)
    assert found == [*(T0 + n for n in range(1, 60)), *(AGAIN + n for n in range(60))]
    assert client.get(path)["skip_silence"] is True


@pytest.mark.usefixtures("gap")
def test_a_silence_until_the_end_is_told_as_such_and_jumped_to_the_end(station: Station, client: Client) -> None:
    path, _ = begun(station, client, T0, T0 + DAY)
    until(lambda: client.get(path)["silence"])
    assert client.get(path)["silence"] == {"begin": T0 + 59.0, "end": T0 + DAY, "is_last": True}
    client.request("PUT", path, json={"skip_silence": True})
    until(lambda: client.get(path)["at"] == T0 + DAY)


def test_a_short_pause_is_no_silence(station: Station, client: Client) -> None:
    told = [("depth_m", T0 + n * (LEAST - 1.0), float(n)) for n in range(40)]
    station.archive.store(1, Batch(samples=told))
    path, reader = begun(station, client, T0, T0 + 39.0 * (LEAST - 1.0))
    assert isinstance(reader, LatestValues)
    seen: list[object] = []
    until(lambda: seen.append(client.get(path)["silence"]) or client.get(path)["at"] >= T0 + 2000.0)
    assert set(seen) == {None}


@pytest.mark.usefixtures("gap")
def test_a_stretch_with_nothing_in_it_is_refused_with_what_there_is_around_it(client: Client) -> None:
    """Oracle: 1 700 000 000 s since 1970 is 2023-11-14 22:13:20 UTC."""
    body = {"vehicle": 1, "begin": T0 + DAY, "end": T0 + 2.0 * DAY}
    told = client.refused("POST", "/replays", 422, json=body)
    assert told["key"] == "begin"
    assert "the last before at 2023-11-14 22:14:19 UTC" in told["reason"]
    assert "the next at 2023-11-17 22:13:20 UTC" in told["reason"]
    assert client.get("/replays") == []


def test_a_vehicle_that_was_never_heard_has_no_past(client: Client) -> None:
    told = client.refused("POST", "/replays", 422, json={"vehicle": 1, "begin": T0, "end": T0 + 10.0})
    assert "nothing was received" in told["reason"]
    assert "or at any other time" in told["reason"]
