"""Sums of a mission so far. Oracle: added up by hand."""

from typing import Any

import pytest
from pyproj import Geod

from stommel.plans.comparison import compared
from stommel.plans.so_far import Total, so_far


def dive(number: int, begin: float, lasts: float = 3000.0, **values: Any) -> dict[str, Any]:
    """Goes 0.02 deg to the east along the equator."""
    return {
        "dive": number, "t_begin": begin, "t_end": begin + lasts, "latitude_begin": 0.0,
        "longitude_begin": 0.02 * number, "latitude_end": 0.0, "longitude_end": 0.02 * number + 0.02,
        "greatest_depth_m": 68.0, "energy_j": 4000.0,
    } | values  # fmt: skip


def test_time_has_the_surface_in_it_energy_and_way_are_sums() -> None:
    """Predicted are three dives an hour apart; the second was flown and never reported, a fourth not predicted."""
    predicted = [dive(k, 3600.0 * (k - 1)) for k in (1, 2, 3)]
    flown = [
        dive(11, 100.0, energy_j=4500.0), dive(13, 8000.0, 3100.0, energy_j=4600.0, longitude_end=0.285),
        dive(14, 11_500.0),
    ]  # fmt: skip
    found = so_far(compared(predicted, flown, 0.0))
    assert found is not None
    assert (found.first, found.last) == (1, 3)
    assert found.time_s == Total(2, 2 * 3600.0 + 3000.0, 11_000.0, 800.0)
    assert found.energy_j == Total(2, 8000.0, 9100.0, 1100.0)
    earth, equator = Geod(ellps="WGS84"), (0.0, 0.0)
    short, long = (earth.inv(0.0, equator[0], east, equator[1])[2] for east in (0.04, 0.045))
    assert found.distance_m is not None
    assert found.distance_m.dives == 2
    assert found.distance_m.predicted == pytest.approx(short, rel=1e-9)
    assert found.distance_m.flown == pytest.approx(long, rel=1e-9)


def test_what_is_not_known_is_in_neither_sum() -> None:
    predicted = [dive(1, 0.0), dive(2, 3600.0, energy_j=None), dive(3, 7200.0)]
    flown = [
        dive(5, 0.0, energy_j=None),
        dive(6, 3600.0),
        dive(7, 7200.0, latitude_end=None, energy_j=5000.0, t_end=None),
    ]
    found = so_far(compared(predicted, flown, 0.0))
    assert found is not None
    assert found.energy_j == Total(1, 4000.0, 5000.0, 1000.0)
    assert found.distance_m is not None
    assert found.distance_m.dives == 2
    assert found.time_s == Total(2, 6600.0, 6600.0, 0.0)


def test_without_a_dive_of_both_kinds_there_is_no_sum() -> None:
    assert so_far(compared([dive(1, 0.0)], [], 0.0)) is None
    assert so_far(compared([], [dive(1, 0.0)], 0.0)) is None
    unknown = so_far(compared([dive(1, 0.0, energy_j=None)], [dive(1, 0.0, t_end=None, longitude_end=None)], 0.0))
    assert unknown == (1, 1, None, None, None)
