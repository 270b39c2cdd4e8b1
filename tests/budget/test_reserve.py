"""Oracle: Archimedes, and the trim solver at the speed that a reserve is said to give."""

import pytest

from stommel.analysis import trim
from stommel.design.budget import budget_study
from stommel.vehicle import load_vehicle

ZJU = load_vehicle("zju")


def test_east_china_sea() -> None:
    """1010 to 1027 kg/m3: the middle is found so that both ends lack the same, and what the engine covers is named."""
    study = budget_study(ZJU, (1010.0, 1027.0))
    left, trimmed = study.reserve, study.trimming
    assert left is not None
    assert trimmed is not None
    first, last = left.rows[0], left.rows[-1]
    assert first.to_climb == pytest.approx(last.to_dive, rel=1e-3)
    for row in left.rows:
        # weight = buoyancy of hull and bladder
        assert row.rho * (trimmed.volume + row.neutral) == pytest.approx(trimmed.mass, rel=1e-9)
        assert row.to_dive + row.to_climb + left.compression == pytest.approx(500e-6, rel=1e-9)
    assert left.least < 0.0
    assert "reserve_exhausted" in {warning.name for warning in study.warnings}


def test_the_band_is_where_the_reserves_end() -> None:
    study = budget_study(ZJU, 1020.0)
    left = study.reserve
    assert left is not None
    assert left.sinks_and_rises is not None
    low, high = left.sinks_and_rises
    mass, volume = 1020.0 * 0.060, 0.060
    assert mass / high - volume == pytest.approx(-250e-6, rel=1e-6)
    assert mass / low - volume + left.compression == pytest.approx(250e-6, rel=1e-6)
    assert left.compression == pytest.approx(0.060 * 5e-10 * 1020.0 * 9.81 * 200.0, rel=1e-6)


def test_speed_of_a_reserve_is_the_trim_solvers() -> None:
    left = budget_study(ZJU).reserve
    assert left is not None
    (row,) = left.rows
    assert row.dive_speed is not None
    flight = trim(ZJU, speed_m_s=row.dive_speed, pitch_deg=-35.0, within_limits=False)
    assert -flight.V_b == pytest.approx(row.to_dive, rel=1e-6)
    assert row.climb_speed is not None
    assert row.climb_speed < row.dive_speed  # the hull has shrunk at depth


def test_a_narrow_area_is_covered() -> None:
    study = budget_study(ZJU, (1019.0, 1021.0))
    assert study.reserve is not None
    assert study.reserve.least > 0.0
    assert not {"reserve_exhausted", "reserve_slow"} & {warning.name for warning in study.warnings}
    between = budget_study(ZJU, (1017.0, 1023.5))
    assert "reserve_slow" in {warning.name for warning in between.warnings}


def test_the_band_of_flights_is_where_the_design_speed_is_just_reached() -> None:
    """Archimedes: at its ends the engine has just the trim solver's ballast left, above on the shrunken hull."""
    left = budget_study(ZJU, 1020.0).reserve
    assert left is not None
    assert left.flies is not None
    assert left.design_speed is not None
    low, high = left.flies
    dive, climb = (
        trim(ZJU, speed_m_s=left.design_speed, pitch_deg=pitch, within_limits=False).V_b for pitch in (-35.0, 35.0)
    )
    mass, volume = 1020.0 * 0.060, 0.060
    assert mass / high - volume + dive == pytest.approx(-250e-6, rel=1e-6)
    assert mass / low - volume + climb + left.compression == pytest.approx(250e-6, rel=1e-6)
