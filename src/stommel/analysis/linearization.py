"""Linear models of small motions about a steady flight, ready for python-control."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from stommel.analysis.flight import SteadyFlight
from stommel.analysis.linear_equations import INPUTS, LATERAL, LONGITUDINAL, STATES, linearise_into
from stommel.dynamics.packing import pack, reference_water
from stommel.seawater.water import Water
from stommel.vehicle import PAPER, Physics, Vehicle

if TYPE_CHECKING:
    import control

Matrix = NDArray[np.float64]


@dataclass(frozen=True)
class LinearModel:
    """x' = A x + B u about a steady flight; SI units and radians."""

    A: Matrix
    B: Matrix
    states: tuple[str, ...]
    inputs: tuple[str, ...]

    def to_control(self) -> "control.StateSpace":
        """Return the model as a python-control state space whose outputs are the states."""
        import control  # noqa: PLC0415 - heavy, and only wanted here

        n, m = self.B.shape
        return control.StateSpace(
            self.A,
            self.B,
            np.eye(n),
            np.zeros((n, m)),
            states=list(self.states),
            inputs=list(self.inputs),
            outputs=list(self.states),
        )

    def eigenvalues(self) -> NDArray[np.complex128]:
        """Eigenvalues of A [1/s]."""
        return np.linalg.eigvals(self.A).astype(complex)


@dataclass(frozen=True)
class Linearization:
    """Small motions about a flight: the whole, and the two planes that separate when the wings are level."""

    flight: SteadyFlight
    whole: LinearModel
    longitudinal: LinearModel
    """States (u, w, q, theta), inputs (r_px, V_b)."""
    lateral: LinearModel | None
    """States (v, p, r, phi), inputs (delta_r, mu); None where the vehicle's lateral coefficients are unknown."""

    @property
    def coupling(self) -> float:
        """Largest entry of A that couples the two planes; zero with wings level."""
        A = self.whole.A
        return float(max(np.abs(A[LONGITUDINAL, LATERAL]).max(), np.abs(A[LATERAL, LONGITUDINAL]).max()))

    def as_row(self) -> dict[str, object]:
        """Matrices of the planes that are known, and the names of their states and inputs."""
        planes = {"longitudinal": self.longitudinal} | ({} if self.lateral is None else {"lateral": self.lateral})
        return {
            "A": {plane: model.A.tolist() for plane, model in planes.items()},
            "B": {plane: model.B.tolist() for plane, model in planes.items()},
            "states": {plane: list(model.states) for plane, model in planes.items()},
            "inputs": {plane: list(model.inputs) for plane, model in planes.items()},
        }


def is_stable(vehicle: Vehicle, flight: SteadyFlight, *, physics: Physics = PAPER) -> bool:
    """Whether small disturbances of `flight` die out; in the vertical plane alone where the lateral one is unknown."""
    linear = linearise(vehicle, flight, physics=physics)
    model = linear.whole if linear.lateral is not None else linear.longitudinal
    return bool(np.max(model.eigenvalues().real) < 0.0)


def linearise(
    vehicle: Vehicle, flight: SteadyFlight, *, physics: Physics = PAPER, water: Water | None = None
) -> Linearization:
    """Linearise the equations of motion about `flight` with fixed actuators (section 3.2 of the paper).

    Derivatives are exact (complex step). In a turn the planes couple; `whole` then holds all eight states.
    """
    A, B = np.empty((8, 8)), np.empty((8, 4))
    linearise_into(pack(vehicle, physics), flight.quantities(), water or reference_water(vehicle), A, B)
    lateral_known = not list(vehicle.description.unknown_lateral())
    return Linearization(
        flight=flight,
        whole=LinearModel(A, B, STATES, INPUTS),
        longitudinal=LinearModel(A[LONGITUDINAL, LONGITUDINAL], B[LONGITUDINAL, :2], STATES[:4], INPUTS[:2]),
        lateral=LinearModel(A[LATERAL, LATERAL], B[LATERAL, 2:], STATES[4:], INPUTS[2:]) if lateral_known else None,
    )
