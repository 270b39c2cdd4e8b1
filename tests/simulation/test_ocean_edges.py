"""A mission that comes to the edge of the ocean's data, or to land."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from stommel.simulation.flight import Flown, fly_mission
from stommel.simulation.scenario.loading import mission_from
from tests.ocean.conftest import Writer, sea_file
from tests.simulation.conftest import Document, column, events, mission_document

__all__ = ["sea_file"]


def drifting(sea_file: Writer, folder: Path, place: tuple[float, float], current: tuple[float, float],
             **changes: object) -> Flown:  # fmt: skip
    """A vehicle that would go up the current (east, north), and cannot stem it."""

    def flowing(data: xr.Dataset) -> None:
        for name, speed in zip(("uo", "vo"), current, strict=True):
            data[name] = (data[name].dims, np.where(np.isnan(data["to"]), np.nan, speed), data[name].attrs)

    here = {"latitude_deg": place[0], "longitude_deg": place[1]}
    goal = {"latitude_deg": place[0] - 0.5 * current[1], "longitude_deg": place[1] - 0.5 * current[0]}
    ocean: Document = {"file": sea_file(flowing).name} | dict(changes.pop("ocean", {}))  # type: ignore[call-overload]
    document = mission_document(
        **{
            "start": here,
            "waypoints": [goal],
            "start_time": "2020-03-01T01:00:00Z",
            "duration_days": 0.25,
            "ocean": ocean,
        }
        | changes
    )
    return fly_mission(mission_from(document, "test.toml", folder))


def test_edge_is_held_and_told_once(sea_file: Writer, tmp_path: Path) -> None:
    found = drifting(sea_file, tmp_path, (13.99, 178.5), (0.0, 1.0), ocean={"outside": "hold"})
    assert np.degrees(column(found, "latitude")[-1]) > 14.05
    told = [t for t, _, reason in events(found) if reason == "outside the ocean's data"]
    assert len(told) == 1
    crossed = float(np.interp(14.0, np.degrees(column(found, "latitude")), column(found, "time")))
    assert crossed <= told[0] <= crossed + 600.0  # the ocean is looked at every ten minutes
    assert found.outcome == "time over"
    beyond = column(found, "time") > told[0]
    np.testing.assert_allclose(column(found, "current_north")[beyond], 1.0, rtol=1e-5)


def test_edge_ends_a_mission_that_may_not_pass_it(sea_file: Writer, tmp_path: Path) -> None:
    found = drifting(sea_file, tmp_path, (13.99, 178.5), (0.0, 1.0), ocean={"outside": "error"})
    assert found.outcome == "left the ocean data"
    last = column(found, "time")[-1]
    crossed = np.argmax(np.degrees(column(found, "latitude")) > 14.0)
    assert crossed == 0 or column(found, "time")[crossed] > last - 600.0


def test_edge_in_time_is_held_and_told(sea_file: Writer, tmp_path: Path) -> None:
    found = drifting(sea_file, tmp_path, (13.0, 178.5), (0.0, 0.1), start_time="2020-03-01T10:00:00Z",
                     ocean={"outside_time": "hold"})  # fmt: skip
    told = [t for t, _, reason in events(found) if reason == "outside the ocean's data"]
    assert len(told) == 1
    assert 7200.0 <= told[0] <= 7800.0  # the file ends at noon
    assert found.outcome == "time over"


@pytest.mark.parametrize("outside", ["hold", "error"])
def test_shore_ends_the_mission(sea_file: Writer, tmp_path: Path, outside: str) -> None:
    """Land in the south-west of the file: halfway between its wet and dry nodes, at 178.5 deg."""
    found = drifting(sea_file, tmp_path, (10.5, 178.51), (-0.8, 0.0), ocean={"outside": outside})
    assert found.outcome == "aground"
    longitude = np.degrees(column(found, "longitude"))
    ashore = float(np.interp(-178.5, -longitude, column(found, "time")))
    assert ashore <= column(found, "time")[-1] + 10.0
    assert column(found, "time")[-1] < ashore + 600.0
