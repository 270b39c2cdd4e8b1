"""The record of a vehicle's samples, numbered once over its whole time, so that a profile keeps its number."""

from threading import Lock
from typing import NamedTuple

import numpy as np
import xarray as xr
from sqlalchemy import func, select

from stommel.archive import schema
from stommel.archive.archive import Archive
from stommel.archive.times import GREATEST_TIME
from stommel.station.products.samples import sampled


class _Kept(NamedTuple):
    stand: tuple[int, int]
    samples: xr.Dataset


class SampleRecords:
    """Gives the samples of each vehicle; read again only when there are more."""

    def __init__(self, archive: Archive) -> None:
        self._archive = archive
        self._kept: dict[int, _Kept] = {}
        self._lock = Lock()

    def of(self, vehicle: int) -> xr.Dataset:
        """All samples, with profiles and derived quantities, in the order of time."""
        with self._lock:
            stand = self._stand(vehicle)
            kept = self._kept.get(vehicle)
            if kept is None or kept.stand != stand:
                kept = self._kept[vehicle] = _Kept(stand, sampled(self._archive, vehicle, 0.0, GREATEST_TIME))
            return kept.samples

    def between(self, vehicle: int, begin: float, end: float) -> xr.Dataset:
        """Those samples between two times [s since 1970]."""
        samples = self.of(vehicle)
        time = samples["time"].values
        return samples.isel(obs=slice(int(np.searchsorted(time, begin)), int(np.searchsorted(time, end, "right"))))

    def _stand(self, vehicle: int) -> tuple[int, int]:
        c = schema.ctd.c
        with self._archive.reading() as connection:
            row = connection.execute(select(func.count(), func.max(c.t_us)).where(c.vehicle_id == vehicle)).one()
        return int(row[0]), int(row[1] or 0)
