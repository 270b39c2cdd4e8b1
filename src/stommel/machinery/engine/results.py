"""What a run of a buoyancy engine gives: outcome, energies and courses over time."""

from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SAMPLES = 121
"""Of each course, in words."""


class Outcome(StrEnum):
    """How a phase ended."""

    REACHED = "reached"
    """The sensor read the wanted position."""
    MOTOR_STALLED = "motor stalled"
    """The load stopped the motor: voltage or current do not suffice."""
    NO_FLOW = "no flow"
    """Motor or valve work, but no oil moves: leakage takes the pump's flow, or friction holds the piston."""
    END_STOP = "end stop"
    """A piston reached its mechanical end before the wanted position."""

    @property
    def stalled(self) -> bool:
        """The pressure was too much, or for a deflation too little."""
        return self in (Outcome.MOTOR_STALLED, Outcome.NO_FLOW)


@dataclass(frozen=True)
class PhaseResult:
    """One phase: inflate, hold or deflate."""

    name: str
    outcome: Outcome
    begin_s: float
    duration_s: float
    moved_m3: float
    """Oil into the bladder, as its volume without pressure [m3]; negative when deflating."""
    piston_m: tuple[float, float]
    """Position of the measured piston, before and after [m]."""
    energy_j: float
    """From the supply [J]."""
    losses_j: dict[str, float]
    """By cause [J]."""
    sea_work_j: float
    """Work against the pressure of the sea [J]; negative when deflating."""
    hull_gas_work_j: float
    """Work on the gas in the hull [J]."""
    stored_j: float
    """Gain of energy in rotor, oil, bladder, accumulators and pistons [J]."""
    peak_current_a: float
    """Greatest current of the motor's windings [A]."""
    peak_supply_current_a: float
    """Greatest current from the supply [A]."""
    volumetric_efficiency: float | None
    """Volume of the piston's travel over what the motor would move without leakage; None if it did not turn."""

    @property
    def efficiency(self) -> float:
        """Useful over total work, eta = P S l / (U I t) of section 5.1.2; zero without sea pressure."""
        return self.sea_work_j / self.energy_j if self.energy_j > 0.0 and self.sea_work_j > 0.0 else 0.0

    @property
    def energy_per_mm(self) -> float | None:
        """K = U I t / l of section 5.1.2 [J/mm]; None if the piston did not move."""
        travel = abs(self.piston_m[1] - self.piston_m[0]) * 1e3
        return self.energy_j / travel if travel > 0.0 else None

    @property
    def energy_residual(self) -> float:
        """What the balance of the phase leaves over, relative to the largest of its terms."""
        used = sum(self.losses_j.values()) + self.sea_work_j + self.hull_gas_work_j + self.stored_j
        scale = max(abs(self.energy_j), abs(self.sea_work_j), *map(abs, self.losses_j.values()))
        return abs(self.energy_j - used) / scale if scale > 0.0 else 0.0

    def as_row(self) -> dict[str, Any]:
        """The phase in words with units."""
        return {
            "outcome": self.outcome.value,
            "duration_s": self.duration_s,
            "volume_ml": self.moved_m3 * 1e6,
            "energy_j": self.energy_j,
            "peak_current_a": self.peak_current_a,
            "peak_supply_current_a": self.peak_supply_current_a,
            "pump_efficiency": self.efficiency,
            "volumetric_efficiency": self.volumetric_efficiency,
            "energy_per_mm_j": self.energy_per_mm,
            "piston_begin_mm": self.piston_m[0] * 1e3,
            "piston_end_mm": self.piston_m[1] * 1e3,
            "sea_work_j": self.sea_work_j,
            "hull_gas_work_j": self.hull_gas_work_j,
            "stored_j": self.stored_j,
            "losses_j": self.losses_j,
            "energy_residual": self.energy_residual,
        }


@dataclass(frozen=True)
class Courses:
    """Quantities over time; all arrays have the length of `t_s`."""

    t_s: Array
    piston_mm: Array
    """Position of the measured piston."""
    bladder_ml: Array
    """Oil in the bladder above that at the beginning."""
    flow_ml_s: Array
    """Oil into the bladder."""
    motor_rpm: Array
    current_a: Array
    """Of the motor's windings."""
    voltage_v: Array
    """At the windings."""
    power_w: Array
    """From the supply."""
    pressure_mpa: dict[str, Array]
    """By node [MPa, gauge]."""

    def sampled(self, count: int) -> dict[str, list[float]]:
        """Courses at `count` equal intervals of time, by name."""
        t = np.linspace(self.t_s[0], self.t_s[-1], count)
        names = ("piston_mm", "bladder_ml", "flow_ml_s", "motor_rpm", "current_a", "voltage_v", "power_w")
        found = {name: np.interp(t, self.t_s, getattr(self, name)) for name in names}
        return {"t_s": t.tolist()} | {name: values.tolist() for name, values in found.items()}


@dataclass(frozen=True)
class EngineRun:
    """A simulated cycle of the buoyancy engine."""

    name: str
    pressure_pa: float
    ideal: bool
    phases: tuple[PhaseResult, ...]
    events: tuple[tuple[float, str], ...]
    """Instant [s] and name of everything that switched."""
    courses: Courses
    oil_residual: float
    """Change of all oil over the run, relative to the oil that was asked for."""
    lowest_pressure_pa: float
    """Lowest gauge pressure in any node: oil boils near -0.1 MPa."""

    @property
    def stalled(self) -> bool:
        """A phase could not move the oil."""
        return any(phase.outcome.stalled for phase in self.phases)

    def phase(self, name: str) -> PhaseResult | None:
        """The phase of this name, None if there was none."""
        return next((phase for phase in self.phases if phase.name == name), None)

    def as_json(self) -> dict[str, Any]:
        """The run in words with units: the first phase at the top, all phases in a list."""
        return {
            "engine": self.name,
            "pressure_mpa": self.pressure_pa / 1e6,
            "ideal": self.ideal,
            **self.phases[0].as_row(),
            "stalled": self.stalled,
            "oil_residual": self.oil_residual,
            "lowest_pressure_mpa": self.lowest_pressure_pa / 1e6,
            "phases": [{"phase": phase.name, **phase.as_row()} for phase in self.phases],
            "events": [{"t_s": t, "event": name} for t, name in self.events],
            "courses": self.courses.sampled(SAMPLES),
        }
