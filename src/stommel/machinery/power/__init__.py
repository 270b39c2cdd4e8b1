"""Power: what actuators and consumers take from the battery, and what it holds."""

from stommel.machinery.power.model import EnergyModel, energy_model

__all__ = ["EnergyModel", "energy_model"]
