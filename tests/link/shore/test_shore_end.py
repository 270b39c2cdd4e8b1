"""Transfers of the shore's end rest while the vehicle is not heard. Oracle: who has paused them."""

import os
import random

from stommel.link.presence import SHORE_HEARTBEAT, Presence
from stommel.link.service import VEHICLE_COMPONENT
from stommel.link.session import Session
from stommel.link.shore.shore_end import ShoreEnd, ShoreSettings
from stommel.link.signing.guard import Guard
from tests.link.files.fakes import MemoryDisk
from tests.onboard.coordination.disk import Disk


def test_a_transfer_rests_without_the_vehicle_and_as_long_as_its_user_wants() -> None:
    vehicle = Session(1, VEHICLE_COMPONENT, [Presence(lambda: SHORE_HEARTBEAT)])
    end = ShoreEnd(ShoreSettings(1, 57_600.0), Guard.unsigned(255), random.Random(1), os.urandom, Disk(), 0.0)
    one, other = end.download("log/a", MemoryDisk(), "a"), end.upload(b"b", "inbox/b")

    def paused(t: float, *, heard: bool) -> tuple[bool, bool]:
        if heard:
            end.take(vehicle.poll(t, 1000), t)
        end.poll(t, 1000)
        return one.is_paused, other.is_paused

    assert paused(0.0, heard=False) == (True, True)
    assert paused(10.0, heard=True) == (False, False)
    one.pause()
    assert paused(11.0, heard=True) == (True, False)
    assert paused(100.0, heard=False) == (True, True)
    assert paused(200.0, heard=True) == (True, False), "its user has not resumed it"
    one.resume(201.0)
    assert paused(201.0, heard=True) == (False, False)
    assert paused(300.0, heard=False) == (True, True)
    end.drop(other)
    assert paused(400.0, heard=True) == (False, True), "what was dropped is left as it was"
