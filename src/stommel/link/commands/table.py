"""What a glider can be told: one table, which terminal, shore station and guide use."""

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from stommel.errors import StommelError

PARAMETERS = 4
"""That a command can carry."""


class CommandError(StommelError):
    """A command that nobody knows, or with a parameter that is not allowed."""


class Parameter(NamedTuple):
    """A number that a command carries."""

    name: str
    unit: str
    low: float
    high: float
    words: str
    whole: bool = False
    """Whether it is a whole number."""

    @property
    def allowed(self) -> str:
        """Range, in words."""
        kind = "a whole number" if self.whole else "a number"
        return f"{kind} from {self.low:.12g} to {self.high:.12g}{f' {self.unit}' if self.unit else ''}"


class CommandType(NamedTuple):
    """A command."""

    number: int
    name: str
    words: str
    """What the vehicle does."""
    parameters: tuple[Parameter, ...] = ()
    confirm: str = ""
    """What may go wrong: a terminal says it and asks before it gives the command; empty where nothing may."""


ABORT = 47000
START, HOLD, SURFACE, RECALL = 47001, 47002, 47003, 47004
CLEAR, CHECK, SELF_TEST = 47005, 47006, 47007
SWITCH_MISSION, ROLL_BACK_MISSION = 47008, 47009
RADIO_TIME, RESTART = 47010, 47011

_MISSION = Parameter(
    "mission", "", 0, 2**32 - 1, "number of the mission that was uploaded; 0 for whichever it is", whole=True
)
_RADIO_TIME = Parameter("time", "s", 60.0, 86_400.0, "stay at the surface for position and radio")

COMMANDS = (
    CommandType(
        ABORT, "abort", "last reaction: greatest ballast, nose up, and calling at the surface; the mission is over",
        confirm="the mission ends, and the vehicle drifts at the surface until it is cleared and started again",
    ),
    CommandType(
        START, "start", "fly the mission, as soon as nothing forbids it",
        confirm="the vehicle dives by itself once its start checks have passed",
    ),
    CommandType(HOLD, "hold", "stay at the surface from the next surfacing on"),
    CommandType(SURFACE, "surface", "end this dive and come up; the mission goes on from there"),
    CommandType(RECALL, "recall", "end this dive, come up, and stay at the surface"),
    CommandType(
        CLEAR, "clear", "alarms whose cause is gone are over, and an abort with them",
        confirm="a vehicle that was aborted may dive again",
    ),
    CommandType(CHECK, "check", "do the start checks again"),
    CommandType(
        SELF_TEST, "self-test", "move each drive a little, and see that it follows",
        confirm="pump, moving mass and rudder move; nobody may have a hand in them",
    ),
    CommandType(
        SWITCH_MISSION, "switch-mission", "fly the mission that was uploaded in place of the one that is held",
        (_MISSION,), "the next dive is another one",
    ),
    CommandType(
        ROLL_BACK_MISSION, "roll-back-mission", "fly the mission before the present one again",
        confirm="the next dive is another one",
    ),
    CommandType(RADIO_TIME, "radio-time", "how long to stay at the surface after each dive", (_RADIO_TIME,)),
    CommandType(
        RESTART, "restart", "start the coordination software anew",
        confirm="for some seconds nobody decides, and the nodes do what they do alone",
    ),
)  # fmt: skip
"""Every command of our own, by number."""

_BY_NUMBER = {row.number: row for row in COMMANDS}
_BY_NAME = {row.name: row for row in COMMANDS}


def command_numbered(number: int) -> CommandType | None:
    """Return the command of a number; None if there is none."""
    return _BY_NUMBER.get(number)


def command_named(name: str) -> CommandType:
    """Return the command of a name.

    Raises
    ------
    CommandError
        There is none.
    """
    if name not in _BY_NAME:
        raise CommandError(f"command {name!r}: there is none; known are {', '.join(_BY_NAME)}")
    return _BY_NAME[name]


def packed(kind: CommandType, values: Mapping[str, float]) -> tuple[float, ...]:
    """Return parameters by name in the order in which they are sent.

    Raises
    ------
    CommandError
        One is missing, unknown, or out of its range.
    """
    names = [parameter.name for parameter in kind.parameters]
    if unknown := sorted(set(values) - set(names)):
        raise CommandError(f"{kind.name}: has no parameter {unknown[0]!r}; it has {', '.join(names) or 'none'}")
    if missing := [name for name in names if name not in values]:
        raise CommandError(f"{kind.name}.{missing[0]}: is missing")
    found = tuple(float(values[name]) for name in names)
    if problem := refusal(kind, found):
        raise CommandError(problem)
    return found + (0.0,) * (PARAMETERS - len(found))


def refusal(kind: CommandType, values: Sequence[float]) -> str:
    """Say what is wrong with the parameters of a command; empty if nothing is."""
    for parameter, value in zip(kind.parameters, values, strict=False):
        in_range = parameter.low <= value <= parameter.high
        if not in_range or (parameter.whole and not float(value).is_integer()):
            return f"{kind.name}.{parameter.name} is {value:g}; must be {parameter.allowed}"
    if any(value != 0.0 or not math.isfinite(value) for value in values[len(kind.parameters) :]):
        return f"{kind.name}: has {len(kind.parameters)} parameters; those behind must be 0"
    return ""
