"""The circuit as numbers: nodes, pumps, passages and pistons in the form that compiled code reads.

Ports that share a node share its effort (pressure, torque, force); the flows into a node fill its storage. Shafts and
rods are rigid, so that all of them move with the motor: one speed omega stands for the whole train.
"""

from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import NDArray

OIL, BLADDER, ACCUMULATOR = range(3)
"""What gives a node its pressure."""

LINE, CHECK_VALVE, SOLENOID_VALVE = range(3)
"""Kinds of passages between two nodes."""

LOCKED, RAMP, HOLD, LIMITED, BRAKE = range(5)
"""What the motor does: rests, follows its ramp, holds its speed, gives all it can, returns to rest."""

STUCK, INWARDS, OUTWARDS = 0, -1, 1
"""What a piston does; outwards its chamber grows."""

LEDGER = (
    "supply", "driver", "windings", "motor_friction", "transmission", "pump_friction", "pump_leakage", "lines",
    "check_valves", "solenoid_valves", "piston_friction", "valve_coils", "hull_gas", "sea",
)  # fmt: skip
"""Energies that a run adds up: what the supply gives, where it is lost, and the work on hull gas and sea [J]."""
(
    SUPPLY, DRIVER, WINDINGS, MOTOR_FRICTION, TRANSMISSION, PUMP_FRICTION, PUMP_LEAKAGE, LINES,
    CHECK_VALVES, SOLENOID_VALVES, PISTON_FRICTION, VALVE_COILS, HULL_GAS, SEA,
) = range(len(LEDGER))  # fmt: skip
LOSSES = LEDGER[DRIVER:HULL_GAS]

NODE = np.dtype(
    [
        ("kind", "i8"),
        ("volume", "f8"),  # oil at zero pressure besides that in cylinders [m3]
        ("K", "f8"),  # bulk modulus [Pa]
        ("stiffness", "f8"),  # bladder: pressure per volume [Pa/m3]
        ("precharge", "f8"),  # accumulator: absolute pressure of the gas without oil [Pa]
        ("gas_volume", "f8"),  # accumulator [m3]
        ("exponent", "f8"),  # accumulator
    ]
)
PUMP = np.dtype(
    [
        ("inlet", "i8"),
        ("outlet", "i8"),
        ("ratio", "f8"),  # speed of its shaft per speed of the motor
        ("efficiency", "f8"),  # of the train between motor and shaft
        ("D", "f8"),  # displacement [m3/rad]
        ("k_l", "f8"),  # leakage [m3/(s Pa)]
        ("friction", "f8"),  # constant [N m]
        ("share", "f8"),  # proportional to pressure
        ("damping", "f8"),  # proportional to speed [N m s]
    ]
)
PASSAGE = np.dtype(
    [
        ("kind", "i8"),
        ("a", "i8"),
        ("b", "i8"),
        ("R", "f8"),  # laminar [Pa s/m3]
        ("kappa", "f8"),  # turbulent [Pa s2/m6]
        ("cracking", "f8"),  # [Pa]
        ("coil", "f8"),  # [W]
    ]
)
PISTON = np.dtype(
    [
        ("node", "i8"),
        ("driven", "i8"),
        ("ratio", "f8"),  # driven: inward velocity per speed of the motor [m/rad]
        ("efficiency", "f8"),  # driven: of the train between motor and rod
        ("S", "f8"),  # [m2]
        ("mass", "f8"),  # free: [kg]
        ("coulomb", "f8"),  # [N]
        ("stribeck", "f8"),  # [N]
        ("v_s", "f8"),  # [m/s]
        ("viscous", "f8"),  # [N s/m]
        ("gas", "f8"),  # [Pa]
        ("stroke", "f8"),  # [m]
    ]
)
DRIVE = np.dtype(
    [
        ("k_t", "f8"),  # [N m/A]
        ("R", "f8"),  # [ohm]
        ("I_0", "f8"),  # [A]
        ("J", "f8"),  # rotor inertia [kg m2]
        ("U", "f8"),  # supply [V]
        ("I_max", "f8"),  # [A]
        ("efficiency", "f8"),  # of the driver
        ("q_rad", "f8"),  # oil moved per radian of the motor without leakage [m3]
        ("pressure", "f8"),  # of the sea [Pa]
        ("mode", "i8"),
        ("s", "i8"),  # direction of rotation
        ("omega", "f8"),  # speed to hold, positive [rad/s]
        ("rate", "f8"),  # of the ramps, positive [rad/s2]
        ("measured", "i8"),  # piston that the sensor measures
        ("target", "f8"),  # its position at which the phase ends [m]
        ("towards", "i8"),  # direction in which it gets there; 0: no target
        ("lead", "i8"),  # 1: stop early by what the ramp to rest will move
    ]
)

Records = NDArray[np.void]


@dataclass
class Network:
    """A circuit ready to be simulated; `drive`, `opened` and `moving` change while it runs."""

    nodes: Records
    pumps: Records
    passages: Records
    pistons: Records
    drive: Records
    """One record: motor, controller and sea."""
    opened: NDArray[np.int64]
    """Whether each passage lets oil through."""
    moving: NDArray[np.int64]
    """What each piston does."""
    node_names: tuple[str, ...]
    passage_names: tuple[str, ...]
    piston_names: tuple[str, ...]
    bladder: int
    """Node of the bladder."""

    @property
    def size(self) -> int:
        """Number of states: omega, stocks of the nodes, positions and velocities of the pistons, the ledger."""
        return 1 + len(self.nodes) + 2 * len(self.pistons) + len(LEDGER)

    @property
    def events(self) -> int:
        """Number of event functions."""
        return 3 + len(self.passages) + 2 * len(self.pistons) + len(self.nodes)

    @property
    def first_position(self) -> int:
        """Index of the first piston's position among the states."""
        return 1 + len(self.nodes)

    @property
    def first_velocity(self) -> int:
        """Index of the first piston's velocity among the states."""
        return self.first_position + len(self.pistons)

    @property
    def first_entry(self) -> int:
        """Index of the ledger's first entry among the states."""
        return self.first_velocity + len(self.pistons)


def rad_s(rpm: float) -> float:
    """Revolutions per minute in radians per second."""
    return rpm * pi / 30.0
