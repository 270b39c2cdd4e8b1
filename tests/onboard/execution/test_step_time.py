"""A step of the nodes is short: the loop flies 1000 times real time (measured here with room for a busy machine)."""

from time import perf_counter

import pytest

from stommel.messages.codec import Encoder
from stommel.onboard.execution.acquisition_node import AcquisitionNode
from stommel.onboard.nodes.acquisition_settings import AcquisitionSettings
from tests.onboard.execution.motion_bench import MotionBench
from tests.onboard.execution.test_acquisition_node import WELL

STEPS = 200


def quickest(step) -> float:
    """Time of one step in the best of some hundreds [s]."""
    times = []
    for k in range(STEPS):
        began = perf_counter()
        step(k)
        times.append(perf_counter() - began)
    return min(times)


@pytest.mark.parametrize("node", ["motion", "acquisition"])
def test_a_step_in_which_nothing_changes_and_nothing_is_due_takes_less_than_60_us(node):
    if node == "motion":
        bench = MotionBench()
        bench.go_to()
        bench.run(5)
        readings = bench.plant.readings()
        took = quickest(lambda k: bench.node.step(4.0 + 1e-4 * k, [], readings, 1.0))
    else:
        acquisition = AcquisitionNode(AcquisitionSettings())
        acquisition.step(0.0, [Encoder().frame("Sync", vehicle_time=0.0)], WELL, b"")
        took = quickest(lambda k: acquisition.step(1e-4 * k, [], WELL, b""))
    assert took < 60e-6
