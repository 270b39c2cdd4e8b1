"""Flights where nothing is compiled, as `STOMMEL_COMPILE=0` has it. Oracle: the machine code of the same functions.

Sums of products may be fused there, so that last digits differ.
"""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from stommel.simulation.flight import Flown, fly_mission
from stommel.sitl.flight import fly
from stommel.sitl.system import System
from tests.sitl.comparison import mission_of

SECONDS = 600.0
SAME = 1e-9
"""Of the greatest number of a column, after minutes in which rounding errors grow."""
A_STEP = 5e-3
"""The same of what a drive takes: where the last digit of its way is another, it runs for a step more or less."""
OF_DRIVES = ("voltage", "current", "energy")

FLY = """
import sys
import numpy as np
from tests.sitl.test_without_compiler import flown
found = flown(sys.argv[1], sys.argv[2])
assert "numba" not in sys.modules
np.savez(sys.argv[3], record=found.record, events=found.events, samples=found.samples)
"""


def flown(how: str, name: str) -> Flown:
    """A shipped mission cut short, with all errors of its sensors."""
    mission = mission_of(name, SECONDS, errors=True)
    return fly_mission(mission) if how == "simulate" else fly(System(mission))


def same(slow: NDArray[np.void], fast: NDArray[np.void]) -> None:
    assert len(slow) == len(fast)
    for name in fast.dtype.names or ():
        largest = max(1.0, float(np.nanmax(np.abs(fast[name]), initial=0.0)))
        within = (A_STEP if name in OF_DRIVES else SAME) * largest
        np.testing.assert_allclose(slow[name], fast[name], rtol=0.0, atol=within, err_msg=name)


@pytest.mark.parametrize(
    ("how", "name"), [("simulate", "kuroshio"), ("simulate", "pool_trial"), ("sitl", "pool_trial")]
)
def test_a_flight_without_the_compiler_is_the_same(tmp_path: Path, how: str, name: str) -> None:
    plain = {"STOMMEL_COMPILE": "0", "PYTHONPATH": os.pathsep.join(sys.path)}
    asked = [sys.executable, "-c", FLY, how, name, "slow.npz"]
    subprocess.run(asked, env=os.environ | plain, cwd=tmp_path, check=True, timeout=300)
    fast = flown(how, name)
    with np.load(tmp_path / "slow.npz") as slow:
        same(slow["record"], fast.record)
        same(slow["events"], fast.events)
        same(slow["samples"], fast.samples)
    assert len(fast.record) >= 60
    assert len(fast.events) > 0
