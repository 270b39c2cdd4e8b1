"""Drives of the motion-control node against a plant written by hand, whose flows and speeds the node does not know."""

from math import inf, nan

import pytest

from stommel.messages.database import value_named
from tests.onboard.execution.motion_bench import AFT, FORE, HIGH, MotionBench

ML, MM = 1e-6, 1e-3
ALL = pytest.mark.parametrize("interval", [0.1, 0.5, 1.0])


@ALL
@pytest.mark.parametrize("pressure", [0.0, 1e6, 2e6])
def test_all_drives_reach_their_set_points_within_their_tolerances_and_stay(interval, pressure):
    bench = MotionBench(interval)
    bench.plant.pressure = pressure
    for ballast, mass, steering, seconds in [
        (-1.2e-4, 0.28, 0.4, 60),
        (2e-4, 0.2, -0.6, 80),
        (1.95e-4, 0.2015, 0.0, 20),
    ]:
        bench.go_to(ballast, mass, steering)
        bench.run(seconds)
        assert bench.plant.V_b == pytest.approx(ballast, abs=0.1 * ML)
        assert bench.plant.r_px == pytest.approx(mass, abs=1 * MM)
        assert bench.plant.steering == pytest.approx(steering, abs=0.1 * 0.0175)
        assert bench.outputs[-1][:4] == (0.0, 0.0, 0.0, 0.0)
        assert bench.outputs[-1].brake


@ALL
def test_a_movement_takes_as_long_as_the_plant_needs_and_hardly_more(interval):
    bench = MotionBench(interval)
    bench.go_to(2e-4)
    bench.run(40)
    works = [out.pump for out in bench.outputs]
    # 200 ml at 8.3 ml/s
    assert sum(works) * interval == pytest.approx(2e-4 / 8.3e-6, rel=1e-3)
    last = max(i for i, share in enumerate(works) if share)
    assert (last + 1) * interval <= 2e-4 / 8.3e-6 + 2.0


@ALL
def test_the_valve_never_undoes_what_the_pump_did(interval):
    bench = MotionBench(interval)
    bench.plant.pressure = 2e6
    for ballast in (1e-4, -1e-4, 0.0):
        bench.go_to(ballast)
        bench.run(60)
        ways = [out.pump - out.valve for out in bench.outputs if out.pump or out.valve]
        bench.outputs.clear()
        assert len({share > 0.0 for share in ways}) == 1


@ALL
def test_a_small_movement_at_depth_does_not_reckon_with_the_speed_at_the_surface(interval):
    bench = MotionBench(interval)
    bench.go_to(-2e-5)
    bench.run(15)  # the valve gives 3 ml/s
    bench.plant.pressure = 2e6
    bench.go_to(-2.2e-5)
    least = 0.0
    for _ in range(round(5 / interval)):
        bench.step()  # and now 48 ml/s
        least = min(least, bench.plant.V_b)
    assert least == pytest.approx(-2.2e-5, abs=1e-7)


def test_mass_moves_from_the_tolerance_on_and_stops_within_a_quarter_of_it():
    bench = MotionBench(mass_tolerance=2 * MM)
    bench.go_to(moving_mass=0.2519)
    bench.run(5)
    assert bench.plant.r_px == 0.25
    bench.go_to(moving_mass=0.2521)
    bench.run(5)
    assert bench.plant.r_px == pytest.approx(0.2521, abs=0.5 * MM)


def test_brake_is_off_only_while_the_rudder_moves():
    bench = MotionBench()
    bench.go_to(steering=1.0)
    bench.run(10)
    assert {out.brake == (out.steering == 0.0) for out in bench.outputs} == {True}
    assert any(not out.brake for out in bench.outputs)


def test_set_points_beyond_the_ends_are_taken_as_the_ends():
    bench = MotionBench()
    bench.go_to(3e-3, 0.6, 1.6)
    bench.run(120)
    assert bench.plant.V_b == pytest.approx(HIGH, abs=0.1 * ML)
    assert bench.plant.r_px == pytest.approx(FORE, abs=1 * MM)
    assert bench.plant.steering == pytest.approx(1.0472, abs=0.002)


@pytest.mark.parametrize(("works", "goal", "code"), [
    ("pump_works", {"ballast": 1e-4}, "PumpStuck"),
    ("valve_works", {"ballast": -1e-4}, "ValveStuck"),
    ("mass_works", {"moving_mass": 0.4}, "MassStuck"),
    ("steering_works", {"steering": 0.5}, "SteeringStuck"),
])  # fmt: skip
def test_a_drive_that_does_not_follow_is_tried_three_times_and_given_up_until_the_fault_is_cleared(works, goal, code):
    bench = MotionBench()
    setattr(bench.plant, works, False)
    bench.go_to(**goal)
    bench.run(24)
    assert bench.emergencies() == []  # 5 s at work, 5 s rest, twice: two tries more
    bench.run(8)
    assert bench.emergencies() == [(code, True)]
    bench.run(60)
    assert all(out[:4] == (0.0, 0.0, 0.0, 0.0) for out in bench.outputs[-60:])
    bit = {"P": "engine_stuck", "V": "engine_stuck", "M": "mass_stuck", "S": "steering_stuck"}[code[0]]
    assert bench.messages("MotionDrives")[-1].values[bit] == 1
    setattr(bench.plant, works, True)
    bench.command("ClearFault")
    bench.run(40)
    assert bench.emergencies() == [(code, True), (code, False)]
    assert bench.outputs[-1][:4] == (0.0, 0.0, 0.0, 0.0)
    reached = {"ballast": bench.plant.V_b, "moving_mass": bench.plant.r_px, "steering": bench.plant.steering}
    for name, value in goal.items():
        assert reached[name] == pytest.approx(value, abs=2e-3 if name != "ballast" else 1e-7)


def test_a_jam_that_gives_way_is_no_fault():
    bench = MotionBench()
    bench.plant.mass_works = False
    bench.go_to(moving_mass=0.3)
    bench.run(8)
    bench.plant.mass_works = True
    bench.run(30)
    assert bench.emergencies() == []
    assert bench.plant.r_px == pytest.approx(0.3, abs=1 * MM)


def test_a_stuck_pump_leaves_the_valve_to_work():
    bench = MotionBench()
    bench.plant.pump_works = False
    bench.go_to(1e-4)
    bench.run(40)
    bench.go_to(-1e-5)
    bench.run(10)
    assert bench.plant.V_b == pytest.approx(-1e-5, abs=1e-7)


@pytest.mark.parametrize(("pin", "drive"), [("pump_current", 0), ("mass_current", 2), ("steering_current", 3)])
def test_too_much_current_stops_the_motor_at_once_and_is_told(pin, drive):
    bench = MotionBench()
    bench.go_to(2e-4, 0.5, 1.0)
    bench.run(2)
    assert bench.outputs[-1][drive] != 0.0
    bench.plant.overwritten[pin] = 15.0
    bench.step()
    assert bench.outputs[-1][drive] == 0.0
    assert bench.emergencies() == [("OverCurrent", True)]
    assert bench.messages("MotionDrives")[-1].values["over_current"] == 1
    del bench.plant.overwritten[pin]
    bench.run(8)  # 5 s rest
    assert bench.outputs[-1][drive] != 0.0 or drive == 3
    assert bench.emergencies() == [("OverCurrent", True), ("OverCurrent", False)]


def test_a_motor_that_always_takes_too_much_is_given_up():
    bench = MotionBench()
    bench.go_to(2e-4)
    for _ in range(60):
        running = bench.outputs and bench.outputs[-1].pump
        bench.plant.overwritten["pump_current"] = 15.0 if running else 0.0
        bench.step()
    assert sum(out.pump > 0.0 for out in bench.outputs) == 3
    assert ("PumpStuck", True) in bench.emergencies()


@pytest.mark.parametrize("interval", [0.1, 1.0])
@pytest.mark.parametrize("error", [nan, inf, -inf, 9.99])
@pytest.mark.parametrize(("pin", "bit", "drives"), [
    ("V_b", "ballast_measured", (0, 1)), ("r_px", "mass_measured", (2,)), ("steering", "steering_measured", (3,)),
])  # fmt: skip
def test_an_axis_without_a_reading_stops_and_says_so_and_the_others_go_on(interval, error, pin, bit, drives):
    bench = MotionBench(interval)
    bench.go_to(2e-4, 0.5, 1.0)
    bench.run(1)
    bench.plant.overwritten[pin] = error
    bench.step()
    for drive in range(4):
        moves = bench.outputs[-1][drive] != 0.0
        assert moves == (drive not in (*drives, 1))
    bench.run(2)
    status = bench.messages("MotionStatus")[-1].values
    assert {name: status[name] for name in status if name.endswith("measured")} == {
        name: int(name != bit) for name in ("ballast_measured", "mass_measured", "steering_measured")
    }
    assert ("SensorRange", True) in bench.emergencies()
    del bench.plant.overwritten[pin]
    bench.run(90)
    assert bench.plant.V_b == pytest.approx(2e-4, abs=1e-7)
    assert bench.plant.r_px == pytest.approx(0.5, abs=1 * MM)


@pytest.mark.parametrize(("switch", "goal"), [("limit_fore", 0.5), ("limit_aft", 0.0)])
def test_a_pressed_switch_stops_the_mass_in_its_direction_whatever_the_sensor_says(switch, goal):
    bench = MotionBench()
    bench.go_to(moving_mass=goal)
    bench.run(3)
    bench.plant.overwritten[switch] = True
    for _ in range(5):
        bench.step()
        assert bench.outputs[-1].mass == 0.0
    assert ("LimitSwitch", True) in bench.emergencies()  # the mass is not there
    assert bench.messages("MotionDrives")[-1].values["limit_fault"] == 1
    bench.go_to(moving_mass=0.5 - goal)
    bench.run(2)
    assert bench.outputs[-1].mass == (-1.0 if goal else 1.0)


def test_both_switches_pressed_hold_the_mass_and_are_a_fault():
    bench = MotionBench()
    bench.plant.overwritten.update(limit_fore=True, limit_aft=True)
    for goal in (0.0, 0.5):
        bench.go_to(moving_mass=goal)
        bench.run(5)
    assert all(out.mass == 0.0 for out in bench.outputs)
    assert bench.emergencies() == [("LimitSwitch", True)]


@pytest.mark.parametrize(("reading", "code"), [(FORE + 0.02, True), (AFT - 0.02, True), (FORE - 0.02, False)])
def test_a_switch_that_is_not_pressed_where_the_mass_has_passed_it_is_a_fault(reading, code):
    bench = MotionBench()
    bench.plant.overwritten["r_px"] = reading
    bench.run(5)
    assert (("LimitSwitch", True) in bench.emergencies()) is code


def test_a_switch_that_flickers_is_no_fault():
    bench = MotionBench(0.1)
    bench.plant.overwritten["limit_fore"] = True
    bench.run(0.5)
    del bench.plant.overwritten["limit_fore"]
    bench.run(2)
    assert bench.emergencies() == []


def test_oil_that_creeps_away_is_pumped_back_and_counted():
    bench = MotionBench()
    bench.go_to(1e-4)
    bench.run(30)
    bench.plant.leak = 5e-8
    bench.run(600)
    assert bench.plant.V_b == pytest.approx(1e-4, abs=2e-7)
    crept = bench.node.drives.engine.crept
    # 5e-8 m3/s over 600 s
    assert crept == pytest.approx(3e-5, rel=0.1)
    bench.say("MotionParameterRequest", operation=0, parameter=30, value=0)
    bench.run(2)
    import struct

    answer = bench.messages("MotionParameterAnswer")[-1].values
    told = struct.unpack("<f", int(answer["value"]).to_bytes(4, "little"))[0]
    assert answer["result"] == value_named("MotionParameterAnswer", "result", "Ok")
    assert told == pytest.approx(bench.node.drives.engine.crept, rel=0.02)


@pytest.mark.parametrize(("leak", "slips"), [(3e-7, False), (7e-7, False), (9e-7, True), (3e-6, True), (6e-6, True)])
def test_oil_that_slips_away_is_a_stuck_valve(leak: float, slips: bool) -> None:
    """Oracle: the pump brings 8.3 ml/s; above a tenth of that, 0.83 ml/s, it does little else than keep the oil."""
    bench = MotionBench()
    bench.go_to(1e-4)
    bench.run(30)
    bench.plant.leak = leak
    bench.run(60)
    assert (("ValveStuck", True) in bench.emergencies()) is slips
    bench.plant.leak = 0.0
    bench.run(60)
    assert ("ValveStuck", False) not in bench.emergencies()
    bench.command("ClearFault")
    bench.run(3)
    assert (("ValveStuck", False) in bench.emergencies()) is slips


def test_oil_that_runs_past_its_set_point_slips_too() -> None:
    """Oracle: a valve that sticks open as the oil runs in never lets it rest at its set point."""
    bench = MotionBench()
    bench.go_to(-5e-5)
    bench.run(15)
    bench.plant.leak = 3e-6
    bench.run(12)
    assert -7e-5 < bench.plant.V_b < -4e-5
    assert bench.emergencies() == [("ValveStuck", True)]


def test_a_new_set_point_is_no_slipping() -> None:
    bench = MotionBench()
    for goal in (1e-4, 1.02e-4, 1.04e-4, 1.5e-4, 2e-4):
        bench.go_to(goal)
        bench.run(8)
    assert bench.emergencies() == []


def test_status_comes_each_second_and_ten_times_a_second_while_something_moves():
    bench = MotionBench(0.1)
    bench.run(10)
    assert len(bench.messages("MotionStatus")) == len(bench.messages("MotionDrives")) == 10
    bench.go_to(8.3e-6 * 4.0)
    bench.run(10)
    # 4 s of pumping and the first and last frame of it, and 6 s of rest
    assert 44 <= len(bench.messages("MotionDrives")) - 10 <= 50
    assert len(bench.messages("MotionStatus")) == len(bench.messages("MotionDrives"))
