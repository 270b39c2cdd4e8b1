"""An ocean of one profile file; oracles: the profile's own numbers, gsw."""

from pathlib import Path
from typing import Any

import gsw
import pytest

from stommel.errors import StommelError
from stommel.ocean import Ocean

PLACE: dict[str, Any] = {"latitude_deg": 28.0, "longitude_deg": 126.0}


@pytest.fixture
def cast(tmp_path: Path) -> Path:
    (tmp_path / "cast.csv").write_text("depth_m,temperature_c,salinity_psu\n1,28,33.8\n30,26,33.9\n200,15,34.6\n")
    return tmp_path / "cast.csv"


def test_the_water_of_a_profile_is_everywhere(cast: Path) -> None:
    ocean = Ocean.open(cast, parameters=PLACE | {"bottom_m": 900.0, "current_east_m_s": 0.3})
    for time, place in ((0.0, (28.0, 126.0)), (2e9, (28.0, -60.0))):
        sample = ocean.at(time, *place, 30.0)
        p = float(gsw.p_from_z(-30.0, 28.0))
        S_A = float(gsw.SA_from_SP(33.9, p, 126.0, 28.0))
        assert sample.absolute_salinity == pytest.approx(S_A, abs=1e-5)
        assert sample.temperature == pytest.approx(26.0, abs=1e-4)
        rho = float(gsw.rho_t_exact(S_A, 26.0, p))
        assert sample.density == pytest.approx(rho, abs=5e-3)  # the pressure is the profile's own weight
        assert (sample.current_east, sample.current_north) == pytest.approx((0.3, 0.0))
        assert sample.bottom_depth == 900.0
    assert ocean.at(0.0, 28.0, 126.0, 600.0).conservative_temperature == pytest.approx(
        ocean.at(0.0, 28.0, 126.0, 200.0).conservative_temperature
    )
    assert "200 m are carried on" in ocean.notes["below"]
    assert "carried up" in ocean.notes["above"]


def test_density_given_directly_stays(tmp_path: Path) -> None:
    (tmp_path / "rho.csv").write_text("Z,density_kg_m3\n0,1020\n100,1025\n")
    ocean = Ocean.open("rho.csv", folder=tmp_path, names={"depth_m": "Z"})
    assert ocean.at(0.0, 28.0, 126.0, 50.0).density == pytest.approx(1022.5)
    assert "assumption" in ocean.notes["place"]


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"parameters": {"depth": 3.0}}, ["cast.csv", "unknown parameter depth", "bottom_m"]),
        ({"parameters": {"bottom_m": -3.0}}, ["bottom_m = -3", "greater than 0"]),
        ({"bounds": (0.0, 1.0, 0.0, 1.0)}, ["a profile is one file, without bounds"]),
        ({"names": {"T": "temperature_c"}}, ["unknown name T"]),
    ],
)
def test_what_does_not_fit_a_profile(cast: Path, options: dict[str, Any], words: list[str]) -> None:
    with pytest.raises(StommelError) as refused:
        Ocean.open(cast, **options)
    for word in words:
        assert word in str(refused.value)


def test_a_file_of_fields_has_no_parameters(tmp_path: Path) -> None:
    (tmp_path / "sea.nc").write_text("")
    with pytest.raises(StommelError, match="only a profile or an analytic ocean has parameters"):
        Ocean.open(tmp_path / "sea.nc", parameters={"bottom_m": 3.0})
