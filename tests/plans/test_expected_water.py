"""Which water is expected where. Oracle: the oceans themselves."""

import pytest

from stommel.errors import StommelError
from stommel.geometry.geodesics import Place, travel
from stommel.ocean.ocean import Ocean
from stommel.plans.expected_water import ocean_at, room_at

SEA = Ocean.analytic("east_china_sea")
AROUND = [
    travel(28.2, 126.6, float(bearing), 1e3 * distance)
    for bearing in range(0, 360, 20)
    for distance in (0, 40, 90, 150, 185, 230, 280, 400)
]


def depth(place: Place) -> float | None:
    """Depth of the bottom of the East China Sea; None outside of it."""
    try:
        return SEA.bottom_depth(*place)
    except StommelError:
        return None


@pytest.mark.parametrize("place", AROUND, ids=[f"{p.latitude_deg:.2f},{p.longitude_deg:.2f}" for p in AROUND])
def test_the_sea_is_expected_only_where_it_is(place: Place) -> None:
    bottom = depth(place)
    if ocean_at(place) == "east_china_sea":
        assert bottom is not None
        if bottom > 75.0:  # the innermost shelf is shallower than any dive that is offered
            assert room_at(place, 180.0) < bottom
    else:
        assert room_at(place, 180.0) == 180.0


def test_most_of_the_sea_is_expected() -> None:
    inside = [place for place in AROUND if depth(place) is not None]
    assert sum(ocean_at(place) == "east_china_sea" for place in inside) > 0.85 * len(inside)
    assert ocean_at(Place(0.0, -30.0)) == "south_china_sea"
