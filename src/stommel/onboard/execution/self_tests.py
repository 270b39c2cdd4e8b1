"""Checks that prove the safety inputs; an unproven one is told in every frame, and no dive begins with it."""

from math import isfinite
from typing import NamedTuple

from stommel.onboard.execution.acquisition_io import AcquisitionReadings
from stommel.onboard.nodes.acquisition_settings import AcquisitionSettings


class Proof(NamedTuple):
    """Which safety inputs have passed their check."""

    pressure: bool = False
    """The pressure sensor reads the surface at the surface."""
    leak: bool = False
    """The wires of both leak detectors are whole: their test resistors are felt."""
    vacuum: bool = False
    """The pressure in the hull is one that a closed hull has."""
    voltage: bool = False
    """Voltage and current are what a battery at rest shows."""

    @property
    def missing(self) -> int:
        """Bits of the inputs that are not proven: pressure 1, leak 2, vacuum 4, voltage 8."""
        return sum(1 << i for i, proven in enumerate(self) if not proven)


def proof_of(readings: AcquisitionReadings, s: AcquisitionSettings) -> Proof:
    """Check the safety inputs by what they read at the surface, at rest; what does not answer is not proven."""
    return Proof(
        pressure=abs(readings.depth) <= s.surface_depth,
        leak=bool(readings.leak_loop),
        vacuum=s.vacuum_low <= readings.internal_pressure <= s.vacuum_high,
        voltage=s.voltage_low <= readings.voltage <= s.voltage_high
        and isfinite(readings.current)
        and abs(readings.current) <= s.current_at_rest,
    )
