"""What a vehicle sampled, out of the archive: data sets with positions and TEOS-10 quantities."""

from collections.abc import Collection
from datetime import UTC, datetime

import numpy as np
import xarray as xr
from sqlalchemy import select

from stommel.archive import schema
from stommel.archive.archive import Archive
from stommel.archive.ctd_reading import CtdPiece
from stommel.data.derived import DERIVED, with_derived
from stommel.data.files import TIME, as_trajectory
from stommel.data.variables import BY_NAME
from stommel.products.positions import positions


def samples_of(archive: Archive, vehicle: int, piece: CtdPiece, wanted: Collection[str] = DERIVED) -> xr.Dataset:
    """Samples with positions and those derived quantities that are wanted, along `obs` in the order of time."""
    time = piece.time
    latitude, longitude = positions(archive, vehicle, time)
    data = {
        "latitude": latitude,
        "longitude": longitude,
        "pressure": piece.pressure,
        "temperature": piece.temperature,
        "conductivity": piece.conductivity,
    }
    made = xr.Dataset(
        {name: ("obs", values, BY_NAME[name].attributes) for name, values in data.items()}
        | {"time": ("obs", time, TIME)}
        | {"dive": ("obs", np.nan_to_num(piece.dive).astype(np.int32), {"long_name": "number of the dive"})}
    )
    return with_derived(made, wanted)


def trajectory(archive: Archive, vehicle: int, samples: xr.Dataset, what: str = "CTD samples") -> xr.Dataset:
    """Samples of a vehicle as a CF trajectory with its name; `what` they are stands in the title."""
    with archive.reading() as connection:
        row = connection.execute(
            select(schema.vehicles.c.name, schema.vehicles.c.model).where(schema.vehicles.c.id == vehicle)
        ).first()
    name, model = ("", "") if row is None else (row.name, row.model)
    about = {
        "title": f"{what} of {name or f'vehicle {vehicle}'}",
        "platform": model or "underwater glider",
        "history": f"{datetime.now(UTC):%Y-%m-%dT%H:%M:%SZ} from the archive of a shore station",
        "comment": "positions under water are the vehicle's own reckoning, interpolated in time",
        "references": "IOC, SCOR and IAPSO (2010): TEOS-10",
    }
    return as_trajectory(samples, f"vehicle-{vehicle}", about)
