"""The CTD's water on its way from the plant to the instrument: salinity as conductivity, and the scenario's noise."""

import math

import numpy as np

from stommel.instruments.gpctd.device import CtdTruth
from stommel.simulation.scenario.scenario_file import ScenarioFile
from stommel.sitl.plant import Plant

_DBAR = 1e4
_MS_CM = 10.0
"""mS/cm in a S/m."""

NOTHING = CtdTruth(0.0, 0.0, 0.0)
"""What an instrument at rest is asked about."""


class Payload:
    """Tells the CTD what it measures, once an interval; in between it stays what it was.

    The interval is that of the scenario, or that of the vehicle where it samples more often, by its orders or by the
    phase of its dive. Each sample of the vehicle is then of water of its own, and nothing is worked out that nobody
    samples.
    """

    def __init__(self, scenario: ScenarioFile) -> None:
        self._noise = np.random.default_rng((scenario.seed, 1))
        self._ctd, self._every = scenario.ctd, scenario.sampling.every_s
        self._renewed = -math.inf
        self._last = NOTHING

    def truth(self, plant: Plant, latitude: float, longitude: float, utc: float, sampled_every: float) -> CtdTruth:
        """What the CTD measures now, at a place [deg], on a vehicle that samples once in so long [s]."""
        if plant.time < self._renewed + min(self._every, sampled_every) - 1e-6:
            return self._last
        import gsw  # noqa: PLC0415 - the first sample needs it

        self._renewed = plant.time
        felt, ctd = plant.water(), self._ctd
        noise = self._noise.standard_normal(3)
        p = max(felt.pressure / _DBAR, 0.0)
        practical = gsw.SP_from_SA(felt.salinity, p, longitude, latitude)
        self._last = CtdTruth(
            float(p + ctd.pressure_noise_dbar * noise[0]),
            float(felt.thermistor + ctd.temperature_noise_c * noise[1]),
            float(gsw.C_from_SP(practical, felt.cell, p) / _MS_CM + ctd.conductivity_noise_s_m * noise[2]),
            utc,
        )
        return self._last
