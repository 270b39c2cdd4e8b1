"""How the water is layered: Absolute Salinity and Conservative Temperature against depth, or density itself."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stommel.errors import StommelError
from stommel.seawater import properties

SOUTH_CHINA_SEA = (1022.7, 0.02248, -2.75e-5, 1.95e-8, -5.083e-12)
"""Density by powers of the depth in m [kg/m3]; facts/parameters.md, section 7."""
SOUTH_CHINA_SEA_MOST = 1034.5
"""No denser than this [kg/m3]; the same source."""

_EMPTY: NDArray[np.float64] = np.zeros(0)


class StratificationError(StommelError):
    """Numbers that are no layered water."""


@dataclass(frozen=True)
class Stratification:
    """Water against depth, linear between the depths and held beyond them."""

    depths: NDArray[np.float64]
    """[m], positive down, increasing."""
    S_A: NDArray[np.float64]
    """Absolute Salinity [g/kg]."""
    CT: NDArray[np.float64]
    """Conservative Temperature [deg C]."""
    latitude: float = 30.0
    """Where the water is, for pressure from depth [deg]."""
    rho_depths: NDArray[np.float64] = field(default_factory=_EMPTY.copy)
    """Depths of a density that is given directly [m]; empty where density follows from TEOS-10."""
    rho: NDArray[np.float64] = field(default_factory=_EMPTY.copy)
    """That density [kg/m3]."""
    source: str = ""
    """Where the numbers come from."""

    def __post_init__(self) -> None:
        depths = self.depths
        if depths.size == 0 or depths[0] < 0.0 or np.any(np.diff(depths) <= 0.0):
            raise StratificationError("stratification: depths must be at least 0 m and increase")
        if self.S_A.shape != depths.shape or self.CT.shape != depths.shape:
            raise StratificationError("stratification: salinity and temperature need one number for each depth")
        if not np.all(np.isfinite([self.S_A, self.CT])):
            raise StratificationError("stratification: salinity and temperature must be finite numbers")

    def density(self, z: ArrayLike) -> NDArray[np.float64]:
        """In-situ density at depth `z` [kg/m3]."""
        if self.rho.size:
            return self._at(z, self.rho_depths, self.rho)
        p = properties.pressure_from_depth(z, self.latitude)
        return properties.density(self._at(z, self.depths, self.S_A), self._at(z, self.depths, self.CT), p)

    def sound_speed(self, z: ArrayLike) -> NDArray[np.float64]:
        """Speed of sound at depth `z` [m/s]."""
        p = properties.pressure_from_depth(z, self.latitude)
        return properties.sound_speed(self._at(z, self.depths, self.S_A), self._at(z, self.depths, self.CT), p)

    @staticmethod
    def _at(z: ArrayLike, depths: NDArray[np.float64], values: NDArray[np.float64]) -> NDArray[np.float64]:
        found: NDArray[np.float64] = np.asarray(np.interp(np.asarray(z, dtype=np.float64), depths, values))
        return found


def uniform(S_A: float, CT: float, depth: float) -> Stratification:
    """Water of one salinity [g/kg] and temperature [deg C] down to `depth` [m]."""
    return Stratification(np.array([0.0, depth]), np.full(2, S_A), np.full(2, CT), source="uniform")


def linear(S_A: tuple[float, float], CT: tuple[float, float], depth: float) -> Stratification:
    """Salinity and temperature that change linearly from the surface to `depth` [m]: (surface, depth) of each."""
    return Stratification(np.array([0.0, depth]), np.array(S_A), np.array(CT), source="linear")


def two_layer(
    S_A: tuple[float, float], CT: tuple[float, float], interface: float, thickness: float, depth: float
) -> Stratification:
    """Two layers, (upper, lower) of each; between them a hyperbolic tangent of scale `thickness` [m] about `interface`.

    Between its depths the stratification is linear; they lie so close that it keeps to the tangent within 0.1 % of the
    step.
    """
    near = interface + thickness * np.linspace(-5.0, 5.0, 161)
    depths = np.unique(np.concatenate([[0.0, depth], near[(near > 0.0) & (near < depth)]]))
    share = 0.5 * (1.0 + np.tanh((depths - interface) / thickness))
    return Stratification(
        depths, S_A[0] + share * (S_A[1] - S_A[0]), CT[0] + share * (CT[1] - CT[0]), source="two layers"
    )


def south_china_sea(depth: float, CT: float = 15.0, S_A: float = 35.0) -> Stratification:
    """Density of the South China Sea by its polynomial; its temperature and salinity are not given with it.

    Parameters
    ----------
    depth
        Depth down to which it is tabulated, every metre [m].
    CT, S_A
        Assumed, for what depends on temperature or salinity but not through density [deg C, g/kg].
    """
    z = np.arange(0.0, np.ceil(depth) + 1.0)
    rho = np.minimum(np.polynomial.polynomial.polyval(z, SOUTH_CHINA_SEA), SOUTH_CHINA_SEA_MOST)
    # the polynomial bends over below its greatest value: the density stays there
    rho = np.maximum.accumulate(rho)
    return Stratification(
        np.array([0.0, depth]), np.full(2, S_A), np.full(2, CT), 18.0, z, rho, "South China Sea polynomial"
    )
