"""What the vehicle tells unasked. Oracles: the rules in words, and the names of alarms and start checks."""

import math
from types import SimpleNamespace

import pytest
from pymavlink.dialects.v20 import common

from stommel.link.outbox import Outbox
from stommel.messages.mavlink import message_named
from stommel.onboard.coordination.failsafes import FAILSAFES, Reaction
from stommel.onboard.coordination.safety import ActiveAlarm, SafetyState
from stommel.onboard.coordination.start_checks import START_CHECKS
from stommel.onboard.radio.sensor_health import SENSORS, sensor_health
from stommel.onboard.radio.telemetry import WARNING, Telemetry
from stommel.onboard.radio.telemetry_table import TELEMETRY

SOUND = SafetyState((), Reaction.REPORT, (), (), "", (), submerged=False)
GPS, COMPASS = common.MAV_SYS_STATUS_SENSOR_GPS, common.MAV_SYS_STATUS_SENSOR_3D_MAG
READY = common.MAV_SYS_STATUS_PREARM_CHECK


def texts(telemetry: Telemetry) -> list[str]:
    outbox = Outbox(100_000)
    telemetry.poll(0.0, outbox)
    said = []
    while (message := outbox.next()) is not None:
        assert message.name == "STATUSTEXT"
        said.append(message.payload[1:51].rstrip(b"\0").decode())
    return said


def test_a_flood_of_refusals_says_each_once_and_leaves_room_for_alarms() -> None:
    telemetry = Telemetry()
    for number in range(1000):
        telemetry.tell(WARNING, f"refused {number}")
        telemetry.tell(WARNING, "refused 0")
    assert texts(telemetry) == [f"refused {number}" for number in range(16)]
    telemetry.tell(WARNING, "refused 0")
    assert texts(telemetry) == ["refused 0"]


def test_every_sensor_is_there_and_sound_where_nothing_is_wrong() -> None:
    fields = sensor_health(SOUND)
    assert len(set(fields.values())) == 1
    for bit in (GPS, COMPASS, READY, common.MAV_SYS_STATUS_SENSOR_BATTERY, common.MAV_SYS_STATUS_LOGGING):
        assert fields["onboard_control_sensors_present"] & bit  # type: ignore[operator]


def unsound(safety: SafetyState) -> int:
    fields = sensor_health(safety)
    assert fields["onboard_control_sensors_present"] == sensor_health(SOUND)["onboard_control_sensors_present"]
    return fields["onboard_control_sensors_present"] ^ fields["onboard_control_sensors_health"]  # type: ignore[operator]


def test_what_is_unproven_or_has_an_alarm_is_not_sound() -> None:
    assert unsound(SOUND._replace(unproven=("GPS",))) == GPS | READY
    silent = SOUND._replace(active=(ActiveAlarm("silent GPS", 1.0, Reaction.NO_DIVE),), worst=Reaction.NO_DIVE)
    assert unsound(silent) == GPS | READY
    report = SOUND._replace(active=(ActiveAlarm("log not written", 1.0, Reaction.REPORT),))
    assert unsound(report) == common.MAV_SYS_STATUS_LOGGING


@pytest.mark.parametrize("row", SENSORS, ids=lambda row: row.bits[0])
def test_checks_and_alarms_of_sensors_are_those_of_the_tables(row) -> None:  # type: ignore[no-untyped-def]
    assert set(row.checks) <= {check.name for check in START_CHECKS}
    assert set(row.alarms) <= {failsafe.name for failsafe in FAILSAFES}


@pytest.mark.parametrize(("psi", "heading", "course"), [(math.nan, 0, 0xFFFF), (-0.001, 0, 35994), (3.0, 172, 17189)])
def test_a_silent_compass_and_pressure_sensor_end_no_message(psi: float, heading: int, course: int) -> None:
    """Their readings become no numbers (assessment.situation_of); UINT16_MAX is an unknown `hdg` in the dialect."""
    readings = SimpleNamespace(psi=psi, theta=math.nan, down_b2=0.0, down_b3=1.0, depth=math.nan)
    navigation = SimpleNamespace(latitude=0.1, longitude=0.2, current_north=0.1, current_east=0.0)
    view = SimpleNamespace(navigation=navigation, situation=SimpleNamespace(readings=readings))
    seen = SimpleNamespace(t=1.0, view=view, memory={"path_speed": 0.3, "vertical_speed": 0.1})
    rows = {row.name: row for row in TELEMETRY}
    found = {}
    for name in ("VFR_HUD", "GLOBAL_POSITION_INT", "ATTITUDE"):
        fields = rows[name].fields(seen)  # type: ignore[arg-type]
        assert fields is not None
        found[name] = message_named(name).unpack(message_named(name).pack(fields))
    assert found["VFR_HUD"]["heading"] == heading
    assert found["GLOBAL_POSITION_INT"]["hdg"] == course
