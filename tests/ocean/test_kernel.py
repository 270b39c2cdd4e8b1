"""The compiled column: no allocation, the water between its depths, the plane's conformal map."""

from math import radians

import numpy as np
import pytest
from numba.core.runtime import _nrt_python, rtsys
from pyproj import CRS, Geod, Transformer

from stommel.compilation import compiled
from stommel.geometry import geodesics as geodesy
from stommel.ocean import Ocean
from stommel.ocean.kernel.chart import chart_at, project
from stommel.ocean.kernel.column import fill_column, water_at
from stommel.ocean.kernel.grid import HELD, OK, RHO, P, new_cell, new_column
from stommel.ocean.kernel.unproject import unproject
from stommel.ocean.times import seconds


@compiled
def water_of(column, z, age):
    return water_at(column, z, age)


@compiled
def fill_many(grid, table, latitude, longitude, cell, column, count):
    status = 0
    for n in range(count):
        status = max(status, fill_column(grid, table, 60.0 * n, latitude + 1e-6 * n, longitude, cell, column))
    return status


@compiled
def plane_of(chart, latitude, longitude):
    return project(chart, latitude, longitude)


def test_filling_allocates_nothing() -> None:
    ocean = Ocean.analytic("east_china_sea")
    grid, column, cell = ocean.grid(), new_column(ocean.grid(), 200.0), new_cell()
    arguments = (grid, ocean.table, radians(28.0), radians(126.6), cell, column)
    assert fill_many(*arguments, 1) == OK
    counts = []
    _nrt_python.memsys_enable_stats()
    try:
        for times in (1, 1000):
            before = rtsys.get_allocation_stats().alloc
            assert fill_many(*arguments, times) == OK
            counts.append(rtsys.get_allocation_stats().alloc - before)
    finally:
        _nrt_python.memsys_disable_stats()
    assert counts[0] == counts[1]


def test_water_between_the_depths_of_a_column() -> None:
    """At the depths the column's values; between them linear; above the surface no pressure; below, P goes on."""
    ocean = Ocean.analytic("two_layer")
    column = new_column(ocean.grid(), 100.0, 2.0)
    assert fill_column(ocean.grid(), ocean.table, 0.0, 0.5, 2.0, new_cell(), column) == OK
    values = column.values
    assert water_of(column, 40.0, 0.0).rho == values[20, RHO]
    assert water_of(column, 41.0, 0.0).rho == pytest.approx(0.5 * (values[20, RHO] + values[21, RHO]), rel=1e-14)
    surface = water_of(column, -1.0, 0.0)
    assert (surface.rho, surface.P) == (values[0, RHO], 0.0)
    below = water_of(column, 110.0, 0.0)
    assert below.rho == values[-1, RHO]
    assert pytest.approx(values[-1, P] + 10.0 * 9.79 * below.rho, rel=1e-3) == below.P


def test_age_carries_the_tide_on() -> None:
    ocean = Ocean.analytic("tide")
    column = new_column(ocean.grid(), 10.0)
    fill_column(ocean.grid(), ocean.table, 1000.0, 0.5, 2.0, new_cell(), column)
    later = ocean.at(1060.0, 30.0, 125.0, 5.0)
    north, east, _ = water_of(column, 5.0, 60.0).U
    # what is left is the tide's second derivative: U (omega dt)^2 / 2 = 0.3 x 3.6e-5
    assert (north, east) == pytest.approx((later.current_north, later.current_east), abs=1.1e-5)


@pytest.mark.parametrize("centre", [(30.0, 125.0), (-75.0, 179.9), (89.99, 0.0), (0.0, -60.0)])
def test_plane_is_the_oblique_stereographic_of_pyproj(centre: tuple[float, float]) -> None:
    """Oracle: PROJ's ellipsoidal `stere`, the same but for its scale at the centre; and the way back."""
    crs = CRS.from_proj4(f"+proj=stere +lat_0={centre[0]} +lon_0={centre[1]} +k=1 +ellps=WGS84")
    proj = Transformer.from_crs(crs.geodetic_crs, crs, always_xy=True)
    chart = chart_at(radians(centre[0]), radians(centre[1]))
    ratios = []
    for bearing in (1.0, 77.0, 200.0):
        longitude, latitude, _ = Geod(ellps="WGS84").fwd(centre[1], centre[0], bearing, 3e5)
        point = plane_of(chart, radians(latitude), radians(longitude))
        x, y = proj.transform(longitude, latitude)
        ratios.append(np.hypot(x, y) / np.hypot(point.x, point.y))
        assert np.arctan2(point.y, point.x) == pytest.approx(np.arctan2(y, x), abs=1e-9)
        factor = np.hypot(point.north_x, point.north_y)
        assert factor == pytest.approx(1.0, abs=1e-12)
        back = unproject(chart, np.array([point.x]), np.array([point.y]))
        assert np.degrees(back[0][0]) == pytest.approx(latitude, abs=1e-10)
        turn = np.exp(1j * (back[1][0] - radians(longitude)))
        assert abs(np.angle(turn)) < 1e-11 / np.cos(radians(latitude)) + 1e-11
    assert np.ptp(ratios) < 1e-9


@pytest.mark.parametrize("latitude", [-80.0, 0.0, 45.0, 89.9])
def test_north_and_scale_of_the_plane_are_its_derivatives(latitude: float) -> None:
    """Oracle: central differences along the meridian and the parallel, of lengths by pyproj."""
    chart, geod = chart_at(radians(50.0), radians(20.0)), Geod(ellps="WGS84")
    here = plane_of(chart, radians(latitude), radians(33.0))
    for bearing, expected in ((0.0, (here.north_x, here.north_y)), (90.0, (here.north_y, -here.north_x))):
        ends = []
        for side in (0.0, 180.0):
            longitude, place, _ = geod.fwd(33.0, latitude, bearing + side, 10.0)
            ends.append(plane_of(chart, radians(place), radians(longitude)))
        x, y = ends[0].x - ends[1].x, ends[0].y - ends[1].y
        assert np.hypot(x, y) / 20.0 == pytest.approx(here.scale, rel=1e-6)
        assert (x / 20.0 / here.scale, y / 20.0 / here.scale) == pytest.approx(expected, abs=1e-5)


def test_a_vehicle_that_crosses_the_pole_sees_one_current(tmp_path) -> None:
    """A current that is uniform in the plane at the pole stays so across it, in space, not in its components."""
    from stommel.ocean.kernel.building import Frame, Slot, ocean_grid
    from stommel.seawater.table import density_table

    x, y = np.meshgrid(np.linspace(-3e5, 3e5, 7), np.linspace(-3e5, 3e5, 7))
    chart = chart_at(np.pi / 2, 0.0)
    latitude, longitude = unproject(chart, x, y)
    # along the meridian 0 of the plane: the current comes from 180 deg, so that its bearing is the longitude's
    east, north = -np.sin(longitude), -np.cos(longitude)
    full = np.ones((2, 7, 7))
    frame = Frame(np.zeros(1), (-np.inf, np.inf), np.array([0.0, 100.0]), latitude, longitude, 1e3 * full[0])
    slot = Slot(2.0 * full, 35.0 * full, 2.0 * full, 0.2 * east * full, 0.2 * north * full)
    grid = ocean_grid(frame, [slot])
    table = density_table((34.0, 36.0), (1.0, 3.0), (0.0, 200.0))
    ocean = Ocean("pole", grid)
    assert table.largest_error < 1e-5
    for place in ((89.5, 0.0), (89.99, 10.0), (89.9999, 100.0), (89.99, 190.0), (88.0, -60.0)):
        sample = ocean.at(0.0, *place, 10.0)
        l = radians(place[1])
        assert (sample.current_east, sample.current_north) == pytest.approx(
            (-0.2 * np.sin(l), -0.2 * np.cos(l)), abs=3e-5
        )


def test_statuses_leave_the_column_alone() -> None:
    ocean = Ocean.analytic("east_china_sea")
    column = new_column(ocean.grid(), 20.0)
    column.values[:] = 7.0
    assert fill_column(ocean.grid(), ocean.table, 0.0, 0.0, 0.0, new_cell(), column) > HELD
    assert np.all(column.values == 7.0)


def test_geodesics() -> None:
    """Oracle: Vincenty's line of Flinders Peak to Buninyong, 54 972.271 m on GRS 80 (WGS 84 within 0.1 mm)."""
    leg = geodesy.leg(-37.95103341666667, 144.42486788888888, -37.65282113888889, 143.92649552777778)
    assert leg.distance_m == pytest.approx(54972.271, abs=1e-3)
    assert leg.bearing_deg == pytest.approx(306.0 + 52.0 / 60.0 + 5.37 / 3600.0, abs=1e-5)
    place = geodesy.travel(-37.95103341666667, 144.42486788888888, leg.bearing_deg, leg.distance_m)
    assert tuple(place) == pytest.approx((-37.65282113888889, 143.92649552777778), abs=1e-10)


def test_times() -> None:
    from datetime import UTC, datetime

    expected = 1454328000.0
    texts = ("2016-02-01T12:00:00", "2016-02-01T12:00:00Z", "2016-02-01T14:00:00+02:00")
    dates = (datetime(2016, 2, 1, 12, tzinfo=UTC), datetime(2016, 2, 1, 12), np.datetime64("2016-02-01T12:00:00"))
    for time in (*texts, expected, *dates):
        assert seconds(time) == expected
