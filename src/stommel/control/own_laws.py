"""The vehicle's own decision with some of its laws replaced."""

from collections.abc import Callable
from types import FunctionType
from typing import Any

import numpy as np

from stommel.control import decision
from stommel.control.commands import Commands
from stommel.control.orders import Orders
from stommel.control.readings import Readings
from stommel.errors import StommelError

LAWS = (
    "course_to_steer", "drift_correction", "guide", "next_dive_state", "pitch_correction", "reckon", "steering_command",
    "wanted_ballast", "wanted_pitch", "watch",
)  # fmt: skip
"""Functions that may be replaced, each by one of the same signature."""


class UnknownLawError(StommelError):
    """There is no law of this name."""


def with_laws(**laws: Callable[..., Any]) -> Callable[[np.record, Orders, Readings, float], Commands]:
    """Return `stommel.control.decision.decide` with other laws in place of its own, as plain Python.

    Examples
    --------
    >>> def bang_bang(law, previous, error, rate, pole, drive, way):
    ...     return math.copysign(law.limit, error * drive)
    >>> stommel.fly_mission(mission, controller=with_laws(steering_command=bang_bang))

    Parameters
    ----------
    laws
        By name, one of `LAWS`; the signature is that of the function replaced (`stommel.control.laws` and its
        neighbours).

    Raises
    ------
    UnknownLawError
        There is no law of a name.
    """
    for name in laws:
        if name not in LAWS:
            raise UnknownLawError(f"{name}: is no law of the vehicle; known are {', '.join(LAWS)}")
    # functions of the module see each other and the laws through one dictionary: that of the copy
    copy: dict[str, Any] = dict(vars(decision))
    for name, value in vars(decision).items():
        plain = getattr(value, "py_func", None)
        if plain is not None and plain.__module__ == decision.__name__:
            copy[name] = FunctionType(plain.__code__, copy, name, plain.__defaults__)
    copy.update(laws)
    decide: Callable[[np.record, Orders, Readings, float], Commands] = copy["decision"]
    return decide
