"""The search against brute force: no flight of a dense grid, and no random one, is better."""

from math import degrees, radians

import numpy as np
import pytest

from stommel.design.endurance import EnergyStudy, best_flights, endurance
from stommel.design.endurance.best_flights import _Search
from stommel.machinery.power import energy_model
from stommel.vehicle import FULL, PAPER, Vehicle


def test_nothing_on_a_dense_grid_is_better(zju: Vehicle, study: EnergyStudy) -> None:
    search = _Search(zju, energy_model(zju), PAPER)
    speed, pitch = np.meshgrid(np.linspace(0.1, 1.2, 160), np.radians(np.linspace(5.0, 50.0, 120)), indexing="ij")
    lasting, distance = search.flown(speed, pitch, np.array([60.0, 120.0, 200.0]))
    assert study.best.longest.endurance_s >= lasting.max() * (1 - 1e-6)
    assert study.best.farthest.range_m >= distance.max() * (1 - 1e-5)


def test_the_best_flights_are_flights(zju: Vehicle, study: EnergyStudy) -> None:
    for best in (study.best.longest, study.best.farthest):
        again = endurance(zju, speed_m_s=best.speed_m_s, pitch_deg=best.pitch_deg, depth_m=best.depth_m)
        assert again.endurance_s == pytest.approx(best.endurance_s, rel=1e-9)
        assert again.range_m == pytest.approx(best.range_m, rel=1e-9)


def test_an_optimum_names_its_limits(study: EnergyStudy) -> None:
    assert study.best.longest.limits == ("slowest speed", "shallowest pitch", "depth")
    assert "ballast volume" in study.best.farthest.limits
    assert study.best.longest.endurance_s > study.best.farthest.endurance_s
    assert study.best.farthest.range_m > study.best.longest.range_m


def test_full_physics_and_a_shallower_sea(zju: Vehicle) -> None:
    found = best_flights(zju, energy_model(zju), physics=FULL, deepest_m=80.0)
    assert found.farthest.depth_m == pytest.approx(80.0)
    again = endurance(
        zju,
        speed_m_s=found.farthest.speed_m_s,
        pitch_deg=found.farthest.pitch_deg,
        depth_m=found.farthest.depth_m,
        physics=FULL,
    )
    assert again.range_m == pytest.approx(found.farthest.range_m, rel=1e-9)


def test_a_slowest_speed_keeps_the_search_away_from_it(zju: Vehicle) -> None:
    model = energy_model(zju.with_value("energy.slowest_speed_m_s", 0.25))
    found = best_flights(zju, model, physics=PAPER, deepest_m=200.0)
    assert found.longest.speed_m_s == pytest.approx(0.25)
    assert degrees(radians(found.longest.pitch_deg)) <= -5.0 + 1e-9
