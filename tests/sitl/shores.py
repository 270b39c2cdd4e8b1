"""A shore for the loop: its end of the link on the mission's own clock, all chance from a seed."""

import random

from stommel.link.shore.shore_end import ShoreEnd, ShoreSettings
from stommel.link.signing.guard import Guard
from stommel.simulation.scenario.mission import Mission
from stommel.sitl.faults.disk import MemoryDisk
from stommel.sitl.radio.station import SYSTEM


class LoopShore:
    """The shore's end, by the time of the mission; notes every byte that came."""

    def __init__(self, mission: Mission, seed: int = 0, guard: Guard | None = None) -> None:
        self.start = mission.scenario.start_time.timestamp()
        draw = random.Random(seed)
        guard = Guard.unsigned(255) if guard is None else guard
        self.end = ShoreEnd(ShoreSettings(SYSTEM, 115_200.0), guard, draw, draw.randbytes, MemoryDisk(), self.start)
        self.came = bytearray()

    def take(self, data: bytes, t: float) -> None:
        self.came += data
        self.end.take(data, self.start + t)

    def poll(self, t: float, room: int) -> bytes:
        return self.end.poll(self.start + t, room)
