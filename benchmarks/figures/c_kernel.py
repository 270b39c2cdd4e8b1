"""The C version of the equations of motion, built on the spot and called through ctypes."""

import ctypes
import shutil
import subprocess
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from stommel.dynamics.state import Actuation
from stommel.seawater.water import Water

ROOT = Path(__file__).resolve().parents[2]
SOURCE = ROOT / "benchmarks" / "c_reference" / "derivative.c"
LIBRARY = ROOT / "build" / "c_reference" / "derivative.so"
FLAGS = ("-O3", "-march=native", "-shared", "-fPIC")

_POINTER = ctypes.c_void_p


class NoCompilerError(Exception):
    """There is no gcc on this machine."""


class CKernel:
    """The library's functions with arrays for arguments."""

    def __init__(self, library: ctypes.CDLL) -> None:
        library.params_size.restype = ctypes.c_size_t
        library.derivative.argtypes = [_POINTER] * 4 + [ctypes.c_int, _POINTER]
        library.derivative.restype = None
        library.repeat.argtypes = [_POINTER] * 4 + [ctypes.c_int, _POINTER, ctypes.c_long]
        library.repeat.restype = ctypes.c_double
        self._library = library

    def derivative(
        self, vehicle: np.record, x: NDArray[np.float64], actuation: Actuation, water: Water, free: bool
    ) -> NDArray[np.float64]:
        """Rate of the flat state `x`."""
        out = np.empty_like(x)
        p, u, w = self._inputs(vehicle, actuation, water)
        self._library.derivative(p, x.ctypes.data, u.ctypes.data, w.ctypes.data, free, out.ctypes.data)
        return out

    def repeat(
        self, vehicle: np.record, x: NDArray[np.float64], actuation: Actuation, water: Water, free: bool, n: int
    ) -> float:
        """Evaluate `n` times, each evaluation waiting for the last; changes `x`."""
        out = np.empty_like(x)
        p, u, w = self._inputs(vehicle, actuation, water)
        last: float = self._library.repeat(p, x.ctypes.data, u.ctypes.data, w.ctypes.data, free, out.ctypes.data, n)
        return last

    def _inputs(
        self, vehicle: np.record, actuation: Actuation, water: Water
    ) -> tuple[bytes, NDArray[np.float64], NDArray[np.float64]]:
        parameters = vehicle.tobytes()
        if len(parameters) != self._library.params_size():
            raise ValueError("VEHICLE_RECORD and `params` of derivative.c differ: change the C file with the record")
        return parameters, np.array(actuation), np.hstack(water)


@cache
def c_kernel() -> CKernel:
    """Build and load the library.

    Raises
    ------
    NoCompilerError
        There is no gcc.
    """
    compiler = shutil.which("gcc")
    if compiler is None:
        raise NoCompilerError("gcc is not installed")
    LIBRARY.parent.mkdir(parents=True, exist_ok=True)
    subprocess.run([compiler, *FLAGS, "-o", LIBRARY, SOURCE, "-lm"], check=True)
    return CKernel(ctypes.CDLL(str(LIBRARY)))


def compiler_version() -> str:
    """First line of `gcc --version`."""
    printed = subprocess.run(["gcc", "--version"], capture_output=True, text=True, check=True).stdout
    return printed.splitlines()[0]
