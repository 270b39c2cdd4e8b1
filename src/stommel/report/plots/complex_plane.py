"""The plane of eigenvalues: imaginary axis, the unstable half, and names of modes beside their eigenvalues."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from stommel.analysis import Mode
from stommel.figures.style import INK, MUTED

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Eigenvalues = NDArray[np.complex128]
UNSTABLE = "#fbeee6"


def prepare(axes: "Axes", shown: Eigenvalues) -> None:
    """Set limits that hold all of `shown`, draw the imaginary axis and shade the unstable half."""
    real, imag = shown.real, shown.imag
    left, right = min(real.min(), 0.0), max(real.max(), 0.0)
    width = (right - left) or 1.0
    height = max(float(np.abs(imag).max()), 0.25 * width)
    axes.set_xlim(left - 0.14 * width, right + 0.17 * width)
    axes.set_ylim(-1.28 * height, 1.28 * height)
    axes.axvspan(0.0, right + 0.17 * width, color=UNSTABLE, linewidth=0, zorder=0, gid="unstable-half")
    axes.axvline(0.0, color=INK, linewidth=1.2, zorder=1.5, gid="imaginary-axis")
    axes.axhline(0.0, color=MUTED, linewidth=0.7, zorder=1.4)
    axes.set_xlabel("Real part [1/s]")
    axes.set_ylabel("Imaginary part [rad/s]")
    axes.text(0.993, 0.02, "unstable", transform=axes.transAxes, ha="right", fontsize=8, color="#a4552b", rotation=90)


def write_names(axes: "Axes", modes: Sequence[Mode]) -> None:
    """Write the name of each mode beside its eigenvalue: pairs once, real modes staggered above the real axis."""
    for mode in modes:
        if mode.oscillatory and mode.eigenvalue.imag > 0.0:
            _write_name(axes, mode, raised=11.0, leader=False)
    real = sorted((mode for mode in modes if not mode.oscillatory), key=lambda mode: mode.eigenvalue.real)
    for k, mode in enumerate(real):
        _write_name(axes, mode, raised=16.0 + 15.0 * ((len(real) - 1 - k) % 3), leader=True)


def _write_name(axes: "Axes", mode: Mode, raised: float, leader: bool) -> None:
    """Write one name, away from the nearer edge of the axes."""
    low, high = axes.get_xlim()
    share = (mode.eigenvalue.real - low) / (high - low)
    align, shift = ("left", -8.0) if share < 0.25 else ("right", 8.0) if share > 0.7 else ("center", 0.0)
    foot = {"left": 0.15, "center": 0.5, "right": 0.85}[align]
    arrow = {"arrowstyle": "-", "color": MUTED, "linewidth": 0.6, "shrinkB": 4.0, "shrinkA": 0.0}
    axes.annotate(
        mode.name, (mode.eigenvalue.real, mode.eigenvalue.imag), xytext=(shift, raised), textcoords="offset points",
        ha=align, va="bottom", fontsize=8.6, color=INK, arrowprops={**arrow, "relpos": (foot, 0.0)} if leader else None,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6, "alpha": 0.85},
    )  # fmt: skip


def nearest_mode(eigenvalue: complex, modes: Sequence[Mode]) -> Mode:
    """Mode whose eigenvalue is nearest."""
    return min(modes, key=lambda mode: abs(mode.eigenvalue - eigenvalue))
