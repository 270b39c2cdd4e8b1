"""Oracles: the file's own packed numbers, pyproj's convergence of the meridians, gsw. arctic20.nc of MET Norway."""

from math import degrees, radians
from pathlib import Path

import gsw
import numpy as np
import pytest
import xarray as xr
from pyproj import Proj

from stommel.ocean import LandError, Ocean, OutsideOceanError
from stommel.ocean.errors import BelowBottomError
from stommel.ocean.kernel.column import fill_column
from stommel.ocean.kernel.grid import CT_ROW, EAST, NORTH, OK, SALINITY, TEMPERATURE, new_cell, new_column

FIRST_DAY = 1454328000.0


@pytest.fixture(scope="module")
def ocean(arctic20: Path) -> Ocean:
    return Ocean.open(arctic20)


@pytest.fixture(scope="module")
def raw(arctic20: Path) -> xr.Dataset:
    with xr.open_dataset(arctic20, decode_cf=False) as data:
        return data.load()


def unpacked(raw: xr.Dataset, name: str) -> np.ndarray:
    packed, attributes = raw[name].values, raw[name].attrs
    values = packed.astype(float) * float(attributes["scale_factor"]) + float(attributes["add_offset"])
    return np.where(packed == attributes["_FillValue"], np.nan, values)


def columns_at_nodes(ocean: Ocean, raw: xr.Dataset, time: float) -> tuple[np.ndarray, np.ndarray]:
    """Values at the grid's levels of a column filled at each wet node, and which nodes are wet."""
    grid, cell = ocean.grid(), new_cell()
    column = new_column(grid, 10.0, 10.0)
    latitude, longitude = np.radians(raw.latitude.values.astype(float)), np.radians(raw.longitude.values.astype(float))
    out = np.full((*grid.x.shape, *column.levels.shape), np.nan)
    for j, i in np.argwhere(grid.levels > 0):
        assert fill_column(grid, ocean.table, time, latitude[j, i], longitude[j, i], cell, column) == OK
        out[j, i] = column.levels
    return out, grid.levels


def test_values_at_all_nodes_are_the_files(ocean: Ocean, raw: xr.Dataset) -> None:
    """Exact to packing: the error stays below a hundredth of the least step of each packed variable.

    The current is turned by the convergence that pyproj gives; 1e-6 relative.
    """
    n = 2
    found, levels = columns_at_nodes(ocean, raw, float(raw.time.values[n]))
    theta, S_P, u, v = (np.moveaxis(unpacked(raw, name)[n], 0, -1) for name in ("temperature", "salinity", "u", "v"))
    wet = np.arange(17) < levels[..., None]
    assert wet.sum() > 40000
    assert np.array_equal(wet, np.isfinite(theta) & np.isfinite(u) & np.isfinite(v))
    latitude, longitude = raw.latitude.values.astype(float), raw.longitude.values.astype(float)
    p = gsw.p_from_z(-raw.depth.values.astype(float), latitude[..., None])
    S_A = gsw.SA_from_SP(S_P, p, longitude[..., None], latitude[..., None])
    CT = gsw.CT_from_pt(S_A, theta)
    expected = {
        TEMPERATURE: (gsw.t_from_CT(S_A, CT, p), raw.temperature),
        CT_ROW: (CT, raw.temperature),
        SALINITY: (S_A, raw.salinity),
    }
    for row, (values, variable) in expected.items():
        error = np.abs(found[..., row] - values)[wet].max()
        assert error < 0.01 * float(variable.attrs["scale_factor"])

    gamma = np.radians(
        Proj(raw.polar_stereographic.attrs["proj4_string"]).get_factors(longitude, latitude).meridian_convergence
    )
    cosine, sine = np.cos(gamma)[..., None], np.sin(gamma)[..., None]
    east, north = u * cosine + v * sine, v * cosine - u * sine
    speed = np.hypot(u, v)
    error = np.hypot(found[..., EAST] - east, found[..., NORTH] - north)
    moving = wet & (speed > 0.01)
    assert (error[moving] / speed[moving]).max() < 1e-6


def test_rotation_is_that_of_a_polar_stereographic_map(ocean: Ocean, raw: xr.Dataset) -> None:
    """Closed form: the meridians converge by the longitude from the map's central one, 58 deg east."""
    n, k, j, i = 0, 0, 20, 40
    u, v = unpacked(raw, "u")[n, k, j, i], unpacked(raw, "v")[n, k, j, i]
    angle = -(radians(float(raw.longitude.values[j, i])) - radians(58.0))
    found = ocean.at(float(raw.time.values[n]), float(raw.latitude.values[j, i]), float(raw.longitude.values[j, i]))
    east, north = u * np.cos(angle) - v * np.sin(angle), u * np.sin(angle) + v * np.cos(angle)
    assert np.hypot(found.current_east - east, found.current_north - north) < 1e-6 * np.hypot(u, v)


def test_between_times_is_linear(ocean: Ocean) -> None:
    place = (72.0, 10.0, 30.0)
    first, second = (ocean.at(FIRST_DAY + d * 86400.0, *place) for d in (0.0, 1.0))
    between = ocean.at(FIRST_DAY + 0.25 * 86400.0, *place)
    for name in ("conservative_temperature", "absolute_salinity", "current_east", "current_north"):
        a, b = getattr(first, name), getattr(second, name)
        assert getattr(between, name) == pytest.approx(a + 0.25 * (b - a), rel=1e-9, abs=1e-9)


def test_edges_in_time(arctic20: Path, ocean: Ocean) -> None:
    place, last = (72.0, 10.0), FIRST_DAY + 4 * 86400.0
    ocean.at(FIRST_DAY, *place)
    ocean.at(last, *place)
    for outside in (FIRST_DAY - 1.0, last + 1.0):
        with pytest.raises(OutsideOceanError, match="2016-02-01T12:00:00Z to 2016-02-05T12:00:00Z"):
            ocean.at(outside, *place)
    held = Ocean.open(arctic20, outside_time="hold")
    sample = held.at(last + 1e6, *place)
    assert sample.held
    assert sample.current_east == ocean.at(last, *place).current_east
    mean = Ocean.open(arctic20, outside_time="climatology").at(0.0, *place)
    daily = [ocean.at(FIRST_DAY + d * 86400.0, *place).current_north for d in range(5)]
    assert mean.current_north == pytest.approx(np.mean(daily), rel=1e-5)


def test_land_and_bottom(ocean: Ocean, raw: xr.Dataset) -> None:
    day = float(raw.time.values[0])
    land = np.argwhere(ocean.grid().levels == 0)
    assert np.array_equal(ocean.grid().levels == 0, np.isnan(unpacked(raw, "temperature")[:, 0]).all(axis=0))
    for j, i in land[::40]:
        with pytest.raises(LandError, match="is on land"):
            ocean.at(day, float(raw.latitude.values[j, i]), float(raw.longitude.values[j, i]))
    assert ocean.is_land(78.5, 17.0)  # Spitsbergen
    assert not ocean.is_land(72.0, 10.0)
    j, i = 20, 40
    place = float(raw.latitude.values[j, i]), float(raw.longitude.values[j, i])
    assert ocean.bottom_depth(*place) == pytest.approx(float(raw.h.values[j, i]), rel=1e-6)
    with pytest.raises(BelowBottomError, match="below the bottom at"):
        ocean.at(day, *place, ocean.bottom_depth(*place) + 1.0)
    deepest = ocean.at(day, *place, ocean.bottom_depth(*place))
    assert 1000.0 < deepest.density < 1060.0


def test_outside_in_space(arctic20: Path, ocean: Ocean) -> None:
    with pytest.raises(OutsideOceanError, match="outside the ocean"):
        ocean.at(FIRST_DAY, 40.0, 10.0)
    far = Ocean.open(arctic20, outside="climatology").at(FIRST_DAY, 40.0, 10.0, 100.0)
    assert far.held
    assert 34.0 < far.absolute_salinity < 36.0
    edge = Ocean.open(arctic20, outside="hold").at(FIRST_DAY, 66.0, -12.0, 100.0)
    assert edge.held


def test_every_cell_is_found_from_any_other(ocean: Ocean) -> None:
    """The walk from a far cell and the full search agree: a place inside each of 300 cells, visited at random."""
    from stommel.ocean.kernel.cells import find_cell, mapped

    grid, cell = ocean.grid(), new_cell()
    random = np.random.default_rng(4)
    for _ in range(300):
        j, i = int(random.integers(50)), int(random.integers(90))
        u, v = random.uniform(0.01, 0.99, 2)
        point = find_cell(grid.x, grid.y, mapped(grid.x, j, i, u, v), mapped(grid.y, j, i, u, v), cell)
        assert (point.j, point.i, point.inside) == (j, i, True)
        assert (point.u, point.v) == pytest.approx((u, v), abs=1e-9)
        assert tuple(cell) == (j, i)


def test_density_of_the_file_is_teos_10(ocean: Ocean) -> None:
    """The bar is 1e-4 kg/m3 over the file's range: every value of the file, at its own pressure."""
    from stommel.ocean.kernel.grid import CT, S_A
    from stommel.seawater.table import densities

    grid = ocean.grid()
    assert ocean.table.largest_error < 1e-5
    wet = grid.levels > 0
    S = grid.nodes.water[:, wet][:, :, S_A].astype(float)
    heat = grid.nodes.water[:, wet][:, :, CT].astype(float)
    p = np.broadcast_to(gsw.p_from_z(-grid.nodes.depths, degrees(1.3)), S.shape)
    out = np.empty(S.size)
    densities(ocean.table, S.ravel(), heat.ravel(), p.ravel().copy(), out)
    assert np.abs(out - gsw.rho(S, heat, p).ravel()).max() < 1e-4


def test_pressure_is_the_weight_of_the_water_above(ocean: Ocean) -> None:
    """Oracle: quadrature of the sample's densities with gsw.grav; and gsw's own pressure within 0.2 %."""
    latitude = 72.0
    depths = np.linspace(0.0, 400.0, 81)
    samples = [ocean.at(FIRST_DAY, latitude, 10.0, float(z)) for z in depths]
    rho = np.array([sample.density for sample in samples])
    weight = rho * gsw.grav(latitude, gsw.p_from_z(-depths, latitude))
    assert samples[-1].pressure == pytest.approx(np.trapezoid(weight, depths), rel=1e-6)
    assert samples[-1].pressure / 1e4 == pytest.approx(float(gsw.p_from_z(-400.0, latitude)), rel=2e-3)
    p = np.array([sample.pressure for sample in samples]) / 1e4
    S = np.array([sample.absolute_salinity for sample in samples])
    heat = np.array([sample.conservative_temperature for sample in samples])
    assert np.abs(rho - gsw.rho(S, heat, p)).max() < 2e-5
