"""Trims with their modes by the hundred thousand, compiled: for maps, optimisation and studies."""

import numpy as np
from numpy.typing import NDArray

from stommel.analysis.linear_equations import linearise_into
from stommel.analysis.steady_equations import CONVERGED, QUANTITIES
from stommel.analysis.wings_level import trim_into
from stommel.compilation import compiled
from stommel.seawater.water import Water

Complexes = NDArray[np.complex128]


@compiled
def _fill(
    vehicle: np.record,
    speeds: np.ndarray,
    pitches: np.ndarray,
    water: Water,
    flights: np.ndarray,
    longitudinal: np.ndarray,
    lateral: np.ndarray,
    codes: np.ndarray,
) -> None:
    A, B = np.empty((8, 8)), np.empty((8, 4))
    block = np.empty((4, 4), dtype=np.complex128)
    for i in range(len(speeds)):
        codes[i] = trim_into(vehicle, speeds[i], pitches[i], False, water, flights[i])
        if codes[i] != CONVERGED:
            longitudinal[i], lateral[i] = np.nan, np.nan
            continue
        linearise_into(vehicle, flights[i], water, A, B)
        block[:] = A[:4, :4]
        longitudinal[i] = np.linalg.eigvals(block)
        block[:] = A[4:, 4:]
        lateral[i] = np.linalg.eigvals(block)


def trims_with_modes(
    vehicle: np.record, speeds: NDArray[np.float64], pitches: NDArray[np.float64], water: Water
) -> tuple[NDArray[np.float64], Complexes, Complexes, NDArray[np.int64]]:
    """Trim pairs of speed [m/s] and pitch [rad] and find the eigenvalues of both planes.

    Returns
    -------
    flights
        Ten quantities each, in the order of `stommel.analysis.steady_equations` (N x 10).
    longitudinal, lateral
        Eigenvalues [1/s] (N x 4); NaN where there is no flight.
    codes
        CONVERGED or why not (N).
    """
    n = len(speeds)
    flights, codes = np.zeros((n, QUANTITIES)), np.empty(n, dtype=np.int64)
    longitudinal, lateral = np.empty((n, 4), dtype=complex), np.empty((n, 4), dtype=complex)
    _fill(vehicle, speeds, pitches, water, flights, longitudinal, lateral, codes)
    return flights, longitudinal, lateral, codes
