"""Commands in progress. Oracle: the rule that a reading of a silent sensor is no number."""

import math
from types import SimpleNamespace

import pytest

from stommel.link.commands import table
from stommel.link.commands.states import UNKNOWN_PERCENT, Command, State, When
from stommel.onboard.radio.commands import VehicleCommands


def view(t: float, depth: float) -> SimpleNamespace:
    readings = SimpleNamespace(depth=depth)
    return SimpleNamespace(t=t, situation=SimpleNamespace(readings=readings), executive=SimpleNamespace(surfaced=False))


@pytest.mark.parametrize(
    ("begun", "now", "percent"), [(50.0, 20.0, 60), (50.0, math.nan, UNKNOWN_PERCENT), (math.nan, 9.0, 0)]
)
def test_the_way_up_is_told_as_far_as_the_depth_is_known(begun: float, now: float, percent: int) -> None:
    coordinator = SimpleNamespace(view=view(1.0, begun), request=lambda _: None)
    commands = VehicleCommands(coordinator, SimpleNamespace())  # type: ignore[arg-type]
    commands.begin(Command(7, table.SURFACE, (0.0,) * 4, When.AT_ONCE, 0, 1))
    coordinator.view = view(2.0, now)
    found = commands.progress(7)
    assert found is not None
    assert (found.state, found.percent) == (State.IN_PROGRESS, percent)
