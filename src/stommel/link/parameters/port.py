"""Parameters of a vehicle, as the link sees them."""

from collections.abc import Sequence
from enum import IntEnum
from typing import NamedTuple, Protocol

COORDINATOR_COMPONENT = 1
"""MAV_COMP_ID_AUTOPILOT1."""
MOTION_COMPONENT, ACQUISITION_COMPONENT = 25, 26
"""MAV_COMP_ID_USER1 and USER2: a node that is dead marks only its own parameters."""

Value = float | int


class ParameterKind(IntEnum):
    """Types of parameters, by MAV_PARAM_TYPE; a truth is 0 or 1."""

    UINT8 = 1
    INT32 = 6
    FLOAT32 = 9


class ParameterState(IntEnum):
    """Whether the parameters of a component are known, by GLIDER_PARAMETER_STATE."""

    KNOWN = 0
    SILENT = 1
    BEING_READ = 2


class WriteError(IntEnum):
    """Why a value was not taken, by MAV_PARAM_ERROR."""

    NONE = 0
    DOES_NOT_EXIST = 1
    OUT_OF_RANGE = 2
    DENIED = 3
    SILENT = 4
    READ_ONLY = 5


class Description(NamedTuple):
    """What a parameter is."""

    id: str
    """Up to 16 capital letters, digits and underscores; each once in its component."""
    kind: ParameterKind
    default: Value
    low: Value
    high: Value
    unit: str = ""
    words: str = ""


class ParameterSet(NamedTuple):
    """Parameters of one component."""

    component: int
    name: str
    """Of the component, in words."""
    state: ParameterState
    descriptions: tuple[Description, ...]
    values: tuple[Value | None, ...]
    """In the order of the descriptions; None for what is not known."""

    @property
    def is_silent(self) -> bool:
        """Whether the component does not answer."""
        return self.state is ParameterState.SILENT

    @property
    def is_being_read(self) -> bool:
        """Whether some of its values will be known soon."""
        return self.state is not ParameterState.SILENT and (
            self.state is ParameterState.BEING_READ or None in self.values
        )

    def number(self, parameter: str) -> int | None:
        """Return the number of a parameter; None if there is none of this name."""
        return next((number for number, each in enumerate(self.descriptions) if each.id == parameter), None)


class WriteOutcome(NamedTuple):
    """What became of a value that was to be set."""

    ticket: int
    """What `write` returned."""
    error: WriteError
    value: Value | None
    """That holds now."""
    words: str = ""
    """Why it was refused, and what is allowed."""


class ParameterPort(Protocol):
    """Where parameters are kept."""

    def sets(self) -> Sequence[ParameterSet]:
        """All parameters as they are known now: of each component, each component once, always in the same order."""

    def write(self, component: int, parameter: str, value: Value) -> int:
        """Begin to set a parameter to a value within its limits; return a ticket by which `outcomes` names it."""

    def outcomes(self) -> list[WriteOutcome]:
        """What became of writings, since this was last asked; every one ends."""
