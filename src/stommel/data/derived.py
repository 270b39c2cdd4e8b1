"""What follows from pressure, temperature and conductivity by TEOS-10 (IOC, SCOR and IAPSO 2010), through `gsw`."""

from collections.abc import Collection

import gsw
import numpy as np
import xarray as xr
from numpy.typing import NDArray

from stommel.data.variables import BY_NAME

Array = NDArray[np.float64]
DERIVED = (
    "depth", "practical_salinity", "absolute_salinity", "conservative_temperature", "density",
    "potential_density_anomaly", "sound_speed",
)  # fmt: skip


def within(name: str, values: Array) -> Array:
    """Values of a variable; what is outside of its physical range is no number, and its neighbours stay."""
    low, high = BY_NAME[name].low, BY_NAME[name].high
    assert low is not None
    assert high is not None
    found: Array = np.where((values >= low) & (values <= high), values, np.nan)
    return found


def with_derived(samples: xr.Dataset, wanted: Collection[str] = DERIVED) -> xr.Dataset:
    """Return samples with depth, salinities, conservative temperature, densities and speed of sound.

    Parameters
    ----------
    samples
        `pressure` [dbar], `temperature` [degC], `conductivity` [S/m], `latitude` and `longitude` [deg], along one
        dimension. Absolute Salinity wants the place; where the position is unknown, what depends on it is unknown.
    wanted
        Which of them; the fewer, the faster.
    """
    C, t, p, longitude, latitude = (
        within(name, samples[name].values.astype(np.float64))
        for name in ("conductivity", "temperature", "pressure", "longitude", "latitude")
    )
    dims = samples["pressure"].dims
    values: dict[str, Array] = {}
    if "depth" in wanted:
        values["depth"] = -gsw.z_from_p(p, latitude)
    if any(name != "depth" for name in wanted):
        S_P = within("practical_salinity", gsw.SP_from_C(10.0 * C, t, p))  # gsw wants mS/cm
        S_A = within("absolute_salinity", gsw.SA_from_SP(S_P, p, longitude, latitude))
        CT = gsw.CT_from_t(S_A, t, p)
        values |= {"practical_salinity": S_P, "absolute_salinity": S_A, "conservative_temperature": CT}
        for name, of in (("density", gsw.rho), ("sound_speed", gsw.sound_speed)):
            if name in wanted:
                values[name] = of(S_A, CT, p)
        if "potential_density_anomaly" in wanted:
            values["potential_density_anomaly"] = gsw.sigma0(S_A, CT)
    return samples.assign({name: (dims, values[name], BY_NAME[name].attributes) for name in DERIVED if name in values})
