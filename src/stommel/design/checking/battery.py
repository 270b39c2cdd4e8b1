"""Voltages of the motors against that of the battery."""

from collections.abc import Iterator

from stommel.design.named_warning import NamedWarning
from stommel.vehicle import Vehicle

VOLTAGE_SLACK = 0.15
"""Relative difference that cells between full and empty make by themselves."""


def voltages(vehicle: Vehicle) -> Iterator[NamedWarning]:
    """Each motor of the file is fed by the battery: its voltage is the battery's."""
    d = vehicle.description
    if d.battery is None:
        return
    stated: list[tuple[str, float]] = []
    if d.engine is not None:
        stated += [
            (f"engine.motors, {motor.name!r}: supply_voltage_v", motor.supply_voltage_v) for motor in d.engine.motors
        ]
    if d.drives is not None:
        for name, drive in (("pitch", d.drives.pitch), ("rudder", d.drives.rudder)):
            if drive is not None:
                stated.append((f"drives.{name}.motor.nominal_voltage_v", drive.motor.nominal_voltage_v))
    for key, volts in stated:
        if abs(volts / d.battery.voltage_v - 1.0) > VOLTAGE_SLACK:
            yield NamedWarning("voltage_differs", f"{key} = {volts:g}; battery.voltage_v = {d.battery.voltage_v:g}")
