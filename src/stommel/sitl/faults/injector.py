"""Puts the faults of a scenario into the loop: the loop asks it at a few named places."""

from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from stommel.control.commands import Commands
from stommel.control.decision import decide
from stommel.control.orders import Orders
from stommel.control.readings import Readings
from stommel.instruments.gpctd.device import CtdTruth
from stommel.messages.frames import Frame
from stommel.onboard.coordination.logbook.framing import LogIdentity
from stommel.onboard.coordination.logbook.logbook import Logbook, LogSettings
from stommel.simulation.plant.hull_air import Hull
from stommel.sitl.faults import table
from stommel.sitl.faults.acting import Acting
from stommel.sitl.faults.disk import MemoryDisk
from stommel.sitl.faults.fault import Fault
from stommel.sitl.faults.on_bus import NUMBERS, BusFaults
from stommel.sitl.faults.on_machinery import hull_with, run_down, wear_of
from stommel.sitl.faults.on_sensors import bytes_with, ctd_with, felt_with, loop_whole
from stommel.sitl.plant import Felt, Plant

if TYPE_CHECKING:
    from stommel.sitl.can_bus import SimulatedBus

COMPUTERS = {number: name for name, number in NUMBERS.items()}


class InjectedError(Exception):
    """What the decision ends in, as told."""


class Injector:
    """The faults of one flight.

    Parameters
    ----------
    faults
        All that happens.
    seed
        Of the flight.
    disk
        Of the coordinator; None where the loop keeps no log.
    """

    def __init__(self, faults: Sequence[Fault] = (), seed: int = 0, disk: MemoryDisk | None = None) -> None:
        self.faults, self.disk = tuple(faults), disk
        self.acting: list[Acting] = []
        """Those that act now."""
        self.logbooks: list[Logbook] = []
        """Of each start of the coordinator."""
        self._all = [Acting(fault, seed) for fault in self.faults]
        self._bus = BusFaults()
        self._draw = np.random.default_rng((seed, 0))
        self._down: set[int] = set()
        self._falling: dict[int, float] = {}
        self._hull: Hull | None = None
        self._expired = False

    # the loop asks these, once in each step

    def begin(self, plant: Plant, bus: "SimulatedBus") -> list[int]:
        """Begin a step: break the machinery, and return the numbers of the computers that start anew."""
        if not self._all:
            return []
        t = plant.time
        acting = [one for one in self._all if one.fault.holds(t)]
        if acting != self.acting:
            self.acting = acting
            self._break(plant, bus)
        for one in acting:
            if one.kind == "battery_run_down":
                run_down(plant, one.value)
        for sender, frame in self._bus.late:
            bus.deliver(sender, frame)
        self._bus.late = []
        for frame in self._bus.strangers() if any(one.kind == "stranger" for one in acting) else ():
            bus.deliver(0, frame)
        return self._power()

    def runs(self, node: int) -> bool:
        """Whether a computer has power through this step's beginning."""
        return node not in self._down

    def sent(self, node: int, frames: list[Frame]) -> list[Frame]:
        """Return the frames that a computer still sends before its power goes, those of this step."""
        share = self._falling.get(node)
        return frames if share is None else frames[: round(share * len(frames))]

    def falls(self, node: int) -> bool:
        """Whether a computer loses its power in the middle of this step."""
        return node in self._falling

    def felt(self, felt: Felt) -> Felt:
        """Return what the electronics feels."""
        if not self.acting:
            return felt
        for one in self.acting:
            if one.kind == "supply_drop":
                felt = felt._replace(readings=felt.readings._replace(voltage=min(one.value, felt.readings.voltage)))
        return felt_with(self.acting, felt)

    def leak_loop(self) -> bool:
        """Whether the test resistors of the leak detectors are felt."""
        return not self.acting or loop_whole(self.acting)

    def ctd(self, truth: CtdTruth) -> CtdTruth:
        """Return what the CTD measures."""
        return ctd_with(self.acting, truth) if self.acting else truth

    def heard(self, port: str, data: bytes) -> bytes:
        """Return the bytes of an instrument that arrive."""
        return bytes_with(self.acting, port, data) if self.acting else data

    def radio_works(self) -> bool:
        """Whether the vehicle's radio is not dead."""
        return not any(one.kind == "radio_dead" for one in self.acting)

    def radio_loss(self) -> float:
        """Least share of the radio's packets that are lost."""
        return max((one.value for one in self.acting if one.kind == "radio_packets_lost"), default=0.0)

    def clock(self, t: float) -> float:
        """Time by the coordinator's clock [s]."""
        return t + sum(one.value for one in self.acting if one.kind == "clock_jump") if self.acting else t

    def expired(self) -> bool:
        """Whether the mission's time is over before it should be."""
        self._expired = self._expired or any(one.kind == "early_expiry" for one in self.acting)
        return self._expired

    def decision(self) -> Callable[[np.record, Orders, Readings, float], Commands] | None:
        """Return the decision that sometimes ends in an exception; None where none does."""
        if not any(one.kind == "decision_exception" for one in self._all):
            return None
        sound = decide

        def decision(memory: np.record, orders: Orders, readings: Readings, t: float) -> Commands:
            if any(one.kind == "decision_exception" and one.strikes() for one in self.acting):
                raise InjectedError("told to fail")
            commands: Commands = sound(memory, orders, readings, t)
            return commands

        return decision

    def new_logbook(self, disk: MemoryDisk, identity: LogIdentity, t: float) -> Logbook:
        """Return the logbook of a coordinator that starts, on the disk of the one before."""
        self.logbooks.append(Logbook(disk, LogSettings(), identity, self.clock(t)))
        return self.logbooks[-1]

    # inside

    def _break(self, plant: Plant, bus: "SimulatedBus") -> None:
        """Let plant, bus and disk be as the faults say that act now."""
        plant.wear = wear_of(self.acting)
        if self._hull is None:
            self._hull = plant.setup.equipment.hull
        plant.replace_hull(hull_with(self.acting, plant.setup.equipment.hull, self._hull))
        self._bus.acting = [one for one in self.acting if one.fault.row.where == table.BUS]
        bus.spoil = self._bus.spoil if self._bus.acting else None
        bus.deaf = self._bus.off()
        if self.disk is not None:
            self.disk.full = any(one.kind == "disk_full" for one in self.acting)

    def _power(self) -> list[int]:
        """Follow who has power; return who starts anew."""
        before, self._falling = self._down | set(self._falling), {}
        down: set[int] = set()
        for one in self.acting:
            for node, share in _unpowered(one):
                down.add(node)
                if node not in before:
                    self._falling[node] = min(share, self._falling.get(node, 1.0))
        self._down = down - set(self._falling)
        # a power cut shorter than a step is one all the same
        return sorted(before - down)

    def lose_power(self) -> None:
        """Let the coordinator's disk lose what it has not yet written."""
        if self.disk is not None:
            self.disk.lose_power(self._draw)


def _unpowered(one: Acting) -> Iterable[tuple[int, float]]:
    """Computers without power, and the share of their frames that they still say as it goes."""
    if one.kind == "brown_out":
        return ((NUMBERS[one.target], one.value),)
    if one.kind == "supply_drop" and one.value < table.BROWN_OUT_VOLTAGE:
        return tuple((number, 0.0) for number in COMPUTERS)
    return ()
