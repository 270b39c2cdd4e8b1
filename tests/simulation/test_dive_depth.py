"""No dive is deeper than asked: oracle, the whole path as the equations of motion fly it."""

import numpy as np
import pytest

from tests.simulation.conftest import EXACT, Document, column, flown, stays

PLACES = {"east_china_sea": (28.0, 127.0)}


def deepest_of_dives(sea: Document, depth: float, pitch: float, speed: float, sensors: Document) -> np.ndarray:
    latitude, longitude = PLACES.get(sea["name"], (18.0, 116.0))
    found = flown(
        ocean=sea,
        start={"latitude_deg": latitude, "longitude_deg": longitude},
        waypoints=[{"latitude_deg": latitude + 0.5, "longitude_deg": longitude}],
        dives={"depth_m": depth, "pitch_deg": pitch, "speed_m_s": speed},
        sensors=sensors,
        duration_days=0.1,
        output_every_s=1.0,
    )
    t, z = column(found, "time"), column(found, "depth")
    turned = [(begin, end) for begin, end in stays(found, "descent") if end + 300.0 < t[-1]]
    assert len(turned) >= 2
    return np.array([z[(t >= begin) & (t < end + 300.0)].max() for begin, end in turned])


@pytest.mark.parametrize("sensors", [EXACT, {}], ids=["exact", "noisy"])
@pytest.mark.parametrize("sea", ["still", "south_china_sea", "two_layer", "east_china_sea"])
@pytest.mark.parametrize(
    ("depth", "pitch", "speed"),
    [(30.0, 20.0, 0.25), (50.0, 35.0, 0.4), (50.0, 50.0, 0.5), (80.0, 35.0, 0.35), (150.0, 45.0, 0.4)],
)
def test_no_dive_is_deeper_than_asked(sea: str, depth: float, pitch: float, speed: float, sensors: Document) -> None:
    """Steep dives turn late, and at 50 m two layers and a shelf sea are densest just where they turn."""
    deepest = deepest_of_dives({"name": sea}, depth, pitch, speed, sensors)
    assert deepest.max() < depth
    assert deepest.min() > 0.9 * depth


@pytest.mark.parametrize(
    ("key", "value"), [("drives.pitch.gearbox_ratio", 2.0), ("engine.inflate.motor_speed_rpm", 3500.0)]
)
def test_a_drive_half_as_fast_is_allowed_for(key: str, value: float) -> None:
    found = flown(
        changes={key: value}, sensors=EXACT, ocean={"name": "still"}, duration_days=0.1, output_every_s=1.0
    )  # fmt: skip
    assert 93.0 < column(found, "depth").max() < 100.0
