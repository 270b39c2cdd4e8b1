"""The same water in a given current. Oracle: what was given, and the water of the ocean as it was."""

import numpy as np
import pytest

from stommel.errors import StommelError
from stommel.ocean.ocean import Ocean

SEAS = [("east_china_sea", (29.5, 125.0)), ("gyre", None), ("south_china_sea", (18.0, 115.0)), ("tide", (30.0, 125.0))]


@pytest.mark.parametrize(("name", "place"), SEAS, ids=[name for name, _ in SEAS])
def test_it_is_the_given_one_everywhere_and_always(name: str, place: tuple[float, float] | None) -> None:
    ocean = Ocean.analytic(name)
    latitude, longitude = place or tuple(float(nodes.mean()) for nodes in ocean.node_places())
    moving = ocean.with_current(0.3, -0.1)
    for t, depth in ((1.78e9, 0.0), (1.78e9 + 20_000.0, 40.0)):
        before, after = (sea.at(t, latitude, longitude, depth) for sea in (ocean, moving))
        assert after.current_east == pytest.approx(0.3, abs=1e-6)
        assert after.current_north == pytest.approx(-0.1, abs=1e-6)
        assert (after.density, after.temperature, after.bottom_depth) == (
            before.density, before.temperature, before.bottom_depth,
        )  # fmt: skip


def test_the_ocean_itself_stays_as_it_was() -> None:
    ocean = Ocean.analytic("east_china_sea")
    before = ocean.data.nodes.water.copy()
    ocean.with_current(1.0, 1.0)
    assert np.array_equal(before, ocean.data.nodes.water)


@pytest.mark.parametrize("speed", [5.1, -6.0, float("nan")])
def test_an_impossible_one_is_refused(speed: float) -> None:
    with pytest.raises(StommelError, match="must be between -5 and 5"):
        Ocean.analytic("still").with_current(speed, 0.0)
