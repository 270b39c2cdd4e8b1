"""Oracle of the start checks: field reports of safety inputs that were dead and that nobody noticed.

Each check is broken on its own: then it is named, and no other.
"""

from math import nan
from typing import Any

import pytest

from stommel.onboard.coordination.executive import SELF_TESTED
from stommel.onboard.coordination.start_checks import START_CHECKS, StartChecks, what_to_do
from tests.onboard.coordination.situations import LIMITS, situation

BROKEN: dict[str, tuple[dict[str, Any], ...]] = {
    "acquisition node": ({"acquisition_silent": True}, {"acquisition_refused": True}),
    "motion node": ({"motion_silent": True}, {"motion_refused": True}),
    "leak loop": ({"leak_proven": False}, {"leak_silent": True}),
    "dry": ({"leak_fore": True}, {"leak_aft": True}, {"leak": True}),
    "pressure sensor": ({"pressure_proven": False}, {"pressure_silent": True}),
    "vacuum": (
        {"vacuum_proven": False},
        {"vacuum_silent": True},
        {"internal_pressure": 95.1e3},
        {"internal_pressure": nan},
    ),
    "battery": (
        {"battery_proven": False},
        {"battery_silent": True},
        {"voltage": 20.9},
        {"voltage": 30.1},
        {"voltage": nan},
    ),
    "compass": (
        {"compass_silent": True},
        {"field": 19.9},
        {"field": 70.1},
        {"field": nan},
        {"gravity": 0.69},
        {"gravity": 1.31},
        {"gravity": nan},
    ),
    "GPS": ({"fixed": False}, {"gps_silent": True}),
    "pump": ({"pump_proven": False}, {"pump_stuck": True}, {"valve_stuck": True}, {"ballast_silent": True}),
    "moving mass": ({"mass_proven": False}, {"mass_stuck": True}, {"mass_silent": True}, {"limit_fault": True}),
    "steering": ({"steering_proven": False}, {"steering_stuck": True}, {"steering_silent": True}),
    "log": ({"log_writable": False},),
    "mission": ({"mission_present": False}, {"mission_expired": True}),
}


def test_every_check_has_a_case_and_only_those() -> None:
    assert list(BROKEN) == [check.name for check in START_CHECKS]


def test_sound_vehicle_has_proven_everything() -> None:
    assert StartChecks(LIMITS).unproven(situation(0.0)) == ()


@pytest.mark.parametrize(("name", "changes"), [(name, changes) for name, ways in BROKEN.items() for changes in ways])
def test_broken_input_is_named_alone_with_what_to_do(name: str, changes: dict[str, Any]) -> None:
    checks = StartChecks(LIMITS)
    for _ in range(3):
        assert checks.unproven(situation(0.0, **changes)) == (name,)
    assert len(what_to_do(name)) > 10


@pytest.mark.parametrize("name", BROKEN)
def test_proof_lasts_where_it_cannot_be_given_under_water(name: str) -> None:
    """Position, and the compass beside the running motors; everything else must hold at every decision."""
    checks = StartChecks(LIMITS)
    assert checks.unproven(situation(0.0)) == ()
    later = checks.unproven(situation(1.0, **BROKEN[name][0]))
    assert later == (() if name in {"GPS", "compass"} else (name,))
    checks.again()
    assert checks.unproven(situation(2.0, **BROKEN[name][0])) == (name,)


def test_self_test_proves_checks_of_the_table() -> None:
    assert set(SELF_TESTED) <= set(BROKEN)
