"""Oracle of the faults: what each row of their table says in words, seen at the plant, the bus, or by the software.

A row without a test fails.
"""

from collections.abc import Callable
from math import degrees, inf, isnan

import numpy as np
import pytest

from stommel.dynamics.state import V_B
from stommel.instruments.gpctd.device import CtdTruth
from stommel.messages.database import ACQUISITION, COORDINATOR, MOTION
from stommel.onboard.execution.node_states import Mode
from stommel.simulation.plant.driven import Drives
from stommel.simulation.scenario.mission import Mission
from stommel.sitl.can_bus import SimulatedBus
from stommel.sitl.faults.acting import Acting
from stommel.sitl.faults.disk import MemoryDisk
from stommel.sitl.faults.fault import Fault
from stommel.sitl.faults.injector import Injector
from stommel.sitl.faults.on_sensors import READINGS, bytes_with, ctd_with, felt_with, loop_whole
from stommel.sitl.faults.table import ANALOG, BY_NAME, KINDS, SENSORS
from stommel.sitl.plant import Felt, Plant
from stommel.sitl.system import NODES, System

RESTING = Drives(0.0, 0.0, 0.0, 0.0, True, False, 0, False, False, 0)


def fault(kind: str, target: str = "", value: float | None = None, at: float = 0.0, lasts: float = inf) -> Fault:
    return Fault(kind, target, at, lasts, BY_NAME[kind].default if value is None else value)


def flown(mission: Mission, broken: Fault | None, seconds: int) -> System:
    system = System(mission, inject=Injector(() if broken is None else (broken,), 1, MemoryDisk()))
    for _ in range(seconds):
        system.step()
    return system


def moved(mission: Mission, broken: Fault | None, seconds: int, **drives: float) -> Plant:
    """A plant whose power stages do the same all the time."""
    plant, bus = Plant.of(mission), SimulatedBus(NODES)
    inject = Injector(() if broken is None else (broken,), 1)
    plant.feel()
    plant.setup.x[V_B] = 0.0  # it starts with all oil outside
    for _ in range(seconds):
        inject.begin(plant, bus)
        plant.move(RESTING._replace(**drives), plant.setup.memory)
    return plant


def felt(mission: Mission, **readings: float) -> Felt:
    found = Plant.of(mission).feel()
    return found._replace(readings=found.readings._replace(**readings))


def rejected(system: System, reason: str) -> int:
    return sum(n for (_, why), n in system.coordinator.perception.decoder.rejected.items() if why == reason)


def received(system: System, message: str) -> int:
    return system.coordinator.perception.decoder.received[message]


# the bus


def frame_bits_flipped(mission: Mission) -> None:
    system = flown(mission, fault("frame_bits_flipped", "motion", 1.0), 20)
    assert rejected(system, "checksum") > 20
    assert received(system, "MotionStatus") == 0 < received(system, "Depth")


def frames_lost(mission: Mission) -> None:
    system = flown(mission, fault("frames_lost", "motion", 1.0, at=10.0), 20)
    assert system.coordinator.perception.heard["MotionStatus"] == 9.0
    assert system.coordinator.perception.heard["Depth"] == 19.0


def frames_late(mission: Mission) -> None:
    system = flown(mission, fault("frames_late", "acquisition", 1.0), 20)
    assert received(flown(mission, None, 20), "Depth") - received(system, "Depth") == 1
    assert rejected(system, "overtaken") == 0


def frames_repeated(mission: Mission) -> None:
    system = flown(mission, fault("frames_repeated", "acquisition", 1.0), 20)
    assert rejected(system, "repeated") >= 20
    assert received(system, "Depth") == received(flown(mission, None, 20), "Depth")


def bus_off(mission: Mission) -> None:
    system = flown(mission, fault("bus_off", "motion", at=10.0), 20)
    assert system.coordinator.perception.heard["MotionStatus"] == 9.0
    assert system.motion.link.modes.mode is Mode.QUIET  # type: ignore[attr-defined]  # it hears no Sync either


def stranger(mission: Mission) -> None:
    system = flown(mission, fault("stranger", value=3.0), 10)
    assert rejected(system, "unknown") == 30


def wrong_database(mission: Mission) -> None:
    assert flown(mission, fault("wrong_database", "motion"), 20).coordinator.perception.watch.is_refused(MOTION)
    assert flown(mission, fault("wrong_database", "coordinator"), 20).motion.link.stranger  # type: ignore[attr-defined]


# sensors and ports


def _number(name: str, found: Felt, truth: CtdTruth, acting: Acting) -> float:
    if name == "ctd":
        return ctd_with([acting], truth).pressure
    through = felt_with([acting], found).readings
    if name == "compass":
        return degrees(through.psi)
    if name == "gps":
        return through.fix_latitude * 6.371e6
    reading, unit = READINGS[name]
    return float(getattr(through, reading)) / unit


def _sequence(mission: Mission, kind: str, name: str, value: float = 0.0) -> tuple[list[float], list[float]]:
    """What a sound and a broken sensor say of a world that changes."""
    says, sound = [], []
    broken = Acting(fault(kind, name, value), 1)
    nothing = Acting(fault("sensor_biased", name, 0.0), 1)
    for k in range(1, 5):
        x = 0.01 * k
        names = ("depth", "altitude", "internal_pressure", "voltage", "current", "V_b", "r_px", "steering")
        found = felt(mission, psi=x, fix_latitude=x, fixed=True, **dict.fromkeys(names, x))
        truth = CtdTruth(x, x, x, 0.0)
        says.append(_number(name, found, truth, broken))
        sound.append(_number(name, found, truth, nothing))
    return says, sound


def sensor_stuck(mission: Mission) -> None:
    for name in ANALOG:
        says, sound = _sequence(mission, "sensor_stuck", name)
        assert says == pytest.approx([sound[0]] * 4), name
        assert sound[1] != sound[0], name
    stuck = Acting(fault("sensor_stuck", "leak_detector"), 1)
    assert not felt_with([stuck], felt(mission, leak=False)).readings.leak
    assert not felt_with([stuck], felt(mission, leak=True)).readings.leak


def sensor_biased(mission: Mission) -> None:
    for name in ANALOG:
        says, sound = _sequence(mission, "sensor_biased", name, 2.5)
        assert np.subtract(says, sound) == pytest.approx(2.5, abs=1e-3), name


def sensor_noisy(mission: Mission) -> None:
    for name in ANALOG:
        says, sound = _sequence(mission, "sensor_noisy", name, 2.5)
        errors = np.subtract(says, sound)
        assert len(set(errors.round(6))) == 4, name
        assert 0.2 < errors.std() < 10.0, name


def sensor_silent(mission: Mission) -> None:
    for name in SENSORS:
        broken = Acting(fault("sensor_silent", name), 1)
        if name in READINGS:
            reading, _ = READINGS[name]
            assert isnan(getattr(felt_with([broken], felt(mission)).readings, reading)), name
        elif name == "leak_detector":
            assert not loop_whole([broken])
        else:
            assert bytes_with([broken], name, b"abc") == b""
    view = flown(mission, fault("sensor_silent", "compass"), 20).coordinator.view
    assert view is not None
    assert view.situation.compass_silent
    view = flown(mission, fault("sensor_silent", "leak_detector"), 20).coordinator.view
    assert view is not None
    assert view.situation.leak_silent


def gps_jump(mission: Mission) -> None:
    there = felt(mission, fix_latitude=0.0, fix_longitude=0.0, fixed=True)
    found = felt_with([Acting(fault("gps_jump", value=10.0), 1)], there).readings
    assert found.fix_latitude * 6.371e6 == pytest.approx(1e4)
    assert found.fix_longitude * 6.371e6 == pytest.approx(1e4, rel=1e-4)


def bytes_garbled(mission: Mission) -> None:
    said = bytes(range(200))
    all_wrong = bytes_with([Acting(fault("bytes_garbled", "gps", 1.0), 1)], "gps", said)
    assert all(a != b for a, b in zip(all_wrong, said, strict=True))
    some = bytes_with([Acting(fault("bytes_garbled", "gps", 0.5), 1)], "gps", said)
    assert 50 < sum(a != b for a, b in zip(some, said, strict=True)) < 150
    assert bytes_with([Acting(fault("bytes_garbled", "gps", 1.0), 1)], "compass", said) == said


def bytes_lost(mission: Mission) -> None:
    assert 50 < len(bytes_with([Acting(fault("bytes_lost", "ctd", 0.5), 1)], "ctd", bytes(200))) < 150
    view = flown(mission, fault("bytes_lost", "compass", 1.0), 20).coordinator.view
    assert view is not None
    assert view.situation.compass_silent


# machinery


def _oil(mission: Mission, broken: Fault | None, seconds: int = 10, **drives: float) -> float:
    """Change of the oil outside [ml]."""
    return 1e6 * moved(mission, broken, seconds, **drives).oil


def pump_dead(mission: Mission) -> None:
    assert _oil(mission, None, pump=1.0) > 20.0
    assert _oil(mission, fault("pump_dead"), pump=1.0) == pytest.approx(0.0, abs=1e-9)


def pump_weak(mission: Mission) -> None:
    whole = _oil(mission, None, pump=1.0)
    assert whole > 20.0
    assert _oil(mission, fault("pump_weak", value=0.25), pump=1.0) == pytest.approx(0.25 * whole, rel=1e-3)


def oil_creeps(mission: Mission) -> None:
    assert _oil(mission, fault("oil_creeps", value=60.0)) == pytest.approx(-10.0)


def valve_stuck_open(mission: Mission) -> None:
    whole = _oil(mission, None, valve=1.0)
    assert whole < -20.0
    assert _oil(mission, fault("valve_stuck_open", value=0.5)) == pytest.approx(0.5 * whole, rel=1e-2)  # by the depth


def valve_stuck_shut(mission: Mission) -> None:
    assert _oil(mission, fault("valve_stuck_shut"), valve=1.0) == pytest.approx(0.0, abs=1e-9)


def limit_switch_broken(mission: Mission) -> None:
    high = Plant.of(mission).setup.equipment.plant.mass.high
    sound = moved(mission, None, 150, mass=1.0)
    broken = moved(mission, fault("limit_switch_broken"), 150, mass=1.0)
    assert sound.feel().readings.r_px == pytest.approx(high)
    assert broken.feel().readings.r_px == pytest.approx(high + 0.004)
    assert sound.feel().limit_fore
    assert not broken.feel().limit_fore


def limit_switch_pressed(mission: Mission) -> None:
    found = felt_with([Acting(fault("limit_switch_pressed", "aft"), 1)], felt(mission))
    assert found.limit_aft
    assert not found.limit_fore


def mass_jammed(mission: Mission) -> None:
    start = Plant.of(mission).feel().readings.r_px
    sound = moved(mission, None, 5, mass=-1.0).feel().readings.r_px - start
    half = moved(mission, fault("mass_jammed", value=0.5), 5, mass=-1.0).feel().readings.r_px - start
    assert sound < -0.01
    assert half == pytest.approx(0.5 * sound, rel=1e-2)


def steering_jammed(mission: Mission) -> None:
    assert abs(moved(mission, None, 1, steering=0.5, brake=False).feel().readings.steering) > 0.05
    jammed = moved(mission, fault("steering_jammed", value=0.0), 1, steering=0.5, brake=False)
    assert jammed.feel().readings.steering == 0.0


# supply


def brown_out(mission: Mission) -> None:
    down = flown(mission, fault("brown_out", "motion", at=10.0, lasts=10.0), 15)
    assert down.outputs.pump == 0.0
    assert down.coordinator.perception.heard["MotionStatus"] == 10.0  # in its last step it still spoke, share 1
    up = flown(mission, fault("brown_out", "motion", at=10.0, lasts=10.0), 30)
    assert up.restarts == {COORDINATOR: 0, MOTION: 1, ACQUISITION: 0}
    assert up.coordinator.perception.watch.restarts_seen == 1
    halfway = fault("brown_out", "coordinator", 0.0, at=10.0, lasts=5.0)
    again = flown(mission, halfway, 30)
    assert again.restarts[COORDINATOR] == 1
    view = again.coordinator.view
    assert view is not None
    assert view.executive.started  # its store kept that the operator had started the mission
    assert len(again.inject.logbooks) == 2


def supply_drop(mission: Mission) -> None:
    low = flown(mission, fault("supply_drop", value=10.0, at=10.0, lasts=5.0), 30)
    assert set(low.restarts.values()) == {1}
    view = flown(mission, fault("supply_drop", value=16.0, at=10.0), 20).coordinator.view
    assert view is not None
    assert view.situation.readings.voltage == pytest.approx(16.0, abs=0.1)


def battery_run_down(mission: Mission) -> None:
    plant = moved(mission, fault("battery_run_down", value=0.1), 2)
    battery = plant.setup.equipment.plant.battery
    assert plant.setup.world["energy_total"] / battery.energy == pytest.approx(0.9, abs=1e-3)
    assert plant.feel().readings.voltage < moved(mission, None, 2).feel().readings.voltage - 0.5


def current_spike(mission: Mission) -> None:
    found = felt_with([Acting(fault("current_spike", "mass", 12.0), 1)], felt(mission))
    assert found.currents == (0.0, 12.0, 0.0)


# software and hull


def decision_exception(mission: Mission) -> None:
    pilot = flown(mission, fault("decision_exception"), 80).coordinator.pilot
    assert pilot.exceptions > 10
    assert "InjectedError" in pilot.failure


def disk_full(mission: Mission) -> None:
    logs = flown(mission, fault("disk_full", at=5.0), 20).inject.logbooks
    assert "No space left" in logs[0].blocked


def clock_jump(mission: Mission) -> None:
    system = flown(mission, fault("clock_jump", value=3600.0, at=5.0), 10)
    assert system.coordinator.view is not None
    assert system.coordinator.view.t == 3609.0


def early_expiry(mission: Mission) -> None:
    view = flown(mission, fault("early_expiry", at=5.0, lasts=1.0), 10).coordinator.view
    assert view is not None
    assert view.situation.mission_expired


def hull_leak(mission: Mission) -> None:
    leaked = moved(mission, fault("hull_leak", value=60.0, at=5.0, lasts=10.0), 30).setup.world["leaked"]
    assert 1e6 * float(leaked) == pytest.approx(10.0)


# radio


def radio_dead(mission: Mission) -> None:
    system, arrived = flown(mission, fault("radio_dead", at=40.0, lasts=20.0), 40), []
    for seconds in (0, 20, 20):
        for _ in range(seconds):
            system.step()
        arrived.append(system.air.channel.vehicle.counts.arrived_bytes)
    assert 0 < arrived[0] == arrived[1] < arrived[2]


def radio_packets_lost(mission: Mission) -> None:
    counts = [
        flown(mission, broken, 80).air.channel.vehicle.counts
        for broken in (None, fault("radio_packets_lost", value=0.5), fault("radio_packets_lost", value=0.5, lasts=1.0))
    ]
    assert all(each.packets > 50 for each in counts)
    washed_over, half, brief = (each.lost / each.packets for each in counts)
    assert washed_over < 0.2
    assert half == pytest.approx(0.5 + 0.5 * washed_over, abs=0.15)
    assert brief == pytest.approx(washed_over, abs=0.05)


CHECKS: dict[str, Callable[[Mission], None]] = {
    check.__name__: check
    for check in (
        frame_bits_flipped, frames_lost, frames_late, frames_repeated, bus_off, stranger, wrong_database, sensor_stuck,
        sensor_biased, sensor_noisy, sensor_silent, gps_jump, bytes_garbled, bytes_lost, pump_dead, pump_weak,
        oil_creeps, valve_stuck_open, valve_stuck_shut, limit_switch_broken, limit_switch_pressed, mass_jammed,
        steering_jammed, brown_out, supply_drop, battery_run_down, current_spike, decision_exception, disk_full,
        clock_jump, early_expiry, hull_leak, radio_dead, radio_packets_lost,
    )
}  # fmt: skip


@pytest.mark.parametrize("kind", [row.name for row in KINDS])
def test_each_kind_does_what_its_row_says(kind: str, trial: Mission) -> None:
    CHECKS[kind](trial)


def test_no_check_without_a_row() -> None:
    assert set(CHECKS) == {row.name for row in KINDS}


def test_a_fault_draws_the_same_when_others_are_taken_away() -> None:
    alone = [Acting(fault("frames_lost", "all", 0.5), 7).strikes() for _ in range(2)]
    assert alone[0] == alone[1]
    first, second = Acting(fault("frames_lost", "all", 0.5), 7), Acting(fault("frames_lost", "all", 0.5, at=1.0), 7)
    assert [first.strikes() for _ in range(40)] != [second.strikes() for _ in range(40)]


def test_a_node_tells_too_much_current_whatever_kind_of_number_it_is(trial: Mission) -> None:
    """A campaign's seed 63: NumPy's numbers of the plant became a truth that no frame can say."""
    system = flown(trial, fault("current_spike", "pump", np.float64(30.0)), 20)
    assert system.coordinator.perception.watch.reports(MOTION, "OverCurrent")
