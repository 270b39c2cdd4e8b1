"""What a vehicle sampled, out of the archive: a data set with positions, profiles and TEOS-10 quantities."""

from datetime import UTC, datetime

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from sqlalchemy import ColumnElement, and_, func, select

from stommel.archive import schema
from stommel.archive.archive import Archive
from stommel.data.derived import with_derived
from stommel.data.files import TIME, as_trajectory
from stommel.data.profiles import with_profiles
from stommel.data.variables import BY_NAME
from stommel.errors import StommelError

MOST_SAMPLES = 2_000_000
"""In one data set."""
FARTHEST = 7200.0
"""Time from a sample to a position, over which none is made up [s]."""
_US = 1e-6
Array = NDArray[np.float64]


class TooManySamplesError(StommelError):
    """More samples than one answer can hold."""


def export_dataset(archive: Archive, vehicle: int, begin: float, end: float) -> xr.Dataset:
    """Samples of the CTD between two times [s since 1970], as a CF trajectory; profiles are numbered from its begin.

    Raises
    ------
    TooManySamplesError
        There are more than `MOST_SAMPLES`; take a shorter time.
    """
    return trajectory(archive, vehicle, sampled(archive, vehicle, begin, end))


def trajectory(archive: Archive, vehicle: int, samples: xr.Dataset) -> xr.Dataset:
    """Samples of a vehicle as a CF trajectory with its name."""
    with archive.reading() as connection:
        row = connection.execute(
            select(schema.vehicles.c.name, schema.vehicles.c.model).where(schema.vehicles.c.id == vehicle)
        ).first()
    name, model = ("", "") if row is None else (row.name, row.model)
    about = {
        "title": f"CTD samples of {name or f'vehicle {vehicle}'}",
        "platform": model or "underwater glider",
        "history": f"{datetime.now(UTC):%Y-%m-%dT%H:%M:%SZ} from the archive of a shore station",
        "comment": "positions under water are the vehicle's own reckoning, interpolated in time",
        "references": "IOC, SCOR and IAPSO (2010): TEOS-10",
    }
    return as_trajectory(samples, f"vehicle-{vehicle}", about)


def sampled(archive: Archive, vehicle: int, begin: float, end: float) -> xr.Dataset:
    """Samples with positions, profile numbers and derived quantities, along `obs` in the order of time."""
    time, columns = _ctd(archive, vehicle, begin, end)
    latitude, longitude = positions(archive, vehicle, time)
    data = {
        "latitude": latitude,
        "longitude": longitude,
        "pressure": columns[1],
        "temperature": columns[2],
        "conductivity": columns[3],
    }
    made = xr.Dataset(
        {name: ("obs", values, BY_NAME[name].attributes) for name, values in data.items()}
        | {"time": ("obs", time, TIME)}
        | {"dive": ("obs", np.nan_to_num(columns[0]).astype(np.int32), {"long_name": "number of the dive"})}
    )
    return with_derived(with_profiles(made))


def positions(archive: Archive, vehicle: int, time: Array) -> tuple[Array, Array]:
    """Latitude and longitude [deg] at some times, between those that the vehicle told.

    Where the next told position is more than `FARTHEST` away in time there is none.
    """
    if not time.size:
        return np.empty(0), np.empty(0)
    begin, end = float(time[0]) - FARTHEST, float(time[-1]) + FARTHEST
    told = [_channel(archive, vehicle, key, begin, end) for key in ("latitude_deg", "longitude_deg")]
    stamps, at, also = np.intersect1d(told[0][0], told[1][0], return_indices=True)
    if not stamps.size:
        return np.full(time.size, np.nan), np.full(time.size, np.nan)
    latitude = np.interp(time, stamps, told[0][1][at])
    unwrapped = np.unwrap(told[1][1][also], period=360.0)  # over the date line
    longitude = (np.interp(time, stamps, unwrapped) + 180.0) % 360.0 - 180.0
    after = np.clip(np.searchsorted(stamps, time), 0, stamps.size - 1)
    nearest = np.minimum(np.abs(stamps[after] - time), np.abs(stamps[np.maximum(after - 1, 0)] - time))
    far = nearest > FARTHEST
    return np.where(far, np.nan, latitude), np.where(far, np.nan, longitude)


def _between(column: ColumnElement[int], begin: float, end: float) -> ColumnElement[bool]:
    return and_(column >= round(begin / _US), column <= round(end / _US))


def _ctd(archive: Archive, vehicle: int, begin: float, end: float) -> tuple[Array, list[Array]]:
    c = schema.ctd.c
    wanted = (c.vehicle_id == vehicle) & _between(c.t_us, begin, end)
    with archive.reading() as connection:
        count = connection.execute(select(func.count()).where(wanted)).scalar_one()
        if count > MOST_SAMPLES:
            raise TooManySamplesError(f"{count} samples: at most {MOST_SAMPLES} at a time; take a shorter time")
        rows = connection.execute(
            select(c.t_us, c.dive, c.pressure_dbar, c.temperature_degc, c.conductivity_s_m)
            .where(wanted)
            .order_by(c.t_us)
        ).all()
    table = np.array([tuple(row) for row in rows], dtype=np.float64).reshape(-1, 5)
    return table[:, 0] * _US, [table[:, k] for k in range(1, 5)]


def _channel(archive: Archive, vehicle: int, key: str, begin: float, end: float) -> tuple[Array, Array]:
    s, n = schema.samples.c, schema.channels.c
    with archive.reading() as connection:
        number = connection.execute(select(n.id).where(n.key == key)).scalar()
        rows = connection.execute(
            select(s.t_us, s.value)
            .where((s.vehicle_id == vehicle) & (s.channel_id == number) & _between(s.t_us, begin, end))
            .order_by(s.t_us)
            .limit(MOST_SAMPLES)
        ).all()
    table = np.array([tuple(row) for row in rows], dtype=np.float64).reshape(-1, 2)
    return table[:, 0] * _US, table[:, 1]
