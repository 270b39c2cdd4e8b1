"""Oracle: the simulation, for the closed form of an inflation's energy and time."""

import numpy as np
import pytest

from stommel.machinery.engine import InflationCosts, inflation_energy, simulate
from stommel.vehicle.schema import Engine

ML = 1e-6


@pytest.mark.parametrize("pressure_mpa", [0.0, 0.5, 2.0])
@pytest.mark.parametrize("volume_ml", [50.0, 200.0, 500.0])
def test_energy_and_time_of_an_inflation(any_engine: Engine, pressure_mpa: float, volume_ml: float) -> None:
    phase = simulate(any_engine, pressure_pa=pressure_mpa * 1e6, inflate_m3=volume_ml * ML).phases[0]
    energy = float(inflation_energy(any_engine, volume_ml * ML, pressure_mpa * 1e6))
    assert energy == pytest.approx(phase.energy_j, rel=0.01)
    time = float(InflationCosts(any_engine).duration_s(volume_ml * ML, pressure_mpa * 1e6))
    assert time == pytest.approx(phase.duration_s, rel=0.01)


def test_arrays_and_what_cannot_be_done(zju: Engine) -> None:
    costs = InflationCosts(zju)
    pressures = np.array([0.0, 2e6, 2e7])
    energies = costs.energy_j(500 * ML, pressures)
    assert energies.shape == (3,)
    assert energies[0] < energies[1]
    assert np.isnan(energies[2])
    assert np.isnan(costs.duration_s(500 * ML, pressures)[2])
