"""Oracles: the closed forms of the analytic oceans."""

from typing import Any

import gsw
import numpy as np
import pytest
from pyproj import Geod

from stommel.ocean import Ocean, OutsideOceanError, UnknownOceanError
from stommel.ocean.analytic.catalogue import ANALYTIC
from stommel.ocean.analytic.east_china_sea import EastChinaSea
from stommel.seawater.stratification import SOUTH_CHINA_SEA

GEOD = Geod(ellps="WGS84")


@pytest.mark.parametrize("name", ANALYTIC)
def test_every_ocean_answers_in_its_middle(name: str) -> None:
    ocean = Ocean.analytic(name)
    middle = ANALYTIC[name]()
    sample = ocean.at("2025-07-01T00:00:00", middle.latitude_deg, middle.longitude_deg, 2.0)
    assert 995.0 < sample.density < 1035.0
    assert sample.pressure == pytest.approx(sample.density * 9.8 * 2.0, rel=3e-3)
    assert ocean.summary()["outside"] == "error"


def test_still_water_of_a_given_density() -> None:
    sample = Ocean.analytic("still", density_kg_m3=1000.0).at(0.0, 30.0, 125.0, 200.0)
    assert sample.density == 1000.0
    assert (sample.current_east, sample.current_north) == (0.0, 0.0)


def test_uniform_current_is_the_same_everywhere() -> None:
    ocean = Ocean.analytic("uniform", current_east_m_s=0.3, current_north_m_s=-0.1)
    for place in ((30.0, 125.0), (-89.9, 10.0), (90.0, 0.0), (5.0, 180.0)):
        sample = ocean.at(1e9, *place, 50.0)
        assert (sample.current_east, sample.current_north) == pytest.approx((0.3, -0.1), rel=1e-7)


def test_shear_is_linear_in_depth() -> None:
    ocean = Ocean.analytic("shear", surface_east_m_s=0.4, deep_east_m_s=-0.1, sheared_depth_m=200.0)
    for z in (0.0, 37.0, 100.0, 200.0, 900.0):
        expected = 0.4 - 0.5 * min(z / 200.0, 1.0)
        assert ocean.at(0.0, 30.0, 125.0, z).current_east == pytest.approx(expected, abs=1e-7)


def test_tide_runs_round_its_ellipse() -> None:
    """Along the axes of the ellipse the current is (a cos, b sin) of the angle; its acceleration is the derivative."""
    a, b, inclination, phase, period = 0.5, -0.2, 40.0, 75.0, 12.0
    ocean = Ocean.analytic(
        "tide", semi_major_m_s=a, semi_minor_m_s=b, inclination_deg=inclination, phase_deg=phase, period_hours=period
    )
    omega, turn = 2.0 * np.pi / (period * 3600.0), np.exp(1j * np.radians(inclination))
    for time in np.linspace(1.7e9, 1.7e9 + 43200.0, 9):
        angle = omega * time - np.radians(phase)
        current = turn * (a * np.cos(angle) + 1j * b * np.sin(angle))
        rate = omega * turn * (-a * np.sin(angle) + 1j * b * np.cos(angle))
        sample = ocean.at(float(time), 30.0, 125.0, 10.0)
        assert sample.current_east + 1j * sample.current_north == pytest.approx(current, abs=1e-7)
        assert sample.acceleration_east + 1j * sample.acceleration_north == pytest.approx(rate, rel=1e-6)


@pytest.mark.parametrize("latitude", [30.0, -60.0, 89.9])
def test_gyre_turns_round_its_middle(latitude: float) -> None:
    """Speed and direction of the eddy; the centripetal acceleration U2/r of the water. Bars: the grid's resolution.

    With the middle 11 km from the pole, the pole lies inside the eddy and directions are those of each place.
    """
    R, U = 50e3, 0.3
    ocean = Ocean.analytic("gyre", latitude_deg=latitude, longitude_deg=125.0, speed_m_s=U, radius_km=R / 1e3)
    for bearing in (10.0, 100.0, 250.0):
        for r in (20e3, 50e3, 90e3):
            longitude, place, back = GEOD.fwd(125.0, latitude, bearing, r)
            sample = ocean.at(0.0, place, longitude, 100.0)
            speed = U * r / R * np.exp(0.5 * (1.0 - (r / R) ** 2))
            assert np.hypot(sample.current_east, sample.current_north) == pytest.approx(speed, rel=3e-3)
            # counterclockwise: to the left of the way out
            outward = np.radians(back + 180.0)
            assert sample.current_east == pytest.approx(-speed * np.cos(outward), abs=0.003 * U)
            assert sample.current_north == pytest.approx(speed * np.sin(outward), abs=0.003 * U)
            inward = -(sample.acceleration_east * np.sin(outward) + sample.acceleration_north * np.cos(outward))
            assert inward == pytest.approx(speed**2 / r, rel=0.06)


def test_two_layers() -> None:
    ocean = Ocean.analytic("two_layer", interface_m=40.0, thickness_m=5.0, upper_east_m_s=0.5, lower_east_m_s=0.1)
    for z in np.linspace(0.0, 100.0, 67):
        share = 0.5 * (1.0 + np.tanh((z - 40.0) / 5.0))
        assert ocean.at(0.0, 30.0, 125.0, float(z)).current_east == pytest.approx(0.5 - 0.4 * share, abs=4e-4)
    assert ocean.at(0.0, 30.0, 125.0, 0.0).temperature == pytest.approx(25.0, abs=1e-3)
    assert ocean.at(0.0, 30.0, 125.0, 0.0).density < ocean.at(0.0, 30.0, 125.0, 80.0).density - 3.0


def test_south_china_sea_density_is_the_polynomial() -> None:
    ocean = Ocean.analytic("south_china_sea")
    for z in (0.0, 10.25, 200.0, 733.3):
        expected = min(float(np.polynomial.polynomial.polyval(z, SOUTH_CHINA_SEA)), 1034.5)
        assert ocean.at(0.0, 18.0, 115.0, z).density == pytest.approx(expected, abs=2e-5)
    assert ocean.at(0.0, 18.0, 115.0, 3000.0).density <= 1034.5


def test_pool_is_fresh_and_shallow() -> None:
    pool = Ocean.analytic("pool")
    assert pool.bottom_depth(30.26, 120.12) == 3.5
    sample = pool.at(0.0, 30.26, 120.12, 3.5)
    assert sample.absolute_salinity == 0.0
    assert sample.density == pytest.approx(float(gsw.rho(0.0, gsw.CT_from_t(0.0, 20.0, 0.0), 3.43)), abs=1e-4)


class TestEastChinaSea:
    sea = EastChinaSea()

    def place(self, along: float, across: float) -> tuple[float, float]:
        bearing = self.sea.jet_bearing_deg + np.degrees(np.arctan2(across, along))
        longitude, latitude, _ = GEOD.fwd(
            self.sea.longitude_deg, self.sea.latitude_deg, bearing, np.hypot(across, along)
        )
        return latitude, longitude

    @pytest.mark.parametrize("across", [-180e3, -20e3, 25e3, 80e3, 150e3])
    def test_closed_form(self, across: float) -> None:
        ocean = Ocean.analytic("east_china_sea", tide_semi_major_m_s=0.0, tide_semi_minor_m_s=0.0)
        place = self.place(-120e3, across)
        d, z = np.array([across]), 40.0
        assert ocean.bottom_depth(*place) == pytest.approx(self.sea.bottom(d)[0], rel=5e-3)
        sample = ocean.at(0.0, *place, z)
        speed = float(self.sea.jet_speed(d, np.array([z]))[0])
        assert np.hypot(sample.current_east, sample.current_north) == pytest.approx(speed, abs=4e-3)
        theta, salt = (float(a[0]) for a in self.sea.water(d, np.array([z])))
        S_A = float(gsw.SA_from_SP(salt, z, self.sea.longitude_deg, self.sea.latitude_deg))
        assert sample.absolute_salinity == pytest.approx(S_A, abs=3e-3)
        assert sample.conservative_temperature == pytest.approx(float(gsw.CT_from_pt(S_A, theta)), abs=0.05)

    def test_transport_of_the_jet(self) -> None:
        """Summed over a section by the ocean's own answers: 18.5 Sv, the figure that the jet was given."""
        ocean = Ocean.analytic("east_china_sea", tide_semi_major_m_s=0.0, tide_semi_minor_m_s=0.0)
        across = np.linspace(-249e3, 199e3, 113)
        course, flow = np.radians(self.sea.jet_bearing_deg), []
        for d in across:
            place = self.place(1e3, float(d))
            depths = np.linspace(0.0, ocean.bottom_depth(*place), 40)
            samples = [ocean.at(0.0, *place, float(z)) for z in depths]
            along = [s.current_east * np.sin(course) + s.current_north * np.cos(course) for s in samples]
            flow.append(np.trapezoid(along, depths))
        assert np.trapezoid(flow, across) == pytest.approx(18.5e6, rel=0.01)

    def test_water_is_stably_stratified(self) -> None:
        ocean = Ocean.analytic("east_china_sea")
        for across in (-200e3, 0.0, 30e3, 120e3):
            layers = ocean.stratification(0.0, *self.place(0.0, across))
            potential = gsw.rho(layers.S_A, layers.CT, 0.0)
            assert np.diff(potential).min() > -1e-4

    def test_tide_carries_the_same_water_everywhere(self) -> None:
        ocean, still = (
            Ocean.analytic("east_china_sea", **k) for k in ({}, {"tide_semi_major_m_s": 0, "tide_semi_minor_m_s": 0})
        )
        for across in (-200e3, 150e3):
            place = self.place(0.0, across)
            tide = [
                np.hypot(a.current_east - b.current_east, a.current_north - b.current_north)
                for a, b in (
                    (o.at(t, *place), still.at(t, *place)) for o in (ocean,) for t in np.linspace(0, 44714.0, 60)
                )
            ]
            depth = float(self.sea.bottom(np.array([across]))[0])
            assert max(tide) == pytest.approx(0.35 * 100.0 / depth, rel=0.01)

    def test_beyond_its_edge_it_refuses(self) -> None:
        with pytest.raises(OutsideOceanError, match="outside the ocean"):
            Ocean.analytic("east_china_sea").at(0.0, 35.0, 122.0)


@pytest.mark.parametrize(
    ("name", "parameters", "words"),
    [
        ("gyr", {}, ["unknown analytic ocean", "gyre"]),
        ("gyre", {"speeed_m_s": 1.0}, ["unknown parameter speeed_m_s", "radius_km"]),
        ("gyre", {"speed_m_s": 9.0}, ["speed_m_s = 9", "between -5 and 5"]),
        ("gyre", {"speed_m_s": "fast"}, ["speed_m_s = 'fast'", "number"]),
        ("pool", {"bottom_m": -3.0}, ["bottom_m = -3", "greater than 0"]),
        ("shear", {"sheared_depth_m": 300.0, "bottom_m": 200.0}, ["sheared_depth_m = 300"]),
    ],
)
def test_unknown_oceans_and_parameters(name: str, parameters: dict[str, Any], words: list[str]) -> None:
    with pytest.raises(UnknownOceanError) as refused:
        Ocean.analytic(name, **parameters)
    for word in words:
        assert word in str(refused.value)
