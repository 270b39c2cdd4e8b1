"""What a battery gives: rated, usable and derated energy, and its self-discharge."""

from dataclasses import dataclass

import numpy as np

from stommel.vehicle.schema import Battery

HOUR, MONTH = 3600.0, 30.0 * 86400.0


@dataclass(frozen=True)
class StoredEnergy:
    """Energy of a charged battery in water of one temperature."""

    rated_j: float
    """Capacity times voltage [J]."""
    derating: float
    """Part of the capacity that is available at this temperature."""
    usable_j: float
    """What may be taken [J]."""
    self_discharge_w: float
    """Loss without any load, as a power [W]."""


def stored_energy(battery: Battery, temperature_c: float) -> StoredEnergy:
    """Return the energy of a charged battery at a temperature [deg C] (eq-e10), (eq-e11).

    Beyond the ends of the derating table its end values hold; without a table nothing is lost to temperature.
    """
    rated = battery.capacity_ah * HOUR * battery.voltage_v
    table = battery.derating_temperature_c
    derating = float(np.interp(temperature_c, table, battery.derating_fraction)) if table else 1.0
    usable = 1.0 if battery.usable_fraction is None else battery.usable_fraction
    lost = battery.self_discharge_per_month or 0.0
    return StoredEnergy(rated, derating, rated * usable * derating, lost * rated / MONTH)
