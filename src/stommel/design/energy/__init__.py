"""Energy and endurance: what a dive costs, how long a charge lasts, how to fly longest, what matters most."""

from stommel.design.energy.best_flights import BestFlight, BestFlights, best_flights
from stommel.design.energy.endurance import DepthError, Endurance, endurance
from stommel.design.energy.model import EnergyModel, energy_model
from stommel.design.energy.sensitivity import Sensitivity, sensitivity
from stommel.design.energy.study import EnergyStudy, Gap, GapStep, energy_study

__all__ = [
    "BestFlight",
    "BestFlights",
    "DepthError",
    "Endurance",
    "EnergyModel",
    "EnergyStudy",
    "Gap",
    "GapStep",
    "Sensitivity",
    "best_flights",
    "endurance",
    "energy_model",
    "energy_study",
    "sensitivity",
]
