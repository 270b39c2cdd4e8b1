"""What the data-acquisition board's pins say and do."""

from typing import NamedTuple


class AcquisitionReadings(NamedTuple):
    """Readings of the board's own sensors; SI units, not a number where a sensor does not answer."""

    depth: float
    """By the pressure sensor [m]."""
    altitude: float
    """By the altimeter [m]; infinite where it hears no bottom."""
    leak_fore: bool
    leak_aft: bool
    leak_loop: bool
    """Whether the test resistors of the leak detectors are felt: their wires are whole."""
    internal_pressure: float
    """Of the air in the hull, absolute [Pa]."""
    hull_temperature: float
    """[degC]"""
    voltage: float
    """Of the battery [V]."""
    current: float
    """Out of the battery [A]."""
    battery_temperature: float
    """[degC]"""


class AcquisitionOutputs(NamedTuple):
    """What the board switches."""

    loads: int
    """Groups of consumers that are on, bits of `stommel.control.commands`."""
    sampling: bool
    """Whether the payload measures."""
    sample_interval: float
    """Between two samples, as the coordinator asked for [s]."""
    radio: bool
    """Whether GPS and radio have power."""
    ctd_bytes: bytes
    """To the CTD's serial port."""
