"""Oracle: gsw and the check values of the TEOS-10 manual."""

import gsw
import numpy as np
import pytest

from stommel import seawater
from stommel.seawater.stratification import linear, south_china_sea, two_layer, uniform
from stommel.seawater.table import densities

RANGES = [
    ((0.0, 42.0), (-2.0, 40.0), (0.0, 12000.0)),
    ((20.0, 36.0), (-2.0, 12.0), (0.0, 4100.0)),
    ((33.0, 35.5), (8.0, 29.0), (0.0, 1100.0)),
    ((0.0, 0.0), (20.0, 20.0), (0.0, 13.5)),
]


@pytest.mark.parametrize("ranges", RANGES)
def test_density_table_meets_its_stated_error(ranges) -> None:
    """The bar is 1e-4 kg/m3; the table aims at 1e-5, and states what it measured. Random points, none of the fit's."""
    table = seawater.density_table(*ranges)
    random = np.random.default_rng(7)
    S_A, CT, p = (random.uniform(low, high, 200_000) for low, high in ranges)
    out = np.empty(S_A.size)
    densities(table, S_A, CT, p, out)
    error = np.abs(out - gsw.rho(S_A, CT, p)).max()
    assert table.largest_error < 1e-5
    assert error < 1.05 * table.largest_error + 1e-9
    assert error < 1e-4


@pytest.mark.parametrize("ranges", RANGES)
def test_sound_speed_and_freezing_meet_their_stated_errors(ranges) -> None:
    """Stated: 1e-3 m/s and 1e-3 deg C, below what a CTD resolves; at random points, none of the fit's."""
    random = np.random.default_rng(8)
    S_A, CT, p = (random.uniform(low, high, 200_000) for low, high in ranges)
    out = np.empty(S_A.size)
    speed, freezing = seawater.sound_speed_table(*ranges), seawater.freezing_table(ranges[0], ranges[2])
    for table, exact, bar in (
        (speed, gsw.sound_speed(S_A, CT, p), 1e-3),
        (freezing, gsw.t_freezing(S_A, p, 0.0), 1e-3),
    ):
        densities(table, S_A, CT, p, out)
        error = np.abs(out - exact).max()
        assert table.largest_error < bar
        assert error < 1.05 * table.largest_error + 1e-9


def test_freezing_knows_the_air_in_the_water() -> None:
    table = seawater.freezing_table((30.0, 36.0), (0.0, 500.0), saturation=1.0)
    out = np.empty(1)
    densities(table, np.array([35.16504]), np.array([0.0]), np.array([0.0]), out)
    assert out[0] == pytest.approx(-1.9217, abs=2e-3)
    with pytest.raises(seawater.DensityTableError, match="saturation = 2"):
        seawater.freezing_table((30.0, 36.0), (0.0, 500.0), saturation=2.0)


def test_density_table_holds_beyond_its_range() -> None:
    table = seawater.density_table((34.0, 35.0), (10.0, 20.0), (0.0, 100.0))
    out = np.empty(2)
    densities(table, np.array([34.0, 30.0]), np.array([20.0, 25.0]), np.array([100.0, 500.0]), out)
    assert out[0] == out[1]


@pytest.mark.parametrize(
    ("ranges", "tolerance", "words"),
    [
        (((-1.0, 5.0), (0.0, 1.0), (0.0, 1.0)), 1e-5, "S_A from -1"),
        (((1.0, 5.0), (9.0, 1.0), (0.0, 1.0)), 1e-5, "CT from 9"),
        (((1.0, 5.0), (0.0, 1.0), (0.0, 20000.0)), 1e-5, "p from 0 to 20000"),
        (((0.0, 42.0), (-2.0, 40.0), (0.0, 12000.0)), 1e-13, "cannot be reached"),
    ],
)
@pytest.mark.parametrize("make", [seawater.density_table, seawater.sound_speed_table])
def test_impossible_tables_are_refused(make, ranges, tolerance, words) -> None:
    with pytest.raises(seawater.DensityTableError, match=words):
        make(*ranges, tolerance=tolerance)


def test_check_values_of_the_teos_10_toolbox() -> None:
    """Conservative Temperature of the GSW toolbox's example cast; density by the full Gibbs function."""
    S_A = [34.7118, 34.8915, 35.0256, 34.8472, 34.7366, 34.7324]
    t = [28.7856, 28.4329, 22.8103, 10.2600, 6.8863, 4.4036]
    p = [10.0, 50.0, 125.0, 250.0, 600.0, 1000.0]
    CT = seawater.conservative_temperature(t, S_A, p)
    assert pytest.approx(
        [28.809919826700281, 28.439227816091140, 22.786176893078498, 10.226189266620782, 6.827213633479988,
         4.323575748610455], abs=1e-9) == CT  # fmt: skip
    # the 75-term polynomial is a fit to the full Gibbs function; warm water under pressure is its worst
    assert np.abs(seawater.density(S_A, CT, p) - gsw.rho_t_exact(S_A, t, p)).max() < 1e-3
    assert np.abs(seawater.sound_speed(S_A, CT, p) - gsw.sound_speed_t_exact(S_A, t, p)).max() < 0.2
    assert seawater.in_situ_temperature(CT, S_A, p) == pytest.approx(t, abs=1e-9)


def test_freezing_and_depth() -> None:
    assert float(seawater.freezing_temperature(35.16504, 0.0, 1.0)) == pytest.approx(-1.9217, abs=1e-3)
    assert float(seawater.freezing_temperature(0.0, 0.0)) == pytest.approx(0.0, abs=3e-3)
    p = seawater.pressure_from_depth([0.0, 100.0, 5000.0], 30.0)
    assert p == pytest.approx(gsw.p_from_z([-0.0, -100.0, -5000.0], 30.0))
    assert seawater.depth_from_pressure(p, 30.0) == pytest.approx([0.0, 100.0, 5000.0], abs=1e-6)


def test_absolute_salinity_far_from_any_ocean() -> None:
    """A lake in the middle of Asia has no anomaly of composition."""
    assert float(seawater.absolute_salinity(0.1, 0.0, 90.0, 47.0)) == pytest.approx(0.1 * 35.16504 / 35.0, rel=1e-9)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: seawater.density(-1.0, 10.0, 0.0), "Absolute Salinity = -1"),
        (lambda: seawater.density(35.0, 60.0, 0.0), "temperature = 60"),
        (lambda: seawater.sound_speed(35.0, 10.0, 1e6), "sea pressure"),
        (lambda: seawater.pressure_from_depth(10.0, 91.0), "latitude = 91"),
        (lambda: seawater.pressure_from_depth(-50.0, 10.0), "depth = -50"),
        (lambda: seawater.density(np.inf, 10.0, 0.0), "Absolute Salinity = inf"),
    ],
)
def test_what_seawater_cannot_have(call, words) -> None:
    with pytest.raises(seawater.SeawaterRangeError, match=words):
        call()


def test_stratifications() -> None:
    assert uniform(35.0, 10.0, 100.0).density(0.0) == pytest.approx(gsw.rho(35.0, 10.0, 0.0))
    middle = linear((34.0, 35.0), (20.0, 10.0), 100.0)
    assert middle.density(50.0) == pytest.approx(gsw.rho(34.5, 15.0, gsw.p_from_z(-50.0, 30.0)))
    assert middle.sound_speed(50.0) == pytest.approx(gsw.sound_speed(34.5, 15.0, gsw.p_from_z(-50.0, 30.0)))
    layers = two_layer((34.0, 35.0), (25.0, 5.0), 40.0, 5.0, 200.0)
    z = np.linspace(0.0, 200.0, 1001)
    expected = 34.0 + 0.5 * (1.0 + np.tanh((z - 40.0) / 5.0))
    assert np.abs(np.interp(z, layers.depths, layers.S_A) - expected).max() < 1e-3
    assert south_china_sea(1000.0).density(0.0) == 1022.7
    assert south_china_sea(5000.0).density(5000.0) <= 1034.5


@pytest.mark.parametrize("depths", [[], [-1.0, 2.0], [0.0, 0.0]])
def test_stratifications_that_are_none(depths) -> None:
    values = np.ones(len(depths))
    with pytest.raises(seawater.StratificationError):
        seawater.Stratification(np.array(depths), values, values)
