"""Find the profiles of a flight, derive TEOS-10 quantities and make a section, as the shore station does."""

import numpy as np
import xarray as xr

from stommel import dataset_of, fly_mission, load_mission
from stommel.data.derived import with_derived
from stommel.data.gridding import section
from stommel.data.profiles import with_profiles
from stommel.data.summaries import profile_summaries
from stommel.simulation.scenario.shipped import mission_path

flown = dataset_of(fly_mission(load_mission(mission_path("pool_trial"))))
samples = xr.Dataset(
    {
        "time": ("obs", flown["sample_time"].values),
        "pressure": ("obs", flown["sample_pressure"].values),
        "temperature": ("obs", flown["sample_temperature"].values),
        "conductivity": ("obs", flown["sample_conductivity"].values),
        "latitude": ("obs", flown["sample_latitude"].values),
        "longitude": ("obs", flown["sample_longitude"].values),
    }
)
samples = with_derived(with_profiles(samples, least_change=1.0, edge=0.2))  # the pool is 3 m deep

print("profile  way   from    to  samples")
for profile in profile_summaries(samples):
    way = "down" if profile.direction > 0 else "up"
    top, bottom = profile.least_depth_m, profile.greatest_depth_m
    print(f"{profile.number:7d}  {way:4s}  {top:4.1f}  {bottom:4.1f}  {profile.samples:7d}")

grid = section(samples, "temperature", cell_m=0.5)
print(f"section: {grid.sizes['profile']} profiles, cells to {float(grid['depth'].max()) + 0.25:g} m,", end=" ")
print(f"temperature {float(np.nanmin(grid['temperature'])):.2f} to {float(np.nanmax(grid['temperature'])):.2f} degC")
