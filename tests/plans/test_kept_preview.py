"""What of a preview is kept beside a mission. Oracle: its stated bounds, and what is refused beyond them."""

from typing import Any

import pytest

from stommel.errors import FileError
from stommel.geometry.geodesics import Place
from stommel.plans.kept_preview import MOST_DIVES, MOST_GIVEN, MOST_POINTS, WITHIN_M, kept_preview
from stommel.plans.predicted_track import PredictedTrack

DIVE = {
    "dive": 1, "t_begin": 0.0, "t_end": 600.0, "latitude_begin": 28.7, "longitude_begin": 126.1,
    "latitude_end": 28.7, "longitude_end": 126.1, "greatest_depth_m": 68.0, "current_north_m_s": None,
    "current_east_m_s": 0.1, "energy_j": 4e3,
}  # fmt: skip


def point(t: float, latitude: float = 28.7, longitude: float = 126.1) -> dict[str, float]:
    return {"t": t, "lat": latitude, "lon": longitude}


def test_a_whole_track_is_kept_within_its_bounds() -> None:
    """As far as it can be: 4000 points of a way that turns at each."""
    whole = [point(10.0 * k, 28.7 + 0.003 * (k % 3), 126.0 + 1e-3 * k) for k in range(MOST_GIVEN)]
    found = kept_preview({"dives": [DIVE], "track": whole, "series": {"t": [1.0]}, "verdict": "done"}).thinned()
    assert len(found.track) <= MOST_POINTS
    assert (found.track[0].t, found.track[-1].t) == (0.0, 10.0 * (MOST_GIVEN - 1))
    away = PredictedTrack([Place(each.lat, each.lon) for each in found.track]).off(
        [Place(each["lat"], each["lon"]) for each in whole]
    )
    assert found.track_within_m is not None
    assert max(far or 0.0 for far in away) <= found.track_within_m * 1.001
    straight = kept_preview(
        {"dives": [], "track": [point(float(k), 28.7, 126.0 + 1e-4 * k) for k in range(50)]}
    ).thinned()
    assert (len(straight.track), straight.track_within_m) == (2, WITHIN_M)
    assert kept_preview({"dives": [], "track": [point(0.0)]}).thinned().track_within_m is None


def test_what_stations_of_before_kept_is_still_read() -> None:
    found = kept_preview(
        {"dives": [DIVE], "duration_s": 86_400.0, "energy_j": 1e5, "battery_left_share": 0.9, "t_begin": 0.0}
    )
    assert (found.track, found.track_within_m, found.duration_s, found.distance_m) == ([], None, 86_400.0, None)


def test_over_the_date_line_it_is_written_as_everywhere() -> None:
    assert [each.lon for each in kept_preview({"dives": [], "track": [point(0.0, 0.0, 180.5)]}).track] == [-179.5]


@pytest.mark.parametrize(
    ("told", "key", "allowed"),
    [
        ({}, "dives", "missing"),
        ({"dives": [DIVE | {"dive": 0}]}, "dives.0.dive", "between 1 and 1000000"),
        ({"dives": [DIVE | {"latitude_end": 91.0}]}, "dives.0.latitude_end", "-90"),
        ({"dives": [DIVE | {"energy_j": -1.0}]}, "dives.0.energy_j", "0"),
        ({"dives": [DIVE | {"greatest_depth_m": 13_000.0}]}, "dives.0.greatest_depth_m", "12000"),
        ({"dives": [DIVE] * (MOST_DIVES + 1)}, "dives", f"at most {MOST_DIVES}"),
        ({"dives": [], "track": [point(0.0)] * (MOST_GIVEN + 1)}, "track", f"at most {MOST_GIVEN}"),
        ({"dives": [], "track": [point(float("nan"))]}, "track.0.t", ""),
        ({"dives": [], "track": [point(0.0, longitude=361.0)]}, "track.0.lon", "360"),
        ({"dives": [], "battery_left_share": 1.1}, "battery_left_share", "1"),
        ({"dives": [], "duration_s": float("inf")}, "duration_s", ""),
        ({"dives": "none"}, "dives", "list"),
    ],
)
def test_what_is_out_of_range_is_refused_with_its_key(told: dict[str, Any], key: str, allowed: str) -> None:
    with pytest.raises(FileError) as refused:
        kept_preview(told)
    assert key in str(refused.value)
    assert allowed in str(refused.value)
