"""Start checks: a table of what must have proved itself before a dive. Unproven means no dive.

A safety input that is silent through a detail of its wiring looks like one that says "all is well"; so each is made to
show that it lives, or is held against what it must say at the surface.
"""

from collections.abc import Callable
from typing import NamedTuple

from stommel.onboard.coordination.limits import SafetyLimits
from stommel.onboard.coordination.situation import Situation


class StartCheck(NamedTuple):
    """One row of the table."""

    name: str
    words: str
    """What proves it, for the documentation."""
    proven: Callable[[Situation, SafetyLimits], bool]
    lasts: bool
    """Whether it is proven once for all, until the checks are done again; else it must hold at every decision."""
    what_to_do: str
    """Words for the operator while it is unproven."""


GREATEST_SLANT = 0.3
"""Of the acceleration at rest from standard gravity, in the same unit: waves move the vehicle."""

START_CHECKS = (
    StartCheck(
        "acquisition node", "speaks, and is of this version",
        lambda now, *_: not (now.acquisition_silent or now.acquisition_refused), False,
        "look at its supply, the bus and its software's version",
    ),
    StartCheck(
        "motion node", "speaks, and is of this version",
        lambda now, *_: not (now.motion_silent or now.motion_refused), False,
        "look at its supply, the bus and its software's version",
    ),
    StartCheck(
        "leak loop", "the node feels the test resistors of both leak detectors",
        lambda now, *_: now.leak_proven and not now.leak_silent, False,
        "look at plugs and wires of the leak detectors; a detector without test resistor cannot be proven",
    ),
    StartCheck(
        "dry", "no leak detector is wet",
        lambda now, *_: not (now.leak_fore or now.leak_aft or now.readings.leak), False,
        "dry the bay, find where the water came in",
    ),
    StartCheck(
        "pressure sensor", "says about zero at the surface",
        lambda now, *_: now.pressure_proven and not now.pressure_silent, False,
        "bring the vehicle to the surface; set the sensor's zero, or change it",
    ),
    StartCheck(
        "vacuum", "the hull holds its vacuum, and its sensor says so",
        lambda now, limits: (
            now.vacuum_proven and not now.vacuum_silent and now.readings.internal_pressure <= limits.vacuum_lost
        ), False,
        "pump the hull down; if the pressure rises again, look at seals and plugs",
    ),
    StartCheck(
        "battery", "its gauge answers, and the voltage is one of a charged battery",
        lambda now, limits: (
            now.battery_proven and not now.battery_silent
            and limits.least_voltage <= now.readings.voltage <= limits.greatest_voltage
        ), False,
        "charge or change the battery, look at its gauge",
    ),
    StartCheck(
        "compass", "answers, and feels a plausible magnetic field and gravity",
        lambda now, limits: (
            not now.compass_silent
            and limits.least_field <= now.field <= limits.greatest_field
            and abs(now.gravity - 1.0) <= GREATEST_SLANT
        ), True,
        "take the vehicle away from iron, look at the compass's cable, calibrate it",
    ),
    StartCheck(
        "GPS", "has told a position",
        lambda now, *_: now.readings.fixed and not now.gps_silent, True,
        "give the antenna a free view of the sky, wait some minutes",
    ),
    StartCheck(
        "pump", "the oil followed in the self-test",
        lambda now, *_: now.pump_proven and not (now.pump_stuck or now.valve_stuck or now.ballast_silent), False,
        "repeat the self-test; look at oil, valve, motor and displacement sensor",
    ),
    StartCheck(
        "moving mass", "it followed in the self-test, its limit switches agree",
        lambda now, *_: now.mass_proven and not (now.mass_stuck or now.mass_silent or now.limit_fault), False,
        "repeat the self-test; look at pitch drive, limit switches and position sensor",
    ),
    StartCheck(
        "steering", "it followed in the self-test",
        lambda now, *_: now.steering_proven and not (now.steering_stuck or now.steering_silent), False,
        "repeat the self-test; look at steering drive, brake and angle sensor",
    ),
    StartCheck(
        "log", "its last record is on disk",
        lambda now, *_: now.log_writable, False,
        "make room on the disk, or change it",
    ),
    StartCheck(
        "mission", "there is one, valid for this vehicle, and its time is not over",
        lambda now, *_: now.mission_present and not now.mission_expired, False,
        "send a mission",
    ),
)  # fmt: skip
"""Every start check."""


class StartChecks:
    """Goes through the table at every decision."""

    def __init__(self, limits: SafetyLimits) -> None:
        self._limits = limits
        self._passed: set[str] = set()

    def again(self) -> None:
        """Forget what was proven once for all."""
        self._passed.clear()

    def unproven(self, now: Situation) -> tuple[str, ...]:
        """Return the names of the checks that have not passed, in the order of the table."""
        limits, passed = self._limits, self._passed
        open_checks: tuple[str, ...] = ()
        for check in START_CHECKS:
            if check.lasts and check.name in passed:
                continue
            if check.proven(now, limits):
                if check.lasts:
                    passed.add(check.name)
            else:
                open_checks = (*open_checks, check.name)
        return open_checks


def what_to_do(name: str) -> str:
    """Words for the operator about a start check.

    Raises
    ------
    KeyError
        There is none of this name.
    """
    return {check.name: check.what_to_do for check in START_CHECKS}[name]
