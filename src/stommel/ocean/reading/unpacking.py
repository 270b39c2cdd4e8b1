"""Numbers of a packed variable: xarray masks and scales (CF conventions, sections 2.5.1 and 8.1).

The valid range, which it leaves alone, is applied here, in the units that it is written in.
"""

import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr
from netCDF4 import default_fillvals
from numpy.typing import NDArray

Array = NDArray[np.float64]
Raw = NDArray[Any]

_NO_NUMBER = 1e30
"""netCDF writes 9.97e36 where nothing was written."""
_PACKING = ("scale_factor", "add_offset")
_RANGES = ("valid_range", "valid_min", "valid_max")


@dataclass(frozen=True)
class ValidRange:
    """The numbers that a file itself calls valid."""

    low: float
    high: float
    packed: bool
    """Both ends are numbers as they are stored, not what they stand for."""
    name: str
    """Of the attribute."""

    def __str__(self) -> str:
        how = "as stored" if self.packed else "unpacked"
        return f"{self.name} {self.low:g} to {self.high:g} ({how})"

    def masked(self, stored: Raw, found: Array) -> NDArray[np.bool_]:
        """Where numbers lie outside; `found` are the same, unpacked."""
        values = stored if self.packed else found
        outside: NDArray[np.bool_] = (values < self.low) | (values > self.high)
        return outside & np.isfinite(found)


def unpacked(raw: Raw, attributes: Mapping[str, Any]) -> tuple[Raw, Array]:
    """Numbers as they are stored, signs settled, and unpacked at double precision with nan where nothing is.

    Raises
    ------
    ValueError
        An attribute of the packing is not the number that it should be.
    """
    unsigned = str(attributes.get("_Unsigned", "")).strip().lower()
    stored = _signed(raw, unsigned)
    settled: dict[str, Any] = {key: _number(key, attributes[key]) for key in _PACKING if key in attributes}
    fills = _fills(attributes, raw.dtype, unsigned)
    if fills.size:
        settled["missing_value"] = fills
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # that there are several fill values
        variable = xr.conventions.decode_cf_variable("x", xr.Variable(("n",), stored.ravel(), settled))
    found = np.array(variable.values, dtype=np.float64).reshape(raw.shape)
    found[~np.isfinite(found) | (np.abs(found) > _NO_NUMBER)] = np.nan
    return stored, found


def valid_ranges(attributes: Mapping[str, Any], dtype: np.dtype[Any]) -> list[ValidRange]:
    """The ways in which the valid range of a variable may be meant, the likely one first; none without a range.

    The NetCDF User's Guide lets it be of the type of the packed numbers. Where it is of another, it counts as unpacked;
    files in which that is not so are many.

    Raises
    ------
    ValueError
        The range is not one.
    """
    given = {key: np.atleast_1d(_numbers(key, attributes[key])) for key in _RANGES if key in attributes}
    if not given:
        return []
    unsigned = str(attributes.get("_Unsigned", "")).strip().lower()
    name, low, high = "valid_range", -np.inf, np.inf
    if "valid_range" in given:
        if given["valid_range"].size != 2:
            raise ValueError("valid_range must be two numbers")
        ends = [_signed(part.reshape(1), unsigned, dtype)[0] for part in given["valid_range"]]
        low, high = (float(end) for end in ends)
    else:
        name = " and ".join(key for key in _RANGES if key in given)
        low = float(_signed(given["valid_min"], unsigned, dtype)[0]) if "valid_min" in given else low
        high = float(_signed(given["valid_max"], unsigned, dtype)[0]) if "valid_max" in given else high
    if not low <= high:
        raise ValueError(f"{name} {low:g} to {high:g} does not increase")
    if not any(key in attributes for key in _PACKING):
        return [ValidRange(low, high, packed=False, name=name)]
    like_stored = all(part.dtype.kind in "iu" for part in given.values()) == (dtype.kind in "iu")
    return [ValidRange(low, high, packed, name) for packed in (like_stored, not like_stored)]


def _signed(values: Raw, unsigned: str, dtype: np.dtype[Any] | None = None) -> Raw:
    """Integers with the sign that `_Unsigned` gives those of the type of the variable."""
    kind = (dtype or values.dtype).kind
    if values.dtype.kind not in "iu" or (kind, unsigned) not in (("i", "true"), ("u", "false")):
        return values
    size = (dtype or values.dtype).itemsize
    return values.astype(f"{kind}{size}").view(f"{'u' if kind == 'i' else 'i'}{size}")


def _fills(attributes: Mapping[str, Any], dtype: np.dtype[Any], unsigned: str) -> Raw:
    """The numbers that mark nothing, of the type of the variable; without any, what the library fills with."""
    given = [
        np.atleast_1d(_numbers(key, attributes[key])) for key in ("_FillValue", "missing_value") if key in attributes
    ]
    if "_FillValue" not in attributes and dtype.itemsize > 1:
        given.append(np.atleast_1d(default_fillvals.get(dtype.str[1:], np.nan)))
    found = []
    for value in np.concatenate([part.astype(np.float64) for part in given]) if given else []:
        if dtype.kind in "iu" and not (np.isfinite(value) and value == np.rint(value)):
            continue
        with np.errstate(all="ignore"):
            found.append(_signed(np.array([value]).astype(dtype), unsigned)[0])
    return np.array(found)


def _numbers(key: str, value: Any) -> Raw:
    """Numbers of an attribute, also where they are written as text."""
    if isinstance(value, str):
        try:
            return np.array([float(part) for part in value.replace(",", " ").split()])
        except ValueError:
            raise ValueError(f"{key} = {value[:40]!r} is no number") from None
    found = np.asarray(value)
    if found.dtype.kind not in "iuf" or found.size == 0:
        raise ValueError(f"{key} is no number")
    return found


def _number(key: str, value: Any) -> np.float64:
    found = _numbers(key, value).ravel()
    if found.size != 1 or not np.isfinite(found[0]) or (key == "scale_factor" and found[0] == 0.0):
        raise ValueError(f"{key} = {value} is not one finite number other than zero")
    return np.float64(found[0])
