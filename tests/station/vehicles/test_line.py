"""The line to a vehicle: what is heard is kept as it was, and only then answered.

Oracle: the bytes that the test sends, and the rule of the archive that comes before the answer.
"""

import time
from pathlib import Path

import pytest
from sqlalchemy import select

from stommel.archive.schema import frames, texts
from stommel.station.station import Station
from tests.station.speaker import Speaker, speaker, until
from tests.station.stations import station


def say_state(vehicle: Speaker, depth: float, boot_ms: int) -> None:
    vehicle.say("GLIDER_STATE", time_boot_ms=boot_ms, depth=depth, phase=1, executive=3, dive=2, waypoint=0)


def kept_frames(found: Station, direction: str) -> list[bytes]:
    with found.archive.reading() as connection:
        rows = connection.execute(select(frames.c.frame).where(frames.c.direction == direction).order_by(frames.c.id))
        return [bytes(row.frame) for row in rows]


def test_every_frame_is_kept_as_it_was_in_both_directions(tmp_path: Path) -> None:
    with speaker() as vehicle, station(tmp_path, vehicle.address) as found:
        vehicle.connect()
        vehicle.say("HEARTBEAT", type=12)
        for k in range(50):
            say_state(vehicle, 10.0 + k, 1000 * k)
        until(lambda: len(kept_frames(found, "in")) == 51)
        assert kept_frames(found, "in") == vehicle.sent
        until(lambda: "HEARTBEAT" in vehicle.names())
        heard = [frame.raw for frame in vehicle.heard]  # it speaks on, and what it says is kept a second later
        until(lambda: len(kept_frames(found, "out")) >= len(heard))
        assert kept_frames(found, "out")[: len(heard)] == heard


def test_the_latest_value_of_each_channel_is_known_at_once_and_after_a_restart(tmp_path: Path) -> None:
    """akhenry/openmct-yamcs#133: the latest archived value is there after a reconnect, with its age."""
    with speaker() as vehicle:
        with station(tmp_path, vehicle.address) as found:
            vehicle.connect()
            before = time.time()
            say_state(vehicle, 42.0, 1000)
            until(lambda: "depth_m" in found.hub.values(1))
            assert found.hub.values(1)["depth_m"][1] == 42.0
            assert found.hub.values(1)["dive"][1] == 2.0
        with station(tmp_path, vehicle.address, start=False) as again:
            t, value = again.hub.values(1)["depth_m"]
            assert value == 42.0
            assert before - 1.0 <= t <= time.time()  # what it says is stamped as it comes, by a clock of its own
            assert again.summary(1)["dive"] == 2
            assert again.summary(1)["last_contact"] == pytest.approx(t, abs=1.0)


def test_several_sentences_in_parts_are_kept_as_one(tmp_path: Path) -> None:
    words = "alarm: " + "x" * 60
    with speaker() as vehicle, station(tmp_path, vehicle.address) as found:
        vehicle.connect()
        for k, part in enumerate((words[:50], words[50:])):
            vehicle.say("STATUSTEXT", severity=4, text=part, id=7, chunk_seq=k)

        def kept() -> list[str]:
            with found.archive.reading() as connection:
                return [row.words for row in connection.execute(select(texts.c.words))]

        until(kept)
        assert kept() == [words]


def test_a_line_that_is_lost_opens_again_by_itself(tmp_path: Path) -> None:
    with speaker() as vehicle, station(tmp_path, vehicle.address) as found:
        vehicle.connect()
        say_state(vehicle, 1.0, 1000)
        until(lambda: found.vehicles[1].status().heard)
        vehicle.hang_up()
        vehicle.connect()  # takes a new connection alone: the station has opened one
        say_state(vehicle, 2.0, 2000)
        until(lambda: found.hub.values(1)["depth_m"][1] == 2.0)


def test_a_vehicle_of_another_number_is_not_taken_for_this_one(tmp_path: Path) -> None:
    with speaker(system=9) as vehicle, station(tmp_path, vehicle.address) as found:
        vehicle.connect()
        say_state(vehicle, 5.0, 1000)
        until(lambda: len(kept_frames(found, "in")) == 1)
        assert found.hub.values(1) == {}
        until(lambda: "vehicle 9" in found.vehicles[1].status().reason)
