"""One decision of the vehicle's software: as plain Python, and compiled."""

from time import process_time

import numpy as np

from figures.registry import Measurement, figure
from stommel.compilation import compiled
from stommel.control.decision import decision
from stommel.control.memory import MEMORY
from stommel.control.orders import Orders
from stommel.control.own_laws import with_laws
from stommel.control.readings import Readings
from stommel.simulation.scenario.loading import load_mission
from stommel.simulation.scenario.shipped import mission_path
from stommel.simulation.simulator import Simulator

_PLAIN, _COMPILED = 2_000, 1_000_000


def _under_way() -> tuple[Simulator, Readings]:
    """The software of the pool trial, put into a dive."""
    simulator = Simulator(load_mission(mission_path("pool_trial")))
    simulator.memory.phase = 1.0
    return simulator, simulator.readings._replace(depth=1.0)


@figure(unit="ms", bar=1.0)
def decision_plain_python_ms() -> Measurement:
    """Measure one decision in a dive as plain Python, without the compiler [ms]."""
    simulator, readings = _under_way()
    plain = with_laws()
    plain(simulator.memory, simulator.orders, readings, 100.0)
    began = process_time()
    for k in range(_PLAIN):
        plain(simulator.memory, simulator.orders, readings, 100.0 + k)
    return Measurement(1e3 * (process_time() - began) / _PLAIN, {"decisions": _PLAIN})


@compiled
def _decide_many(memory: np.record, orders: Orders, readings: Readings, n: int) -> float:
    total = 0.0
    for k in range(n):
        total += decision(memory, orders, readings, 100.0 + 1e-3 * k).r_px
    return total


@figure(unit="s", bar=0.4)
def decision_20d_s() -> Measurement:
    """Measure the 1 728 000 decisions of a 20-day mission at 1 Hz, compiled, apart from everything else [s]."""
    simulator, readings = _under_way()
    memory = np.array([simulator.memory], MEMORY).view(np.recarray)[0]
    _decide_many(memory, simulator.orders, readings, 10)
    began = process_time()
    _decide_many(memory, simulator.orders, readings, _COMPILED)
    each = (process_time() - began) / _COMPILED
    return Measurement(1_728_000 * each, {"ns_each": 1e9 * each})
