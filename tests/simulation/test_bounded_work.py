"""A mission that would never end is refused before it is flown."""

import tomllib
from pathlib import Path
from typing import Any

import pytest

from stommel.errors import FileError
from stommel.simulation.scenario.loading import mission_from
from stommel.simulation.setup import prepare
from stommel.simulation.stiffness import StiffnessError
from tests.support.shipped_files import SHIPPED

TEXT = next(one.text for one in SHIPPED if one.name == "pool_trial.toml")


def mission(**changes: Any) -> Any:
    return mission_from(tomllib.loads(TEXT) | changes, "pool.toml", Path())


def test_a_damping_that_takes_endless_steps_is_named_before_the_flight() -> None:
    """Roll: 15000 kg s over 4 kg m2 at 2 m/s is 15000 1/s; zju as built has 20 over 4, and flies."""
    prepare(mission())
    stiff = mission(changes={"hydrodynamics.roll_damping_kg_s": -15000.0})
    with pytest.raises(StiffnessError) as caught:
        prepare(stiff)
    assert "damped within 6.7e-05 s" in str(caught.value)
    assert "hydrodynamics.roll_damping_kg_s" in str(caught.value)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"duration_days": 730.0, "integration": {"control_step_s": 0.05}, "output_every_s": 10.0},
         "integration.control_step_s = 0.05: makes 1.26e+09 steps of duration_days = 730; at most 1e+08"),
        ({"duration_days": 730.0, "output_every_s": 1.0}, "output_every_s = 1: makes 6.31e+07 steps"),
        ({"duration_days": 700.0, "output_every_s": 60.0, "sampling": {"every_s": 1.0}},
         "sampling.every_s = 1: makes 6.05e+07 steps"),
        ({"duration_days": 1e-9}, "duration_days = 1e-09: must be between 0.0005 and 730 days"),
        ({"seed": 1 << 63}, "seed = 9223372036854775808: must be between 0 and 9223372036854775807"),
    ],
)  # fmt: skip
def test_steps_and_rows_are_bounded(changes: dict[str, Any], words: str) -> None:
    with pytest.raises(FileError) as caught:
        mission(**changes)
    assert words in str(caught.value)
