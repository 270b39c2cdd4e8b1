"""States from a file, and their accelerations in words: for checking stommel against other codes."""

from collections.abc import Sequence
from math import degrees, isfinite, radians
from pathlib import Path
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, TypeAdapter, ValidationError

from stommel.dynamics.acceleration import accelerations, state_of
from stommel.dynamics.packing import pack, reference_water
from stommel.dynamics.state import Actuation
from stommel.errors import FileError, Problem, StommelError
from stommel.files.opening import TABLE_MIB, read_text
from stommel.files.ranges import Coordinate, between
from stommel.files.sentences import dotted, sentence
from stommel.geometry.attitude import euler_rates, quaternion_from_euler
from stommel.vehicle import Physics, Vehicle

Velocity = Annotated[float, between(-50, 50)]
AngularVelocity = Annotated[float, between(-100, 100)]
Angle = Annotated[float, between(-360, 360)]


class StateError(StommelError):
    """A state that this vehicle cannot be in."""


class StateEntry(BaseModel):
    """One state of a state file."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    velocity_m_s: tuple[Velocity, Velocity, Velocity]
    angular_velocity_rad_s: tuple[AngularVelocity, AngularVelocity, AngularVelocity]
    attitude_deg: tuple[Angle, Angle, Angle]
    moving_mass_position_m: Coordinate
    moving_mass_rate_m_s: Velocity = 0.0
    moving_mass_force_n: Annotated[float, between(-1e6, 1e6)] = 0.0
    ballast_volume_m3: Annotated[float, between(-0.1, 0.1)] = 0.0
    rudder_deg: Angle = 0.0
    roll_mass_deg: Angle = 0.0

    @property
    def lateral(self) -> bool:
        """Whether the state leaves the vertical plane."""
        _, v, _ = self.velocity_m_s
        p, _, r = self.angular_velocity_rad_s
        return any((v, p, r, self.attitude_deg[0], self.rudder_deg, self.roll_mass_deg))


def read_states(path: Path) -> list[StateEntry]:
    """Read a JSON list of states.

    Raises
    ------
    FileError
        The file cannot be read, or a state has an unknown, missing or impossible key.
    """
    text = read_text(path, TABLE_MIB)
    try:
        return TypeAdapter(list[StateEntry]).validate_json(text)
    except ValidationError as error:
        raise FileError([_problem(str(path), detail) for detail in error.errors(include_url=False)]) from None


def _problem(file: str, detail: Any) -> Problem:
    if detail["type"] == "json_invalid":
        return Problem(file, "", f"is not valid JSON: {detail['msg'].removeprefix('Invalid JSON: ')}")
    if len(detail["loc"]) < 2:
        return Problem(file, "", "must be a list of states, each an object in braces")
    return Problem(file, dotted(detail["loc"]), f"state {sentence(detail, StateEntry)}")


def accelerations_of(
    vehicle: Vehicle, states: Sequence[StateEntry], *, free: bool, physics: Physics
) -> list[dict[str, Any]]:
    """Accelerations in each of the `states` [SI, attitude rates in deg/s], in still reference water.

    Parameters
    ----------
    free
        The moving mass slides under its force; otherwise it keeps its rate.

    Raises
    ------
    LateralPlaneUnknownError
        A state leaves the vertical plane of a vehicle whose lateral coefficients are unknown.
    StateError
        A state uses an actuator that the vehicle lacks, or its numbers are too large for an answer.
    """
    record, water = pack(vehicle, physics), reference_water(vehicle)
    answers = []
    for k, entry in enumerate(states):
        if entry.lateral:
            vehicle.require_lateral(f"state {k}, which moves sideways,")
        if entry.rudder_deg and vehicle.description.rudder is None:
            raise StateError(f"state {k}: rudder_deg = {entry.rudder_deg:g}: {vehicle.name} has no rudder")
        if entry.roll_mass_deg and vehicle.description.moving_mass.offset_m == 0.0:
            raise StateError(f"state {k}: roll_mass_deg = {entry.roll_mass_deg:g}: moving_mass.offset_m is 0")
        roll, pitch, yaw = (radians(angle) for angle in entry.attitude_deg)
        actuation = Actuation(
            r_px_dot=entry.moving_mass_rate_m_s,
            u_px=entry.moving_mass_force_n,
            delta_r=radians(entry.rudder_deg),
            mu=radians(entry.roll_mass_deg),
        )
        x = state_of(
            record,
            entry.velocity_m_s,
            entry.angular_velocity_rad_s,
            (0.0, 0.0, 0.0),
            quaternion_from_euler(roll, pitch, yaw),
            entry.moving_mass_position_m,
            entry.ballast_volume_m3,
            actuation,
            water,
        )
        found = accelerations(record, x, actuation, water, free)
        if not all(map(isfinite, (*found.v_dot, *found.omega_dot, found.r_px_ddot, *found.X_dot))):
            raise StateError(f"state {k}: its numbers are too large: the accelerations overflow")
        rates = euler_rates(roll, pitch, entry.angular_velocity_rad_s)
        answers.append(
            {
                "acceleration_m_s2": list(found.v_dot),
                "angular_acceleration_rad_s2": list(found.omega_dot),
                "moving_mass_acceleration_m_s2": found.r_px_ddot,
                "inertial_velocity_m_s": list(found.X_dot),
                "attitude_rate_deg_s": [degrees(rate) for rate in rates] if rates is not None else None,
            }
        )
    return answers
