"""Layered water by formulas; oracle: water that lies still is nowhere lighter below than above."""

import numpy as np

from stommel.seawater.stratification import SOUTH_CHINA_SEA, SOUTH_CHINA_SEA_MOST, south_china_sea


def test_south_china_sea_never_grows_lighter_downwards() -> None:
    """The polynomial as printed, up to where it bends over; from there on its greatest value."""
    water, z = south_china_sea(3000.0), np.arange(0.0, 3001.0)
    rho = water.density(z)
    printed = np.polynomial.polynomial.polyval(z, SOUTH_CHINA_SEA)
    assert (np.diff(rho) >= 0.0).all()
    turn = int(np.argmax(np.minimum(printed, SOUTH_CHINA_SEA_MOST)))
    np.testing.assert_allclose(rho[:turn], np.maximum.accumulate(printed[:turn]), rtol=1e-12)
    assert (rho[turn:] == rho[turn]).all()
