"""Natural modes of a glider: eigenvalues with names, frequency, damping and times a pilot can feel."""

from collections.abc import Callable
from dataclasses import dataclass
from math import inf, log, pi

import numpy as np
from numpy.typing import NDArray

from stommel.analysis.linearization import Linearization, LinearModel

_OSCILLATES = 1e-9
"""Imaginary part over modulus, above which a mode counts as an oscillation."""


@dataclass(frozen=True)
class Mode:
    """One natural mode: a real eigenvalue, or one half of a conjugate pair [1/s]."""

    name: str
    eigenvalue: complex
    participation: dict[str, float]
    """Share of each state in the mode; the shares sum to one."""

    @property
    def stable(self) -> bool:
        """Whether the mode dies out."""
        return self.eigenvalue.real < 0.0

    @property
    def oscillatory(self) -> bool:
        """Whether the mode swings."""
        return abs(self.eigenvalue.imag) > _OSCILLATES * abs(self.eigenvalue)

    @property
    def natural_frequency(self) -> float:
        """Modulus of the eigenvalue [rad/s]."""
        return abs(self.eigenvalue)

    @property
    def damping_ratio(self) -> float:
        """-Re / |eigenvalue|; 1 for a stable real mode."""
        modulus = abs(self.eigenvalue)
        return -self.eigenvalue.real / modulus if modulus > 0.0 else 0.0

    @property
    def period(self) -> float:
        """Time of a full swing [s]; infinite for a real mode."""
        return 2 * pi / abs(self.eigenvalue.imag) if self.oscillatory else inf

    @property
    def time_constant(self) -> float:
        """1 / |Re| [s]: decay, or growth if unstable, by e."""
        return 1.0 / abs(self.eigenvalue.real) if self.eigenvalue.real != 0.0 else inf

    @property
    def time_to_half(self) -> float:
        """Time to half amplitude [s]; negative means time to double."""
        return -log(2.0) / self.eigenvalue.real if self.eigenvalue.real != 0.0 else inf

    def as_row(self) -> dict[str, object]:
        """The mode in words with units, an entry of `stommel modes --json`; null for an infinite time."""

        def finite(value: float) -> float | None:
            return value if abs(value) != inf else None

        return {
            "real": self.eigenvalue.real,
            "imag": self.eigenvalue.imag,
            "name": self.name,
            "stable": self.stable,
            "natural_frequency_rad_s": self.natural_frequency,
            "damping_ratio": self.damping_ratio,
            "period_s": finite(self.period),
            "time_constant_s": finite(self.time_constant),
            "time_to_half_s": finite(self.time_to_half),
            "participation": self.participation,
        }


@dataclass(frozen=True)
class Modes:
    """Modes of both planes, fastest first."""

    longitudinal: tuple[Mode, ...]
    lateral: tuple[Mode, ...] | None
    """None where the vehicle's lateral coefficients are unknown."""

    @property
    def stable(self) -> bool:
        """Whether every known mode dies out."""
        return all(mode.stable for mode in (*self.longitudinal, *(self.lateral or ())))

    def as_row(self) -> dict[str, object]:
        """The modes of each plane in words with units."""
        return {
            "longitudinal": [mode.as_row() for mode in self.longitudinal],
            "lateral": [mode.as_row() for mode in self.lateral] if self.lateral is not None else None,
        }


def modes(linear: Linearization) -> Modes:
    """Name the modes of a linearised flight, plane by plane."""
    return Modes(
        longitudinal=_plane(linear.longitudinal, _longitudinal_name),
        lateral=_plane(linear.lateral, _lateral_name) if linear.lateral is not None else None,
    )


def _plane(model: LinearModel, name: Callable[[Mode, list[Mode]], str]) -> tuple[Mode, ...]:
    values, right = np.linalg.eig(model.A)
    shares = _participation(right)
    order = sorted(range(len(values)), key=lambda k: (-abs(values[k]), -values[k].imag))
    found = [Mode("", complex(values[k]), {s: float(shares[k, i]) for i, s in enumerate(model.states)}) for k in order]
    return tuple(Mode(name(mode, found), mode.eigenvalue, mode.participation) for mode in found)


def _participation(right: NDArray[np.complex128]) -> NDArray[np.float64]:
    """Share of each state (columns) in each mode (rows): left times right eigenvector, normalised."""
    left = np.linalg.inv(right)
    shares: NDArray[np.float64] = np.abs(left * right.T)
    shares /= shares.sum(axis=1, keepdims=True)
    return shares


def _longitudinal_name(mode: Mode, plane: list[Mode]) -> str:
    """Oscillations led by speed are phugoid-like, others short period; real modes are named by their leading state."""
    share = mode.participation
    if mode.oscillatory:
        if share["u"] > max(share["w"], share["q"], share["theta"]):
            return "phugoid-like"
        pairs = sorted({abs(other.eigenvalue) for other in plane if other.oscillatory})
        slower_of_two = len(pairs) > 1 and abs(mode.eigenvalue) < pairs[-1] * (1 - 1e-9)
        return "slow pitch oscillation" if slower_of_two else "short period"
    leader = max(share, key=lambda state: share[state])
    word = {"u": "surge", "w": "heave", "q": "pitch", "theta": "pitch"}[leader]
    return f"{word} {_fate(mode)}"


def _lateral_name(mode: Mode, plane: list[Mode]) -> str:
    """Oscillations led by roll are the keel's pendulum, others Dutch roll; the slowest real mode is the spiral."""
    share = mode.participation
    if mode.oscillatory:
        return "roll oscillation" if share["p"] + share["phi"] > share["v"] + share["r"] else "Dutch roll"
    if mode is min((other for other in plane if not other.oscillatory), key=lambda other: abs(other.eigenvalue)):
        return "spiral" if mode.stable else "spiral divergence"
    leader = max(share, key=lambda state: share[state])
    word = {"v": "sideslip", "p": "roll", "r": "yaw", "phi": "roll"}[leader]
    return f"{word} {_fate(mode)}"


def _fate(mode: Mode) -> str:
    return "subsidence" if mode.stable else "divergence"
