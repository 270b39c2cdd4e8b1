"""A mission that begins at a longitude beyond 180: every output has it to the west, from the first row on."""

import numpy as np
import pytest

from stommel.geometry.longitudes import wrapped_deg
from stommel.simulation.results.dataset import dataset_of
from tests.simulation.conftest import flown


@pytest.mark.parametrize(
    ("given", "held"), [(182.0, -178.0), (360.0, 0.0), (180.0, 180.0), (-180.0, 180.0), (5.0, 5.0)]
)
def test_longitudes_are_above_minus_180_and_up_to_180(given: float, held: float) -> None:
    assert wrapped_deg(given) == held


def test_one_convention_from_the_first_row_on() -> None:
    place = {"latitude_deg": 30.0, "longitude_deg": 182.0}
    data = dataset_of(flown(start=place, waypoints=[place | {"longitude_deg": 182.5}], duration_days=0.02))
    found = [name for name in data.variables if str(data[name].attrs.get("units")) == "degrees_east"]
    assert {"longitude", "reckoned_longitude"} <= set(map(str, found))
    for name in found:
        values = data[name].values[np.isfinite(data[name].values)]
        assert np.all((values > -178.1) & (values < -177.4)), name
