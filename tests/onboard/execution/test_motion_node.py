"""What the motion-control node does by itself: its table of modes row by row, and its words on the bus."""

import struct
from itertools import pairwise
from math import nan

import pytest

from stommel.messages.codec import Encoder
from stommel.messages.database import database_hash
from stommel.messages.parameters import MemoryStore
from stommel.onboard.execution.motion_io import AT_REST
from stommel.onboard.execution.motion_node import MotionNode
from stommel.onboard.execution.node_states import TRANSITIONS, Mode
from stommel.onboard.nodes.motion_settings import MotionSettings
from stommel.onboard.nodes.node_settings import SettingsError
from tests.onboard.execution.motion_bench import AFT, HIGH, NO_READINGS, MotionBench


def bench_in(mode: Mode) -> MotionBench:
    """A bench whose node is in a mode, by what takes it there."""
    bench = MotionBench(start=mode not in (Mode.PRE_OPERATIONAL, Mode.INITIALISING))
    bench.go_to(1e-4, 0.3, 0.2)
    if mode is Mode.INITIALISING:
        return bench
    bench.run(3)
    if mode is Mode.STOPPED:
        bench.command("Stop")
    elif mode is Mode.BRAKED:
        bench.command("Brake")
    elif mode is Mode.ABORTED:
        bench.say("Abort", reason=2, drop_weight=0)
    elif mode is Mode.QUIET:
        bench.sync = False
        bench.run(20)
    elif mode is Mode.LEFT_ALONE:
        bench.sync = False
        bench.run(70)
    bench.step()
    assert bench.node.link.modes.mode is mode
    return bench


def do(bench: MotionBench, event: str) -> None:
    """Let something happen."""
    commands = {"START": "Start", "STOP": "Stop", "BRAKE": "Brake", "CLEAR": "ClearFault", "RESTART": "Restart"}
    if event in commands:
        bench.command(commands[event])
        if event == "RESTART":
            bench.go_to()
    elif event == "SYNC":
        bench.sync = True
    elif event in ("SILENCE", "LONG_SILENCE"):
        bench.sync = False
        bench.run(6 if event == "SILENCE" else 70)
    elif event == "ABORT":
        bench.say("Abort", reason=2, drop_weight=0)
    elif event == "STRANGER":
        stranger(bench)
    bench.step()


def stranger(bench: MotionBench) -> None:
    other = (database_hash() + 1) % 2**24
    bench.say(
        "CoordinatorInformation", hardware=1, version_major=1, version_minor=0, version_patch=0, database_hash=other
    )


@pytest.mark.parametrize("row", TRANSITIONS, ids=lambda row: f"{row.mode.value}, {row.event.value}")
def test_each_row_of_the_table(row):
    bench = bench_in(row.mode)
    do(bench, row.event.name)
    # a restarted node has done its first step as soon as the next one begins
    expected = Mode.OPERATIONAL if row.next is None else row.next
    assert bench.node.link.modes.mode is (Mode.PRE_OPERATIONAL if expected is Mode.INITIALISING else expected)


@pytest.mark.parametrize(("mode", "state"), [
    (Mode.PRE_OPERATIONAL, "PreOperational"), (Mode.OPERATIONAL, "Operational"), (Mode.STOPPED, "Stopped"),
    (Mode.BRAKED, "Safe"), (Mode.QUIET, "Safe"), (Mode.LEFT_ALONE, "Safe"), (Mode.ABORTED, "Safe"),
])  # fmt: skip
def test_the_heartbeat_tells_the_state_and_only_an_operational_node_goes_where_it_is_told(mode, state):
    bench = bench_in(mode)
    bench.outputs.clear()
    bench.run(3)
    assert bench.state() == state
    if mode is Mode.OPERATIONAL:
        assert all(out.pump == 1.0 for out in bench.outputs)
    elif mode in (Mode.LEFT_ALONE, Mode.ABORTED):
        assert all(out.pump == 1.0 and out.mass == -1.0 and out.valve == 0.0 for out in bench.outputs)
    else:
        assert set(bench.outputs) == {AT_REST}


def test_a_node_tells_what_it_is_as_it_starts():
    bench = MotionBench(start=False)
    bench.step()
    (information,) = bench.messages("MotionInformation")
    assert information.values["database_hash"] == database_hash()
    assert bench.state() == "Initialising"
    bench.run(2)
    assert bench.state() == "PreOperational"


def test_a_quiet_bus_stops_the_drives_then_blows_and_a_sync_brings_the_node_back():
    bench = MotionBench()
    bench.go_to(-2e-4, 0.5, 0.5)
    bench.run(5)
    bench.sync = False
    bench.outputs.clear()
    bench.run(5)  # last Sync at 4 s
    assert bench.outputs[-1] == AT_REST
    assert bench.outputs[-2] != AT_REST
    bench.run(54)
    assert set(bench.outputs[5:]) == {AT_REST}
    bench.run(200)
    assert bench.plant.V_b == pytest.approx(HIGH, abs=1e-7)
    assert bench.plant.r_px == pytest.approx(AFT, abs=1e-3)
    assert bench.plant.steering == pytest.approx(0.0, abs=2e-3)
    assert bench.emergencies() == [("BusQuiet", True)]
    bench.sync, bench.setpoint = True, None
    bench.run(3)
    assert bench.state() == "Operational"
    assert bench.outputs[-1] == AT_REST  # the old set point is not obeyed
    bench.go_to(-1e-4)
    bench.run(200)
    assert bench.plant.V_b == pytest.approx(-1e-4, abs=1e-7)
    assert bench.emergencies() == [("BusQuiet", True), ("BusQuiet", False)]


def test_a_node_that_never_heard_anyone_blows_too():
    bench = MotionBench(start=False)
    bench.sync = False
    bench.run(150)
    assert bench.plant.V_b == pytest.approx(HIGH, abs=1e-7)


@pytest.mark.parametrize("release", ["ClearFault", "Start"])
def test_an_abort_is_latched_until_it_is_cleared(release):
    bench = MotionBench()
    bench.go_to(-1e-4)
    bench.run(30)
    bench.say("Abort", reason=3, drop_weight=0)
    bench.run(120)
    assert bench.state() == "Safe"
    assert bench.plant.V_b == pytest.approx(HIGH, abs=1e-7)
    assert bench.plant.r_px == pytest.approx(AFT, abs=1e-3)
    bench.command(release)
    bench.run(120)
    assert bench.state() == "Operational"
    assert bench.plant.V_b == pytest.approx(-1e-4, abs=1e-7)


def test_the_first_sync_after_a_silence_is_heard_whatever_its_alive_counter():
    bench = MotionBench()
    bench.run(3)  # alive counters 0, 1, 2
    bench.sync = False
    bench.run(10)
    bench.sync, bench.coordinator = True, Encoder()
    for _ in range(2):
        bench.coordinator.frame("Sync", vehicle_time=0.0)
    bench.step()  # alive counter 2, as that of the last one
    assert bench.node.link.modes.mode is Mode.OPERATIONAL


def test_a_strangers_sync_keeps_nobody_from_blowing():
    bench = MotionBench()
    bench.run(3)
    stranger(bench)
    bench.run(80)
    assert bench.outputs[-1].pump == 1.0


def test_an_abort_outlasts_a_quiet_bus():
    bench = MotionBench()
    bench.say("Abort", reason=3, drop_weight=0)
    bench.run(3)
    bench.sync = False
    bench.run(100)
    bench.sync = True
    bench.go_to(-1e-4)
    bench.run(10)
    assert bench.state() == "Safe"


@pytest.mark.parametrize("overwritten", [
    {}, {"V_b": nan, "r_px": nan, "steering": nan}, {"V_b": 0.01}, {"V_b": -1e-4}, {"pump_current": nan},
    {"pump_current": 19.0}, {"limit_fore": True},
], ids=str)  # fmt: skip
def test_the_last_reaction_pumps_all_oil_out_whatever_the_sensors_say(overwritten):
    bench = MotionBench()
    bench.plant.V_b = -2e-4
    bench.plant.overwritten = overwritten
    bench.say("Abort", reason=1, drop_weight=0)
    bench.run(600)
    assert bench.plant.V_b == pytest.approx(HIGH, abs=2e-7)
    if "limit_fore" not in overwritten:
        assert bench.plant.r_px == pytest.approx(AFT, abs=1e-3)


def test_the_last_reaction_rests_a_hot_pump_and_tries_a_stuck_one_for_ever():
    bench = MotionBench()
    bench.plant.pump_works = False
    bench.say("Abort", reason=1, drop_weight=0)
    bench.run(300)
    assert ("PumpStuck", True) in bench.emergencies()
    bench.plant.pump_works = True
    bench.run(300)
    assert bench.plant.V_b == pytest.approx(HIGH, abs=1e-7)
    hot = MotionBench()
    hot.say("Abort", reason=1, drop_weight=0)
    for _ in range(60):
        hot.plant.overwritten["pump_current"] = 19.0 if hot.outputs and hot.outputs[-1].pump else 0.0
        hot.step()
    pumped = [out.pump > 0.0 for out in hot.outputs]
    assert 8 <= sum(pumped) <= 12  # one second in six
    assert not any(a and b for a, b in pairwise(pumped))


def test_the_last_reaction_never_opens_the_valve():
    bench = MotionBench()
    bench.plant.V_b = HIGH
    bench.plant.overwritten["V_b"] = HIGH + 2e-5
    bench.say("Abort", reason=1, drop_weight=0)
    bench.run(20)
    assert all(out.valve == 0.0 for out in bench.outputs)


def test_the_drop_weight_goes_by_command_and_by_abort_and_only_where_there_is_one():
    for has, by_abort in [(True, True), (True, False), (False, True), (False, False)]:
        bench = MotionBench(has_drop_weight=has)
        if by_abort:
            bench.say("Abort", reason=2, drop_weight=1)
        else:
            bench.command("DropWeight")
        bench.run(30)
        assert sum(out.drop_weight for out in bench.outputs) == (10 if has else 0)  # release_time
        assert bench.messages("MotionDrives")[-1].values["weight_released"] == has
        if not by_abort:
            assert bench.results()[-1] == ("DropWeight", "Done" if has else "Refused")


@pytest.mark.parametrize("works", [True, False])
def test_a_vehicle_left_alone_drops_its_weight_if_it_could_not_pump(works):
    bench = MotionBench(has_drop_weight=True, drop_after=200.0)
    bench.plant.pump_works = works
    bench.run(3)
    bench.sync = False
    bench.run(190)
    assert not any(out.drop_weight for out in bench.outputs)
    bench.run(30)
    assert any(out.drop_weight for out in bench.outputs) is not works


def test_a_coordinator_of_another_database_is_refused_but_may_abort():
    bench = MotionBench()
    bench.go_to(1e-4)
    bench.run(3)
    stranger(bench)
    bench.command("Start")
    bench.run(4)
    assert bench.emergencies() == [("WrongVersion", True)]
    assert bench.results()[-1] == ("Start", "Refused")
    assert bench.outputs[-1] == AT_REST
    bench.say("Abort", reason=2, drop_weight=0)
    bench.run(2)
    assert bench.outputs[-1].pump == 1.0


def test_a_fault_cleared_under_another_database_does_not_make_its_set_points_good():
    bench = MotionBench()
    bench.run(2)
    bench.say("Abort", reason=2, drop_weight=0)
    bench.run(2)
    stranger(bench)
    bench.command("ClearFault")
    bench.go_to(-2e-4, 0.5, 0.5)
    bench.outputs.clear()
    bench.run(4)
    assert all(out.valve == 0.0 and out.steering == 0.0 and out.mass <= 0.0 for out in bench.outputs)


def test_a_command_is_done_once_and_its_retry_is_answered():
    bench = MotionBench()
    bench.run(2)
    number = bench.command("Restart")
    bench.run(2)
    bench.command("Restart", sequence=number)
    bench.run(2)
    assert bench.results()[-2:] == [("Restart", "Done")] * 2
    assert bench.messages("MotionHeartbeat")[-1].values["restarts"] == 1


def test_commands_for_others_are_passed_over_and_those_of_the_bench_are_obeyed():
    bench = MotionBench(start=False)
    bench.command("Start", target=3)
    bench.run(2)
    assert bench.results() == []
    frame = bench.operator.frame("BenchCommand", target=2, command=1, sequence=7, argument=0)
    said, _ = bench.node.step(bench.t, [frame], bench.plant.readings(), 1.0)
    assert bench.node.link.modes.mode is Mode.OPERATIONAL
    assert [f.identifier for f in said if f.identifier == 386] == [386]


def test_the_self_test_names_what_is_wrong_at_rest():
    for overwritten, detail in [
        ({"V_b": nan}, 1), ({"r_px": nan, "steering": nan}, 6), ({"limit_fore": True, "limit_aft": True}, 8),
        ({"mass_current": 9.0}, 16),
    ]:  # fmt: skip
        bench = MotionBench(start=False)
        bench.plant.overwritten = overwritten
        bench.run(2)
        bench.command("SelfTest")
        bench.run(2)
        assert bench.results() == [("SelfTest", "Failed")]
        assert bench.messages("MotionAcknowledgement")[-1].values["detail"] == detail


@pytest.mark.parametrize("interval", [0.1, 1.0])
def test_the_self_test_moves_every_drive_and_brings_it_back(interval: float):
    """Oracle: where the plant's drives have been, and where they stand at the end."""
    bench = MotionBench(interval)
    plant = bench.plant
    home = (plant.V_b, plant.r_px, plant.steering)
    bench.command("SelfTest")
    been = [(plant.V_b, plant.r_px, plant.steering)]
    while bench.results()[-1:] != [("SelfTest", "Done")]:
        bench.run(interval)
        been.append((plant.V_b, plant.r_px, plant.steering))
        assert len(been) < 60.0 / interval
    for place, start, way, tolerance in zip(zip(*been, strict=True), home, (2e-6, 3e-3, 0.05),
                                            (2e-7, 2e-3, 3.5e-3), strict=True):  # fmt: skip
        assert way - tolerance <= max(abs(value - start) for value in place) <= way + 2.0 * tolerance
        assert abs(place[-1] - start) <= tolerance


@pytest.mark.parametrize(("still", "detail"), [("V_b", 64), ("r_px", 128), ("steering", 256)])
def test_the_self_test_finds_a_drive_that_does_not_follow(still: str, detail: int):
    bench = MotionBench()
    bench.plant.overwritten = {still: getattr(bench.plant, still)}
    bench.command("SelfTest")
    bench.run(120)
    assert bench.results()[-1] == ("SelfTest", "Failed")
    assert int(bench.messages("MotionAcknowledgement")[-1].values["detail"]) & ~32 == detail


def test_the_self_test_ends_where_the_node_may_not_move():
    bench = MotionBench(start=False)
    bench.command("SelfTest")
    bench.run(2)
    assert bench.results() == [("SelfTest", "Refused")]
    bench = MotionBench()
    bench.command("SelfTest")
    bench.run(1)
    bench.command("Stop")
    bench.run(3)
    assert bench.results()[-1] == ("SelfTest", "Refused")


def write(bench: MotionBench, number: int, value: float) -> int:
    bits = int.from_bytes(struct.pack("<f", value), "little")
    bench.say("MotionParameterRequest", operation=1, parameter=number, value=bits)
    bench.run(1)
    return int(bench.messages("MotionParameterAnswer")[-1].values["result"])


def test_a_parameter_holds_at_once_is_kept_within_its_limits_and_outlasts_a_power_cut():
    store = MemoryStore()
    bench = MotionBench(store=store)
    assert write(bench, 16, 30.0) == 0
    assert bench.node.settings.blow_after == 30.0
    assert write(bench, 16, 1e9) == 2  # OutOfRange
    assert write(bench, 7, 0.01) == 0  # ten times the vehicle's own, a limit that no 32-bit number is
    assert write(bench, 7, 0.011) == 2
    assert write(bench, 99, 1.0) == 1  # NoSuchParameter
    bench.say("MotionParameterRequest", operation=6, parameter=0, value=0)
    bench.run(1)
    assert MotionNode(MotionSettings(), 1, store).settings.blow_after == 30.0
    bench.sync = False
    bench.run(40)
    assert bench.outputs[-1].pump == 1.0


def test_what_crept_away_counts_on_after_a_power_cut():
    """Oracle: the meaning of `oil_crept`, "the node counts on from the value set"."""
    store = MemoryStore()
    bench = MotionBench(store=store)
    assert write(bench, 30, 0.25) == 0
    bench.say("MotionParameterRequest", operation=6, parameter=0, value=0)
    bench.run(1)
    assert MotionNode(MotionSettings(), 1, store).drives.engine.crept == 0.25


def test_a_command_to_restart_forgets_what_was_not_saved_as_a_power_cut_does():
    bench = MotionBench(store=MemoryStore())
    assert write(bench, 16, 30.0) == 0
    bench.say("MotionParameterRequest", operation=6, parameter=0, value=0)
    bench.run(1)
    assert write(bench, 16, 40.0) == 0
    assert bench.node.settings.blow_after == 40.0
    bench.command("Restart")
    bench.run(1)
    assert bench.node.settings.blow_after == 30.0


def test_reading_a_parameter_touches_nothing():
    """A double that 32 bits do not hold stays as it was counted."""
    bench = MotionBench(store=MemoryStore())
    bench.node.drives.engine.crept = 0.1
    bench.say("MotionParameterRequest", operation=0, parameter=30, value=0)
    bench.run(1)
    assert bench.messages("MotionParameterAnswer")
    assert bench.node.drives.engine.crept == 0.1


def test_a_corrupted_store_is_told_and_the_last_good_copy_holds():
    store = MemoryStore()
    bench = MotionBench(store=store)
    for seconds in (30.0, 40.0):
        write(bench, 16, seconds)
        bench.say("MotionParameterRequest", operation=6, parameter=0, value=0)
        bench.run(1)
    copy = store.copies[1]
    store.copies[1] = copy[:20] + bytes((copy[20] ^ 4,)) + copy[21:]
    again = MotionBench(store=store)
    again.step()
    assert again.emergencies() == [("ParameterStore", True)]
    assert again.node.settings.blow_after == 30.0
    store.copies = [b"nonsense", b""]
    lost = MotionBench(store=store)
    lost.step()
    assert lost.emergencies() == [("ParameterStore", True)]
    assert lost.node.settings == MotionBench().node.settings


@pytest.mark.parametrize(("key", "value", "says"), [
    ("blow_after", 1.0, "between 5 and 600 s"), ("ballast_low", nan, "between -0.003 and 0.003 m3"),
    ("mass_low", 0.6, "less than mass_high"),
])  # fmt: skip
def test_settings_beyond_their_limits_are_refused_by_name(key, value, says):
    with pytest.raises(SettingsError, match=rf"MotionSettings.{key} = {value}: must be {says}"):
        MotionSettings(**{key: value})


def test_bad_frames_are_a_count_until_they_are_many():
    bench = MotionBench()
    good = Encoder().frame("Sync", vehicle_time=1.0)
    bad = good._replace(data=good.data[:-1] + bytes((good.data[-1] ^ 1,)))
    bench.step()
    bench.node.step(0.5, [bad] * 4, bench.plant.readings(), 1.0)
    bench.run(3)
    assert bench.emergencies() == []
    bench.node.step(2.5, [bad] * 5, bench.plant.readings(), 1.0)
    bench.node.link.watch_silence(5.0, 60.0)
    bench.run(12)
    assert ("BadFrames", False) in bench.emergencies()


def test_a_clock_that_jumps_back_neither_blows_nor_holds_up_the_last_reaction():
    node = MotionNode(MotionSettings())
    coordinator = Encoder()
    start = coordinator.frame("CoordinatorCommand", target=2, command=1, sequence=1, argument=0)
    node.step(1000.0, [], NO_READINGS, 1.0)
    node.step(1000.0, [coordinator.frame("Sync", vehicle_time=1.0), start], NO_READINGS, 1.0)
    for k in range(4):
        node.step(10.0 + k, [], NO_READINGS, 1.0)
    assert node.link.modes.mode is Mode.OPERATIONAL
    for k in range(70):
        _, out = node.step(20.0 + k, [], NO_READINGS, 1.0)
    assert out.pump == 1.0
