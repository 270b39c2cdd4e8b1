"""Missions under somebody else's control: a controller in place of the vehicle's own software."""

from collections.abc import Callable
from typing import Any

import numpy as np

from stommel.control.commands import Commands
from stommel.control.orders import Orders
from stommel.control.readings import Readings
from stommel.simulation.mission_loop import RUNNING, begin_step, end_step
from stommel.simulation.setup import Setup

Controller = Callable[[np.record, Orders, Readings, float], Commands]
"""Signature of `stommel.control.decision.decide`: memory, orders, readings, time of the mission [s]."""


def pieces_under(controller: Controller) -> Callable[[Setup, int, int], int]:
    """Return what flies control steps of a setup under a controller, like `stommel.simulation.mission_loop.fly`.

    A function that Numba compiled is called from compiled code; any other from Python.
    """
    if hasattr(controller, "py_func"):
        loop = _compiled_loop(controller)
        return lambda setup, first, last: int(loop(*setup.arguments, first, last))
    return lambda setup, first, last: _fly(controller, setup, first, last)


def _fly(controller: Controller, setup: Setup, first: int, last: int) -> int:
    """Fly control steps `first` to `last`, asking the controller at each."""
    equipment, orders, sea, loop, column, x, memory, world, noise, log = setup.arguments
    for tick in range(first, last):
        outcome, readings = begin_step(equipment, sea, loop, column, x, memory, world, noise, log, tick)
        if outcome != RUNNING:
            return outcome
        before = float(memory.phase)
        commands = Commands(*controller(memory, orders, Readings(*readings), tick * loop.control_step))
        outcome = end_step(equipment, sea, loop, column, x, memory, world, noise, log, readings, commands, before, tick)
        if outcome != RUNNING:
            return outcome
    return RUNNING


def _compiled_loop(controller: Any) -> Any:
    """The same, compiled around a compiled controller; not kept on disk, for the controller is not either."""
    import numba  # noqa: PLC0415 - only compiled controllers need it here

    @numba.njit(error_model="numpy", fastmath={"contract"})
    def loop(  # type: ignore[no-untyped-def]  # compiled only
        equipment, orders, sea, loop, column, x, memory, world, noise, log, first, last
    ):
        for tick in range(first, last):
            outcome, readings = begin_step(equipment, sea, loop, column, x, memory, world, noise, log, tick)
            if outcome != RUNNING:
                return outcome
            before = memory.phase
            commands = controller(memory, orders, readings, tick * loop.control_step)
            outcome = end_step(
                equipment, sea, loop, column, x, memory, world, noise, log, readings, commands, before, tick
            )
            if outcome != RUNNING:
                return outcome
        return RUNNING

    return loop
