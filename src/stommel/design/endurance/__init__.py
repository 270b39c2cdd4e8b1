"""Energy and endurance: what a dive costs, how long a charge lasts, how to fly longest, what matters most."""

from stommel.design.endurance.best_flights import BestFlight, BestFlights, best_flights
from stommel.design.endurance.endurance import DepthError, Endurance, endurance
from stommel.design.endurance.sensitivity import Sensitivity, sensitivity
from stommel.design.endurance.study import EnergyStudy, Gap, GapStep, Interval, energy_study

__all__ = [
    "BestFlight",
    "BestFlights",
    "DepthError",
    "Endurance",
    "EnergyStudy",
    "Gap",
    "GapStep",
    "Interval",
    "Sensitivity",
    "best_flights",
    "endurance",
    "energy_study",
    "sensitivity",
]
