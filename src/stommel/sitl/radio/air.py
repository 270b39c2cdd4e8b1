"""The air between the vehicle's radio and a shore, on the loop's time."""

import math
from collections.abc import Callable
from typing import Protocol

from stommel.link.channel.channel import Channel
from stommel.link.channel.settings import ChannelSettings
from stommel.sitl.plant import Plant
from stommel.sitl.radio.antenna import Antenna

LOOKS = 10
"""How often in a step both ends hear and speak."""
_IDLE = 2
"""Looks at which neither end had anything to say, and nothing was on its way, after which a step is done."""


class End(Protocol):
    """One end of the link."""

    def take(self, data: bytes, t: float) -> object:
        """Take bytes that came until a time [s]."""

    def poll(self, t: float, room: int) -> bytes:
        """Return at most so many bytes to send."""


class Air:
    """Carries bytes while the vehicle's radio has power and its antenna is out of the water.

    Parameters
    ----------
    plant
        The vehicle in its waves.
    settings
        Of the channel.
    shore
        Whoever listens ashore; None: nobody, and the vehicle calls into the empty air.
    """

    def __init__(self, plant: Plant, settings: ChannelSettings, shore: End | None = None) -> None:
        self.antenna = Antenna(plant, tethered=settings.tethered)
        self.tethered = settings.tethered
        """Whether a cable feeds the vehicle's radio, also while the vehicle has switched it off."""
        self.shore = shore
        self.on = False
        """Whether the vehicle's radio has power."""
        self.wait: Callable[[float], None] | None = None
        """Returns when it is time for a time of the mission [s]; as fast as it goes if None."""
        self.channel = Channel(settings, plant.mission.scenario.seed, self._is_linked)

    def _is_linked(self, t: float) -> bool:
        return self.on and self.antenna.emerges(t)

    def worsen(self, loss: float) -> None:
        """Let at least this share of all packets be lost from here on."""
        self.channel.least_loss = loss

    def pass_time(self, vehicle: End | None, t: float, step: float, offset: float, *, on: bool) -> None:
        """Let a step pass in which both ends speak.

        Parameters
        ----------
        vehicle
            The vehicle's end; None while its computer is down.
        t
            Time of the mission at which the step begins [s].
        step
            Its length [s].
        offset
            The vehicle's clock less the time of the mission [s].
        on
            Whether the vehicle's radio has power.
        """
        self.on = on
        if (not on or vehicle is None) and self.wait is None:
            self._speak(self.shore, t, 0.0, ashore=True)
            return
        self.antenna.look()
        idle = 0
        for look in range(LOOKS if self.shore is not None or self.wait is not None else 1):
            now = t + step * look / LOOKS
            if self.wait is not None:
                self.wait(now)
            spoke = self._speak(vehicle if on else None, now, offset, ashore=False)
            spoke |= self._speak(self.shore, now, 0.0, ashore=True)
            idle = 0 if spoke or self.channel.next_event() < math.inf else idle + 1
            if idle >= _IDLE and self.wait is None:
                return

    def _speak(self, end: End | None, t: float, offset: float, *, ashore: bool) -> bool:
        """Let an end hear and speak; whether it did either."""
        port = self.channel.shore if ashore else self.channel.vehicle
        data = port.read(t)
        if end is None:
            return False
        end.take(data, t + offset)
        said = end.poll(t + offset, port.room(t))
        if said:
            port.write(said, t)
        return bool(data or said)
