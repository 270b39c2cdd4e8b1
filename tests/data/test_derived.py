"""Oracle: check values that the TEOS-10 toolbox prints in its manual (stations at 4 N, 188 E)."""

import gsw
import numpy as np
import pytest
import xarray as xr
from numpy.typing import NDArray

from stommel.data.derived import with_derived
from stommel.data.water_masses import density_lines, round_levels

P = np.array([10.0, 50.0, 125.0, 250.0, 600.0, 1000.0])
S_P = np.array([34.5487, 34.7275, 34.8605, 34.6810, 34.5680, 34.5600])
T = np.array([28.7856, 28.4329, 22.8103, 10.2600, 6.8863, 4.4036])
SA_PRINTED = np.array([34.711778344814114, 34.891522618230098, 35.025544862476920, 34.847229026189588,
                       34.736628474576051, 34.732363065590846])  # fmt: skip
"""Manual of gsw_SA_from_SP."""
CT_PRINTED = np.array([28.809919826700281, 28.439227816091140, 22.786176893078498, 10.226189266620782,
                       6.827213633479988, 4.323575748610455])  # fmt: skip
"""Manual of gsw_CT_from_t, from the rounded salinities there."""


def station(**changed: NDArray[np.float64]) -> xr.Dataset:
    columns = {
        "pressure": P, "temperature": T, "conductivity": 0.1 * gsw.C_from_SP(S_P, T, P),
        "latitude": np.full(P.size, 4.0), "longitude": np.full(P.size, -172.0),
    } | changed  # fmt: skip
    return xr.Dataset({name: ("obs", values) for name, values in columns.items()})


def test_salinity_and_temperature_are_those_of_the_manual() -> None:
    found = with_derived(station())
    assert found["practical_salinity"].values == pytest.approx(S_P, abs=1e-9)
    assert found["absolute_salinity"].values == pytest.approx(
        SA_PRINTED, abs=1e-4
    )  # the atlas of salinity anomalies is newer
    assert found["conservative_temperature"].values == pytest.approx(CT_PRINTED, abs=1e-4)


def test_density_grows_and_sigma_is_density_brought_to_the_surface() -> None:
    found = with_derived(station())
    assert (np.diff(found["density"].values) > 0.0).all()
    assert (found["density"].values[1:] - 1000.0 > found["potential_density_anomaly"].values[1:]).all()
    assert found["density"].values[0] == pytest.approx(1021.8399, abs=1e-3)  # manual of gsw_rho
    assert found["depth"].values == pytest.approx(P * 0.9935, rel=2e-3)  # 1 dbar is about 0.9935 m


@pytest.mark.parametrize(
    ("name", "value"), [("temperature", 99.0), ("conductivity", -1.0), ("pressure", 1e6), ("latitude", np.nan)]
)
def test_an_impossible_value_spoils_its_own_sample_only(name: str, value: float) -> None:
    whole = with_derived(station())
    column = station()[name].values.copy()
    column[2] = value
    found = with_derived(station(**{name: column}))
    others = [0, 1, 3, 4, 5]
    for derived in ("absolute_salinity", "conservative_temperature", "density", "sound_speed"):
        assert np.isnan(found[derived].values[2]), derived
        assert found[derived].values[others] == pytest.approx(whole[derived].values[others], rel=1e-12)


def test_lines_of_density_have_their_density() -> None:
    lines = density_lines((33.0, 36.0), (2.0, 25.0))
    assert len({line.level for line in lines}) >= 5
    for line in lines:
        sigma = gsw.sigma0(line.absolute_salinity, line.conservative_temperature)
        assert sigma == pytest.approx(line.level, abs=5e-3)


def test_levels_are_round_and_inside() -> None:
    assert round_levels(20.3, 26.9, 8) == [21.0, 22.0, 23.0, 24.0, 25.0, 26.0]
    assert round_levels(1.0, 1.0, 8) == []
    assert round_levels(0.0, 0.01, 4) == [0.005]
