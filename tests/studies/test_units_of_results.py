"""Oracle: a table of units by hand. Every number of a study's result says its unit, parameters and outputs alike."""

from pathlib import Path

from stommel.studies.run import run_study
from stommel.studies.study import load_study
from tests.studies.conftest import UNIFORM, Write

UNITS = {
    "days": "days",
    "days_left": "days",
    "deepest_m": "m",
    "distance_over_ground_km": "km",
    "distance_through_water_km": "km",
    "mean_power_w": "W",
    "battery_wh": "W h",
    "battery_end_v": "V",
    "energy_wh_self_discharge": "W h",
    "reckoning_error_m_mean": "m",
    "current_error_m_s_greatest": "m/s",
    "pitch_deg": "degree",
    "current_east_m_s": "m/s",
}
WITHOUT = ("dives", "surfacings", "ctd_samples", "battery_left_share", "seed")


def test_every_number_says_its_unit(folder: Path, write: Write) -> None:
    study = write('kind = "monte_carlo"\nruns = 2\n' + UNIFORM)
    found = run_study(load_study(study), folder / "r.nc", workers=1).dataset
    assert {name: found[name].attrs.get("units") for name in UNITS} == UNITS
    assert all("units" not in found[name].attrs for name in WITHOUT)
    energies = [str(name) for name in found if str(name).startswith("energy_wh_")]
    assert len(energies) > 5
    assert {found[name].attrs["units"] for name in energies} == {"W h"}
