"""Outside the data: the second ocean behind the first, reached over a stated distance and time; never silent zeros."""

from pathlib import Path
from typing import Any

import gsw
import numpy as np
import pytest
import xarray as xr

from stommel.errors import StommelError
from stommel.geometry import geodesics as geodesy
from stommel.ocean import LandError, Ocean, OutsideOceanError
from stommel.ocean.reading.netcdf import YEAR
from tests.ocean.conftest import Writer, regular_sea

START = 1583020800.0
"""First time of the regular sea."""
EDGE = (13.0, -178.0)
"""A node on its eastern edge; between nodes the edge is straight in the plane, not a meridian."""
BEHIND = {"temperature_c": 4.0, "salinity_psu": 33.0, "current_east_m_s": 0.7, "current_north_m_s": 0.3}


def east_of_the_edge(distance: float) -> geodesy.Place:
    return geodesy.travel(*EDGE, 90.0, distance)


def monthly(path: Path, *, months: bool = False, currents: bool = True) -> Path:
    """Write a climatology of twelve months around the regular sea, as CF and as the atlases have it."""
    lat, lon = np.array([0.0, 10.0, 20.0, 30.0]), np.array([165.0, 175.0, 185.0, 195.0])
    month = np.arange(12)
    full = np.ones((12, 2, 4, 4))
    season = np.cos(2.0 * np.pi * (month + 0.5) / 12.0)[:, None, None, None]
    dims = ("time", "depth", "lat", "lon")
    data = {
        "t": (dims, 20.0 - 5.0 * season * full, {"standard_name": "sea_water_temperature", "units": "degree_Celsius"}),
        "s": (dims, 35.0 * full, {"standard_name": "sea_water_practical_salinity", "units": "1"}),
    }
    if currents:
        data["u"] = (dims, 0.2 * full, {"standard_name": "eastward_sea_water_velocity", "units": "m s-1"})
        data["v"] = (dims, 0.0 * full, {"standard_name": "northward_sea_water_velocity", "units": "m s-1"})
    middle = [np.datetime64(f"1955-{n + 1:02d}") for n in month]
    days = [(np.datetime64(m, "D") - np.datetime64("1955-01-01")).astype(int) + 15.0 for m in middle]
    time = {"standard_name": "time", "climatology": "climatology_bounds"}
    units = {"units": "months since 1955-01-01" if months else "days since 1955-01-01"}
    coordinates = {
        "time": ("time", month + 0.5 if months else days, time | units),
        "depth": ("depth", [0.0, 300.0], {"standard_name": "depth", "units": "m", "positive": "down"}),
        "lat": ("lat", lat, {"standard_name": "latitude", "units": "degrees_north"}),
        "lon": ("lon", lon, {"standard_name": "longitude", "units": "degrees_east"}),
    }
    xr.Dataset(data, coordinates).to_netcdf(path)
    return path


def test_the_edge_gives_way_to_the_second_ocean_in_space(sea_file: Writer) -> None:
    """Linear in the distance from the edge, by pyproj; continuous at both ends, and flagged."""
    path, behind = sea_file(), Ocean.analytic("uniform", **BEHIND)
    ocean = Ocean.open(path, outside="climatology", climatology=behind, blend_km=80.0)
    edge, far = ocean.at(START, *EDGE, 20.0), behind.at(START, *EDGE, 20.0)
    assert not edge.held
    for distance, share in ((1.0, 0.0), (20e3, 0.25), (40e3, 0.5), (79e3, 0.9875), (81e3, 1.0), (500e3, 1.0)):
        sample = ocean.at(START, *east_of_the_edge(distance), 20.0)
        assert sample.held
        for name in ("current_east", "current_north", "conservative_temperature", "absolute_salinity", "density"):
            a, b = getattr(edge, name), getattr(far, name)
            # salinity anomaly, latitude of the geodesic and the scale of the plane leave a few parts in ten thousand
            assert getattr(sample, name) == pytest.approx(a + share * (b - a), abs=2e-3 * abs(b - a)), (distance, name)
    assert far.bottom_depth == np.inf
    assert ocean.at(START, *east_of_the_edge(1e6)).bottom_depth == np.inf


@pytest.mark.parametrize("hours", [-30.0, -12.0, -3.0, 15.0, 24.0, 60.0])
def test_the_last_time_gives_way_to_the_second_ocean(sea_file: Writer, hours: float) -> None:
    behind = Ocean.analytic("uniform", **BEHIND)
    ocean = Ocean.open(sea_file(), outside_time="climatology", climatology=behind, blend_hours=24.0)
    beyond = max(-hours, hours - 12.0)
    edge = ocean.at(START + 3600.0 * min(max(hours, 0.0), 12.0), 12.5, 179.5, 30.0)
    sample = ocean.at(START + 3600.0 * hours, 12.5, 179.5, 30.0)
    share = min(beyond / 24.0, 1.0)
    assert sample.held
    assert not edge.held
    assert sample.current_east == pytest.approx(edge.current_east + share * (0.7 - edge.current_east), abs=1e-6)
    # where the place is in the data, its bottom and its land are those of the data
    assert sample.bottom_depth == pytest.approx(edge.bottom_depth)
    with pytest.raises(LandError):
        ocean.at(START + 3600.0 * hours, 10.0, 177.0)
    with pytest.raises(OutsideOceanError):
        ocean.at(START, *east_of_the_edge(1e3))


def test_at_once_without_a_distance(sea_file: Writer) -> None:
    behind = Ocean.analytic("uniform", **BEHIND)
    ocean = Ocean.open(sea_file(), outside="climatology", climatology=behind, blend_km=0.0, blend_hours=0.0)
    assert ocean.at(START, *east_of_the_edge(500.0)).current_east == pytest.approx(0.7)
    assert ocean.at(START - 1.0, 12.5, 179.5).current_east == pytest.approx(0.7)
    assert ocean.at(START, *EDGE).current_east == pytest.approx(0.1)


def test_the_mean_of_the_data_without_a_second_ocean(sea_file: Writer) -> None:
    """Oracle: NumPy's mean over the wet nodes and times of the numbers that were written; no currents turned."""
    ocean, data = Ocean.open(sea_file(), outside="climatology"), regular_sea()
    sample = ocean.at(START, *east_of_the_edge(2e6), 50.0)
    assert sample.held
    assert sample.current_east == pytest.approx(float(data.uo.isel(depth=1).mean()), abs=1e-6)
    assert sample.current_north == pytest.approx(float(data.vo.isel(depth=1).mean()), abs=1e-6)
    later = ocean.at(START + 1e7, 12.5, 179.5, 50.0)
    assert later.current_east == pytest.approx(float(data.uo.isel(depth=1).mean("time").max()), abs=1e-6)


@pytest.mark.parametrize("months", [False, True])
def test_a_file_of_twelve_months_repeats_every_year(sea_file: Writer, tmp_path: Path, months: bool) -> None:
    """A CF climatology and one with months as its unit; December and January join. Oracle: gsw of the cosine."""
    monthly(tmp_path / "months.nc", months=months)
    ocean = Ocean.open(sea_file(), outside="climatology", climatology=tmp_path / "months.nc")
    place = east_of_the_edge(400e3)
    for year in (1999, 2020, 2031):
        for month, expected in ((1, 15.0), (7, 25.0)):
            time = f"{year}-{month:02d}-16T00:00:00"
            sample = ocean.at(time, *place, 0.0)
            season = 20.0 + (expected - 20.0) * np.cos(np.pi / 12.0)
            assert sample.temperature == pytest.approx(season, abs=0.1)
            assert sample.current_east == pytest.approx(0.2, abs=1e-4)  # nodes 10 deg apart
    new_year = [ocean.at(f"{date}T00:00:00", *place).temperature for date in ("2020-12-31", "2021-01-01")]
    assert abs(new_year[1] - new_year[0]) < 0.02
    S_A = float(gsw.SA_from_SP(35.0, 0.0, place.longitude_deg, place.latitude_deg))
    assert ocean.at(START, *place).absolute_salinity == pytest.approx(S_A, abs=2e-3)
    assert ocean.notes["climatology, times"] == "the same every year"


def test_a_yearly_ocean_stands_alone(tmp_path: Path) -> None:
    ocean = Ocean.open(monthly(tmp_path / "months.nc"))
    first, again = (ocean.at(t, 15.0, 180.0, 10.0).temperature for t in (1e9, 1e9 + 5 * YEAR))
    assert first == pytest.approx(again, abs=1e-9)
    assert ocean.summary()["times"] == 12
    with pytest.raises(OutsideOceanError):
        ocean.at(1e9, 60.0, 180.0)
    once = Ocean.open(tmp_path / "months.nc", yearly=False)
    with pytest.raises(OutsideOceanError, match="1955-01-16"):
        once.at(1e9, 15.0, 180.0, 10.0)


def test_a_climatology_without_currents_is_at_rest_only_when_told(tmp_path: Path) -> None:
    path = monthly(tmp_path / "atlas.nc", currents=False)
    with pytest.raises(StommelError, match="no variable for current_x"):
        Ocean.open(path)
    ocean = Ocean.open(path, at_rest=True)
    assert ocean.notes["currents"] == "at rest, as asked"
    assert ocean.at(0.0, 15.0, 180.0).current_east == 0.0


def test_outside_both_it_is_refused(sea_file: Writer, tmp_path: Path) -> None:
    monthly(tmp_path / "months.nc")
    ocean = Ocean.open(sea_file(), outside="climatology", climatology=tmp_path / "months.nc")
    with pytest.raises(OutsideOceanError, match="and outside its climatology, which has latitude"):
        ocean.at(START, 60.0, 179.0)


def test_land_of_the_climatology_is_land(sea_file: Writer, tmp_path: Path) -> None:
    path = monthly(tmp_path / "months.nc")
    with xr.load_dataset(path) as data:
        data["t"] = data.t.where(data.lon < 190.0)
        data.to_netcdf(tmp_path / "island.nc")
    ocean = Ocean.open(sea_file(), outside="climatology", climatology=tmp_path / "island.nc")
    with pytest.raises(LandError):
        ocean.at(START, 12.0, -166.0)
    assert not ocean.is_land(12.0, -176.5)


def test_off_a_coast_at_the_edge_the_second_ocean_stands_alone(sea_file: Writer) -> None:
    """South-west of the file's corner of land there is nothing to blend with; off its wet edge there is."""
    behind = Ocean.analytic("uniform", **BEHIND)
    ocean = Ocean.open(sea_file(), outside="climatology", climatology=behind, blend_km=80.0)
    for place in (geodesy.travel(10.0, 177.0, 270.0, 5e3), geodesy.travel(10.2, 177.0, 270.0, 1e3)):
        sample = ocean.at(START, *place, 20.0)
        assert sample.held
        assert sample.current_east == pytest.approx(0.7, abs=1e-6)
        assert sample.temperature == pytest.approx(4.0, abs=5e-3)
    wet = ocean.at(START, *geodesy.travel(13.0, 177.0, 270.0, 5e3), 20.0)
    assert wet.current_east == pytest.approx(0.096 + 5.0 / 80.0 * (0.7 - 0.096), abs=2e-3)


def test_beside_land_within_the_data_nothing_of_the_second_ocean_is_seen(sea_file: Writer) -> None:
    """Where the nodes with water have more than half of the weight, they alone count."""
    path, behind = sea_file(), Ocean.analytic("uniform", **BEHIND)
    blended = Ocean.open(path, outside="climatology", climatology=behind, blend_km=80.0)
    alone = Ocean.open(path)
    for place in ((11.6, 177.3), (11.9, 177.5), (10.4, 178.6)):
        a, b = (ocean.at(START, *place, 20.0) for ocean in (blended, alone))
        assert not a.held
        assert (a.current_east, a.temperature, a.bottom_depth) == (b.current_east, b.temperature, b.bottom_depth)


def test_analytic_oceans_take_a_climatology_too() -> None:
    ocean = Ocean.analytic("gyre").with_outside("climatology", climatology="two_layer")
    assert ocean.at(0.0, 35.0, 125.0, 100.0).temperature == pytest.approx(10.0, abs=0.05)
    assert Ocean.analytic("gyre").with_outside("hold").at(0.0, 35.0, 125.0).held


def test_density_of_both_oceans_is_within_the_table(sea_file: Writer) -> None:
    behind = Ocean.analytic("uniform", temperature_c=1.0, salinity_psu=8.0)
    ocean = Ocean.open(sea_file(), outside="climatology", climatology=behind)
    sample = ocean.at(START, *east_of_the_edge(300e3), 100.0)
    rho = gsw.rho(sample.absolute_salinity, sample.conservative_temperature, sample.pressure / 1e4)
    assert sample.density == pytest.approx(float(rho), abs=1e-4)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"climatology": "two_layer"}, ["climatology", 'outside_time = "climatology"']),
        (
            {"outside": "climatology", "climatology": "atlantis"},
            ["ocean 'atlantis' is neither an analytic ocean nor a file"],
        ),
        ({"outside": "climatology", "blend_km": -1.0}, ["blend_km = -1"]),
        ({"outside": "climatology", "blend_hours": float("nan")}, ["blend_hours = nan"]),
        ({"outside_time": "zero"}, ["outside_time = 'zero'", "error, hold, climatology"]),
    ],
)
def test_what_does_not_fit_is_refused(sea_file: Writer, options: dict[str, Any], words: list[str]) -> None:
    with pytest.raises(StommelError) as refused:
        Ocean.open(sea_file(), **options)
    for word in words:
        assert word in str(refused.value)


def test_a_climatology_of_a_climatology_is_refused(sea_file: Writer) -> None:
    path = sea_file()
    with pytest.raises(StommelError, match="climatology of its own"):
        Ocean.open(path, outside="climatology", climatology=Ocean.open(path, outside="climatology"))
