"""Fly half a day through a thermocline and take the CTD's lags out of its salinity, as at sea; then compare with truth.

A simulated mission knows the water that the vehicle flew through. That makes it a test bench for data processing: here
for the lag of the thermistor and for the thermal mass of the conductivity cell (Lueck and Picklo 1990), whose numbers
follow from the flow in the cell (Morison et al. 1994).
"""

from pathlib import Path

import gsw
import numpy as np

from stommel import dataset_of, fly_mission
from stommel.control.dive_cycle import PHASES
from stommel.simulation.scenario.loading import mission_from

PLAN = {
    "name": "Half a day over the shelf",
    "vehicle": "zju",
    "start_time": "2026-07-01T00:00:00Z",
    "duration_days": 0.5,
    "start": {"latitude_deg": 28.2, "longitude_deg": 126.6},
    "waypoints": [{"latitude_deg": 28.8, "longitude_deg": 126.6}],
    "dives": {"depth_m": 120.0, "pitch_deg": 35.0, "speed_m_s": 0.4},
    "output_every_s": 1.0,
    "sampling": {"every_s": 1.0},
    "ocean": {"name": "east_china_sea"},
}

flown = fly_mission(mission_from(PLAN, "example", Path()))
data = dataset_of(flown)
ctd = flown.mission.scenario.ctd

T, C, p = (data[f"sample_{name}"].values.astype(float) for name in ("temperature", "conductivity", "pressure"))
seconds = (data["sample_time"].values - data["sample_time"].values[0]) / np.timedelta64(1, "s")

# the thermistor answers as a first-order lag: the water was T + tau T'
water = T + ctd.temperature_lag_s * np.gradient(T, seconds)

# the cell's walls warm or cool the water in it by e, with e' = -e / tau + alpha T'
walls = np.zeros_like(T)
for n in range(1, len(T)):
    dt = seconds[n] - seconds[n - 1]
    decay = np.exp(-dt / ctd.thermal_lag_s)
    slope = (water[n] - water[n - 1]) / dt
    walls[n] = decay * walls[n - 1] + ctd.thermal_share * ctd.thermal_lag_s * (1.0 - decay) * slope

reported = gsw.SP_from_C(10.0 * C, T, p)
corrected = gsw.SP_from_C(10.0 * C, water - walls, p)

# the truth: Absolute Salinity along the flight, as practical salinity at the times of the samples
times = data["time"].values.astype("int64"), data["sample_time"].values.astype("int64")
absolute = np.interp(times[1], times[0], data["salinity"].values)
truth = gsw.SP_from_SA(absolute, p, data["sample_longitude"].values, data["sample_latitude"].values)

climbing = data["sample_phase"].values == PHASES.index("ascent")
for name, found in (("as reported", reported), ("corrected", corrected)):
    miss = found - truth
    rms, down, up = np.sqrt(np.mean(miss**2)), miss[~climbing].mean(), miss[climbing].mean()
    print(f"salinity {name:12} off by {rms:.4f} rms, on the mean {down:+.4f} down and {up:+.4f} up")
