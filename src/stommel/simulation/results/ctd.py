"""What the CTD reports of a mission: pressure, temperature, conductivity, and the practical salinity from them."""

from typing import NamedTuple

import gsw
import numpy as np
from numpy.typing import NDArray

from stommel.control.dive_cycle import ASCENT, DESCENT
from stommel.simulation.flight import Flown

Array = NDArray[np.float64]

_DBAR = 1e4
_MS_CM = 10.0
"""mS/cm in one S/m."""


class Samples(NamedTuple):
    """Measurements of the CTD, one of each a sample."""

    pressure: Array
    """Sea pressure [dbar]."""
    temperature: Array
    """In situ, ITS-90, by the thermistor [deg C]."""
    conductivity: Array
    """Of the water at the temperature of the conductivity cell [S/m]."""
    practical_salinity: Array
    """PSS-78 of the three, without any correction of their lags."""


def profiles_of(flown: Flown) -> NDArray[np.int32]:
    """Number of the profile of each sample: descents are odd, ascents even, in their order from 1; 0 between them."""
    dive, phase = flown.samples["dive"].astype(np.int32), flown.samples["phase"]
    number = np.where(phase == DESCENT, 2 * dive - 1, np.where(phase == ASCENT, 2 * dive, 0))
    return number.astype(np.int32)


def samples_of(flown: Flown) -> Samples:
    """Work out what the CTD reports, with noise from the mission's seed.

    The mission loop lets thermistor and cell lag behind the water (`stommel.simulation.plant.sensing`). The cell
    measures the conductivity of the water warmed or cooled by its own walls; salinity spikes in a thermocline follow as
    at sea.
    """
    rows, ctd = flown.samples, flown.mission.scenario.ctd
    noise = np.random.default_rng([flown.mission.scenario.seed, 2])
    latitude, longitude = np.degrees(_column(rows, "latitude")), np.degrees(_column(rows, "longitude"))
    p = _column(rows, "pressure") / _DBAR
    SP = gsw.SP_from_SA(_column(rows, "salinity"), p, longitude, latitude)
    C = gsw.C_from_SP(SP, _column(rows, "cell"), p) / _MS_CM
    n = len(rows)
    pressure = p + ctd.pressure_noise_dbar * noise.standard_normal(n)
    temperature = _column(rows, "thermistor") + ctd.temperature_noise_c * noise.standard_normal(n)
    conductivity = C + ctd.conductivity_noise_s_m * noise.standard_normal(n)
    # in fresh water noise may take the conductivity below zero, where practical salinity has no value
    salinity = gsw.SP_from_C(np.maximum(conductivity, 0.0) * _MS_CM, temperature, pressure)
    return Samples(pressure, temperature, conductivity, salinity)


def _column(rows: NDArray[np.void], name: str) -> Array:
    return np.ascontiguousarray(rows[name])
