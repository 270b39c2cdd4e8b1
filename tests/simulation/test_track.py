"""Tracks for other programs: what RFC 7946 and KML 2.2 ask, and the record's places back from the files."""

import json
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
import pytest
import xarray as xr

from stommel.errors import OutputError
from stommel.simulation.results.dataset import dataset_of
from stommel.simulation.results.date_line import area_pieces, line_pieces
from stommel.simulation.results.track import geojson, kml, write_track
from tests.simulation.conftest import flown
from tests.support.command import Command

KML = {"k": "http://www.opengis.net/kml/2.2"}


@pytest.fixture(scope="module")
def crossing() -> xr.Dataset:
    """Across the date line to a waypoint whose radius lies on both sides of it, and on to another."""
    return dataset_of(
        flown(
            ocean={"name": "uniform", "parameters": {"current_east_m_s": 0.0}},
            start={"latitude_deg": -17.0, "longitude_deg": 179.993},
            waypoints=[
                {"latitude_deg": -17.0, "longitude_deg": -179.9995},
                {"latitude_deg": -16.9, "longitude_deg": -179.9},
            ],
            guidance={"acceptance_radius_m": 300.0},
        )
    )


def features(dataset: xr.Dataset, kind: str) -> list[dict[str, Any]]:
    collection = json.loads(geojson(dataset))
    assert collection["type"] == "FeatureCollection"
    return [one for one in collection["features"] if one["properties"]["kind"] == kind]


def test_track_holds_every_row_in_order(crossing: xr.Dataset) -> None:
    (track,) = features(crossing, "track")
    assert track["geometry"]["type"] == "MultiLineString"
    west, east = track["geometry"]["coordinates"]
    assert (west[-1][0], east[0][0]) == (180.0, -180.0)
    assert west[-1][1] == east[0][1]
    places = np.array(west[:-1] + east[1:])
    assert places[:, 0] == pytest.approx((crossing["longitude"].values + 180.0) % 360.0 - 180.0, abs=1e-7)
    assert places[:, 1] == pytest.approx(crossing["latitude"].values, abs=1e-7)
    assert track["properties"]["verdict"] == crossing.attrs["verdict"]
    assert track["properties"]["start_utc"] == "2026-07-01T00:00:00Z"


def test_waypoints_and_surfacings_stand_at_their_places(crossing: xr.Dataset) -> None:
    first, second = features(crossing, "waypoint")
    assert first["geometry"] == {"type": "Point", "coordinates": [-179.9995, -17.0]}
    after = float(crossing["waypoint_reached_after"][0])
    moment = np.datetime64("2026-07-01T00:00:00") + np.timedelta64(round(after), "s")
    assert first["properties"]["reached_utc"] == f"{moment}Z"
    assert second["properties"]["reached_utc"] is None
    found = [one["geometry"]["coordinates"] for one in features(crossing, "surfacing")]
    assert np.array(found)[:, 1] == pytest.approx(crossing["surfacing_latitude"].values, abs=1e-7)
    for way in ("north", "east"):
        currents = [one["properties"][f"current_{way}_m_s"] for one in features(crossing, "surfacing")]
        assert currents == pytest.approx(crossing[f"depth_averaged_current_{way}"].values, abs=1e-4)
        assert max(map(abs, currents)) > 1e-3
    legs = features(crossing, "planned legs")[0]["geometry"]["coordinates"]
    assert [leg[0] for leg in legs] == [[179.993, -17.0], [-180.0, -17.0]]
    assert legs[1][1:] == [[-179.9995, -17.0], [-179.9, -16.9]]


def test_outlines_are_closed_and_against_the_clock(crossing: xr.Dataset) -> None:
    cut, whole = (one["geometry"] for one in features(crossing, "acceptance radius"))
    assert (cut["type"], whole["type"]) == ("MultiPolygon", "Polygon")
    rings = [polygon[0] for polygon in cut["coordinates"]] + whole["coordinates"]
    areas = []
    for ring in rings:
        assert ring[0] == ring[-1]
        x, y = np.array(ring).T
        assert np.ptp(x) < 0.01  # on one side of the date line
        areas.append(0.5 * float(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1])))
    assert min(areas) > 0.0  # against the clock
    circle = np.pi * 300.0**2 / (106.4526e3 * 110.6633e3)  # degrees at 17 S, WGS 84
    assert areas[0] + areas[1] == pytest.approx(circle, rel=5e-3)
    assert areas[2] == pytest.approx(circle, rel=5e-3)


def test_lines_are_cut_where_they_cross() -> None:
    assert line_pieces(np.array([179.0, -179.0]), np.array([0.0, 2.0])) == [
        [(179.0, 0.0), (180.0, 1.0)], [(-180.0, 1.0), (-179.0, 2.0)],
    ]  # fmt: skip
    assert line_pieces(np.array([-179.0, 179.0, 178.0]), np.array([0.0, 4.0, 4.0])) == [
        [(-179.0, 0.0), (-180.0, 2.0)], [(180.0, 2.0), (179.0, 4.0), (178.0, 4.0)],
    ]  # fmt: skip
    assert line_pieces(np.array([200.0, 201.0]), np.array([0.0, 0.0])) == [[(-160.0, 0.0), (-159.0, 0.0)]]


def test_a_square_on_the_date_line_is_cut_in_halves() -> None:
    square = [(179.0, 0.0), (-179.0, 0.0), (-179.0, 1.0), (179.0, 1.0), (179.0, 0.0)]
    inner, outer = area_pieces(square, 179.5)
    assert set(inner) == {(179.0, 0.0), (180.0, 0.0), (180.0, 1.0), (179.0, 1.0)}
    assert set(outer) == {(-180.0, 0.0), (-179.0, 0.0), (-179.0, 1.0), (-180.0, 1.0)}


def test_kml_holds_the_same_places(crossing: xr.Dataset) -> None:
    root = ET.fromstring(kml(crossing))
    names = [one.text for one in root.findall(".//k:Folder/k:name", KML)]
    assert names == ["track", "planned legs", "waypoint", "acceptance radius", "surfacing"]
    lines = root.findall(".//k:Folder[k:name='track']//k:LineString/k:coordinates", KML)
    written = [[float(x) for x in place.split(",")] for line in lines for place in str(line.text).split()]
    (track,) = features(crossing, "track")
    assert written == [place for piece in track["geometry"]["coordinates"] for place in piece]
    when = [one.text for one in root.findall(".//k:TimeStamp/k:when", KML)]
    assert when == [one["properties"]["time_utc"] for one in features(crossing, "surfacing")]
    assert root.find("k:Document/k:description", KML).text == crossing.attrs["verdict"]  # type: ignore[union-attr]


def test_long_tracks_are_thinned_and_keep_both_ends(crossing: xr.Dataset) -> None:
    long = xr.concat([crossing.isel(time=slice(0, 1000))] * 12, dim="time", data_vars="minimal", coords="minimal",
                     compat="override", join="override")  # fmt: skip
    places = [p for piece in features(long, "track")[0]["geometry"]["coordinates"] for p in piece]
    assert len(places) <= 5200
    assert places[-1][1] == pytest.approx(float(long["latitude"][-1]), abs=1e-7)


def test_command_writes_both(stommel: Command, tmp_path: Path) -> None:
    for name in ("pool.geojson", "pool.kml"):
        done = stommel("simulate", "pool_trial", "--track", name, "--json")
        assert done.json["written"] == [name]
        assert (tmp_path / name).stat().st_size > 1000
    assert json.loads((tmp_path / "pool.geojson").read_text())["name"] == "Pool trial"
    refused = stommel("simulate", "pool_trial", "--track", "pool.gpx")
    assert refused.status == 2
    assert "--track pool.gpx" in refused.err
    assert ".geojson" in refused.err


def test_other_endings_are_refused(crossing: xr.Dataset, tmp_path: Path) -> None:
    with pytest.raises(OutputError, match=r"\.geojson"):
        write_track(crossing, tmp_path / "track.shp")
