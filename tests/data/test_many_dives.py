"""Whole deployments: as many profiles as ways were flown, all variables of one length, stamps as they were.

Oracles: dives that are made here, so that each way is known; xarray, which reads the files back.
"""

from pathlib import Path

import numpy as np
import xarray as xr
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.typing import NDArray

from stommel.data.derived import with_derived
from stommel.data.files import as_trajectory, write_netcdf
from stommel.data.profiles import EDGE, with_profiles
from stommel.data.variables import BY_NAME

BEGIN = 1_782_864_000.0
DIVES = 500
NOISE = 0.1
"""Of the pressure sensor [dbar]."""


def flown() -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.int64]]:
    """Time, pressure and way of each sample of many dives; -1 at the surface and while it turns.

    Depths, speeds, waits and gaps differ from dive to dive; samples come at 5 s and are now and then missing.
    """
    draw = np.random.default_rng(167)
    time, pressure, way = [np.array([BEGIN])], [np.zeros(1)], [np.full(1, -1)]
    for dive in range(DIVES):
        deepest, speed = draw.uniform(15.0, 200.0), draw.uniform(0.1, 0.4)
        for leg, (a, b) in enumerate(((0.0, deepest), (deepest, 0.0))):
            steps = int(deepest / speed / 5.0) + 2
            waits = int(draw.integers(0, 20))
            p = np.concatenate([np.linspace(a, b, steps), np.full(waits, b)])
            t = time[-1][-1] + 5.0 * np.arange(1, p.size + 1)
            inside = np.abs(p - a) > EDGE + 6.0 * NOISE
            inside &= np.abs(p - b) > EDGE + 6.0 * NOISE
            kept = draw.random(p.size) > 0.02
            kept[-1] = True
            time.append(t[kept])
            pressure.append(p[kept])
            way.append(np.where(inside, 2 * dive + leg, -1)[kept])
    p = np.concatenate(pressure)
    return np.concatenate(time), p + draw.normal(0.0, NOISE, p.size), np.concatenate(way)


def test_500_dives_have_exactly_1000_profiles_and_each_sample_is_in_one() -> None:
    """c-proof/pyglider#167, #40: extra half profiles of 25 samples, and a profile without a number in the middle."""
    time, pressure, way = flown()
    found = with_profiles(xr.Dataset({"pressure": ("obs", pressure), "time": ("obs", time)}))
    number, direction = found["profile_number"].values, found["profile_direction"].values
    in_one = number[number > 0]
    assert np.array_equal(in_one[np.flatnonzero(np.diff(in_one, prepend=0))], np.arange(1, 2 * DIVES + 1)), "in order"
    assert (number[way >= 0] == way[way >= 0] + 1).all(), "each sample of a way is in the profile of that way"
    assert (direction[way >= 0] == np.where(way[way >= 0] % 2 == 0, 1, -1)).all()


columns = arrays(np.float64, 40, elements=st.one_of(st.floats(0.0, 60.0), st.just(np.nan)))


@given(pressure=columns, temperature=columns, conductivity=columns, latitude=columns, first=st.integers(0, 10**9))
@settings(max_examples=60, deadline=None)
def test_all_variables_share_the_time_whatever_is_missing(
    pressure: NDArray[np.float64],
    temperature: NDArray[np.float64],
    conductivity: NDArray[np.float64],
    latitude: NDArray[np.float64],
    first: int,
) -> None:
    """c-proof/pyglider#116: a derived variable was shorter than the time where samples were missing."""
    values = {"pressure": pressure, "temperature": temperature, "conductivity": conductivity / 10.0,
              "latitude": latitude, "longitude": latitude}  # fmt: skip
    samples = xr.Dataset({name: ("obs", each, BY_NAME[name].attributes) for name, each in values.items()})
    samples = samples.assign(time=("obs", BEGIN + first + np.cumsum(np.where(np.isnan(latitude), 3600.0, 1.0))))
    made = as_trajectory(with_derived(with_profiles(samples)), "vehicle-1", {})
    assert {variable.shape for variable in made.variables.values() if variable.ndim} == {(40,)}


def test_stamps_come_back_to_the_millisecond_in_the_same_unit_from_every_file(tmp_path: Path) -> None:
    """c-proof/pyglider#141: units of time that differed from file to file, and a first stamp of 0."""
    units = set()
    for k, begin in enumerate((BEGIN, BEGIN + 0.001, BEGIN + 86_400.0 * 300 + 0.5)):
        time = begin + np.array([0.0, 0.001, 0.25, 7.123, 3600.999])
        samples = xr.Dataset({"pressure": ("obs", np.arange(5.0), BY_NAME["pressure"].attributes)})
        samples = samples.assign(time=("obs", time))
        write_netcdf(as_trajectory(with_profiles(samples), "vehicle-1", {}), tmp_path / f"{k}.nc")
        with xr.open_dataset(tmp_path / f"{k}.nc", decode_times=False) as raw:
            units.add(raw["time"].attrs["units"])
        with xr.open_dataset(tmp_path / f"{k}.nc") as found:
            read = (found["time"].values - np.datetime64("1970-01-01T00:00:00")) / np.timedelta64(1, "us") / 1e6
        assert np.abs(read - time).max() < 5e-4
    assert len(units) == 1
