"""The plant alone: a vehicle in its ocean, stepped by whoever commands it."""

import numpy as np

from stommel.control.commands import Commands
from stommel.control.orders import Orders
from stommel.control.readings import Readings
from stommel.errors import StommelError
from stommel.simulation.flight import Flown, flown_of
from stommel.simulation.mission_loop import OUTCOMES, RUNNING, begin_step, end_step
from stommel.simulation.scenario.mission import Mission
from stommel.simulation.setup import Setup, prepare


class MissionOverError(StommelError):
    """A step after the end of the mission."""


class Simulator:
    """A vehicle in its ocean with sensors, actuators and battery, one control step at a time.

    Each step takes commands and gives readings; the vehicle's own software takes no part. Its `orders` and a fresh
    `memory` are at hand for a controller that builds on `stommel.control.decision.decide`.

    Examples
    --------
    >>> simulator = Simulator(stommel.load_mission("mission.toml"))
    >>> while simulator.running:
    ...     commands = controller(simulator.memory, simulator.orders, simulator.readings, simulator.time)
    ...     readings = simulator.step(commands)

    Parameters
    ----------
    mission
        Where it starts, what the world is like, and how long it may last.

    Raises
    ------
    StommelError
        The vehicle cannot fly the dives that the plan asks for.
    """

    def __init__(self, mission: Mission) -> None:
        self.mission = mission
        self._setup: Setup = prepare(mission)
        self._tick = 0
        self._outcome = RUNNING
        self._before = float(self.memory.phase)
        self._readings = self._sense()

    @property
    def orders(self) -> Orders:
        """What the mission's own software would be told."""
        return self._setup.orders

    @property
    def memory(self) -> np.record:
        """Memory for a controller; what it keeps there of phase and position is written into the log."""
        return self._setup.memory

    @property
    def readings(self) -> Readings:
        """What the sensors say now."""
        return self._readings

    @property
    def time(self) -> float:
        """Time of the mission [s]."""
        return self._tick * self._setup.loop.control_step

    @property
    def running(self) -> bool:
        """Whether the mission goes on."""
        return self._outcome == RUNNING and self._tick < self._setup.ticks

    @property
    def outcome(self) -> str:
        """How the mission ended, or would if it ended now."""
        return OUTCOMES[self._outcome]

    def step(self, commands: Commands) -> Readings:
        """Let the vehicle obey for one control step; returns the readings at its end.

        Raises
        ------
        MissionOverError
            The mission has ended before.
        """
        if not self.running:
            raise MissionOverError(f"{self.mission.origin}: the mission is over: {self.outcome}")
        s = self._setup
        world = (s.equipment, s.sea, s.loop, s.column, s.x, s.memory, s.world, s.noise, s.log)
        self._outcome = end_step(*world, self._readings, Commands(*commands), self._before, self._tick)
        self._tick += 1
        self._before = float(self.memory.phase)
        if self.running:
            self._readings = self._sense()
        return self._readings

    def flown(self) -> Flown:
        """Return what has been flown so far, as `stommel.fly_mission` does."""
        return flown_of(self.mission, self._setup, self._outcome)

    def _sense(self) -> Readings:
        s = self._setup
        self._outcome, readings = begin_step(
            s.equipment, s.sea, s.loop, s.column, s.x, s.memory, s.world, s.noise, s.log, self._tick
        )
        return Readings(*readings)
