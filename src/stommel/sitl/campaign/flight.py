"""One flight with faults, from its start to its verdict."""

import hashlib
import traceback
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from math import inf, sin

import numpy as np

from stommel.errors import StommelError
from stommel.link.channel.settings import ChannelSettings
from stommel.messages.database import COORDINATOR
from stommel.onboard.coordination.engine_proof import STROKES
from stommel.simulation.scenario.mission import Mission
from stommel.simulation.setup import Setup
from stommel.sitl.campaign.survival import Means, Profile, Struck, is_hidden, takes_buoyancy, unsurvivable
from stommel.sitl.campaign.verdict import (
    FAILED,
    PASSED,
    UNSURVIVABLE,
    Verdict,
    Watch,
    ending_of,
    wrong_end,
    wrong_log,
)
from stommel.sitl.faults.disk import MemoryDisk
from stommel.sitl.faults.fault import Fault
from stommel.sitl.faults.injector import Injector
from stommel.sitl.system import System

EXPIRY_BEFORE_END = 1800.0
"""How long before the flight's end the mission's time is over [s]: a vehicle with nothing broken is up by then."""
_DEEPEST = 6000.0
"""Deepest water that a vehicle whose file states no rating is followed to [m]."""
_WATER = 1025.0
"""Density of the water that a dropped weight is counted in [kg/m3]."""


@dataclass
class FaultFlight:
    """A flight with faults, step by step."""

    mission: Mission
    faults: tuple[Fault, ...]
    radio: ChannelSettings = field(default_factory=ChannelSettings)
    disk: MemoryDisk = field(default_factory=MemoryDisk)
    escaped: str = ""
    """Exception that no one caught, in words."""

    def __post_init__(self) -> None:
        scenario = self.mission.scenario
        self.inject = Injector(self.faults, scenario.seed, self.disk)
        seconds = scenario.duration_days * 86400.0
        self.expires = seconds - EXPIRY_BEFORE_END if seconds > 2.0 * EXPIRY_BEFORE_END else inf
        self.system = System(self.mission, inject=self.inject, expires=self.expires, radio=self.radio)
        self.watch = Watch(self.system)
        self.struck: list[Struck] = []
        self._sinks = 0.0
        self._strikes = sorted({fault.at for fault in self.faults if takes_buoyancy(fault)})

    def fly(self) -> Verdict:
        """Fly to the end."""
        try:
            while self.system.running:
                self.step()
            if self.inject.runs(COORDINATOR):
                self.inject.logbooks[-1].sync(self.system.plant.time)
        except StommelError as error:
            self.escaped = _told(error)
        except (MemoryError, KeyboardInterrupt):
            raise
        except Exception as error:  # noqa: BLE001 - that none escapes is what is tested
            self.escaped = _told(error)
        return self.verdict()

    def step(self) -> None:
        """Let one step pass."""
        plant = self.system.plant
        while self._strikes and plant.time >= self._strikes[0]:
            self._strikes.pop(0)
            self.struck.append(self._struck())
        t, before, oil = plant.time, plant.depth, plant.oil
        self.system.step()
        self._sinks = (plant.depth - before) / plant.step
        if self.struck and self.struck[-1].t == t and self._is_unseen(t, oil):
            self.struck[-1] = self.struck[-1]._replace(runs_in_to=plant.setup.orders.dives.V_b_dive)
        self.watch.look()

    def _is_unseen(self, t: float, oil: float) -> bool:
        """Whether what struck in the step at a time [s], with so much oil outside [m3], tells itself only later.

        So it is while the valve is open, after a proof where the climb's ballast is outside.
        """
        setup = self.system.plant.setup
        engine = setup.equipment.plant.engine
        proven = oil <= setup.orders.dives.V_b_climb + (engine.high - engine.low) / STROKES
        return proven and self.system.outputs.valve > 0.0 and is_hidden(self.faults, t)

    def _struck(self) -> Struck:
        """What a pilot finds as a fault strikes."""
        plant = self.system.plant
        if not plant.tick:  # the column of water is looked up by the first step
            return Struck(plant.time, plant.depth, plant.oil, plant.oil)
        spare = plant.spare(0.0)
        depths = np.linspace(0.0, min(_DEEPEST, plant.setup.equipment.hull.deepest), 41)
        lighter = Profile(depths, np.array([plant.spare(depth) - spare for depth in depths]))
        return Struck(plant.time, plant.depth, plant.oil, spare, self._sinks, lighter)

    def verdict(self) -> Verdict:
        """What became of it."""
        committed = sum(counts.committed for log in self.inject.logbooks for counts in log.counts.values())
        ending = ending_of(self.system)
        if self.escaped:
            return Verdict(FAILED, f"an exception escaped: {self.escaped}", ending)
        wrong = self.watch.broken or wrong_log(self.disk, committed)
        if wrong:
            return Verdict(FAILED, wrong, ending)
        wrong = wrong_end(self.system)
        if not wrong:
            return Verdict(PASSED, "", ending)
        name = unsurvivable(self.faults, self.struck, means_of(self.system.plant.setup))
        return Verdict(UNSURVIVABLE, f"{name}: {wrong}", ending) if name else Verdict(FAILED, wrong, ending)

    def digest(self) -> str:
        """SHA-256 over every byte of the log and the track: two flights are the same if this is."""
        made = hashlib.sha256()
        for name in sorted(self.disk.files):
            made.update(name.encode() + bytes(self.disk.files[name].data))
        made.update(np.ascontiguousarray(self.system.plant.setup.x).tobytes())
        return made.hexdigest()


def means_of(setup: Setup) -> Means:
    """What the vehicle has to come up with."""
    plant, dives = setup.equipment.plant, setup.orders.dives
    return Means(
        engine=plant.engine,
        drop_volume=plant.drop_weight / _WATER,
        lost_below=setup.equipment.hull.deepest,
        ends=setup.ticks * setup.loop.control_step,
        sink_speed=0.25,
        speed_volume=abs(dives.V_b_dive),
        settling_way=sin(dives.theta) / setup.orders.table.drag_per_mass,
    )


def with_seed(mission: Mission, seed: int) -> Mission:
    """The same mission with other random draws."""
    scenario = mission.scenario.model_copy(update={"seed": seed})
    return replace(mission, scenario=scenario, document=dict(mission.document) | {"seed": seed})


def fly_with(mission: Mission, faults: Sequence[Fault], radio: ChannelSettings | None = None) -> Verdict:
    """Fly a mission with faults to its end, through the air of a calm day or another."""
    return FaultFlight(mission, tuple(faults), ChannelSettings() if radio is None else radio).fly()


def _told(error: Exception) -> str:
    last = traceback.extract_tb(error.__traceback__)[-1]
    name = last.filename.rsplit("stommel/", 1)[-1]
    return " ".join(f"{type(error).__name__} in {name}:{last.lineno}: {error}".split())
