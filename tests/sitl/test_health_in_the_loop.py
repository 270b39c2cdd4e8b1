"""Health as the coordinator tells it: what is broken on purpose is named, counted once, and stands in the log."""

import itertools
from collections.abc import Callable, Iterable
from dataclasses import replace

import pytest

from stommel.messages.codec import Encoder
from stommel.messages.database import database_hash, message_named
from stommel.messages.frames import Frame
from stommel.messages.log.reader import read_log
from stommel.onboard.coordination.health import CONDITIONS, SOURCES, Condition, SourceHealth
from stommel.onboard.coordination.sources import HEALTH_EVERY
from stommel.sitl import system as loop
from stommel.sitl.can_bus import SimulatedBus
from stommel.sitl.faults.disk import MemoryDisk
from stommel.sitl.faults.fault import Fault
from stommel.sitl.faults.injector import Injector
from stommel.sitl.observer import Observer
from stommel.sitl.shown import BAD, QUIET, WELL, shown
from stommel.sitl.system import System
from tests.sitl.comparison import mission_of

Spoil = Callable[[int, Frame], Iterable[Frame]]


def started(*faults: Fault) -> System:
    return System(mission_of("pool_trial", 600), inject=Injector(faults, 1, MemoryDisk()))


def stepped(system: System, seconds: int) -> System:
    for _ in range(seconds):
        system.step()
    return system


def health(system: System) -> dict[str, SourceHealth]:
    assert system.coordinator.view is not None
    return {source.name: source for source in system.coordinator.view.health.sources}


def lines(system: System) -> dict[str, tuple[str, str]]:
    now = shown(system, Observer())
    return {line.name: (line.value, line.how) for line in (*now.bus, *now.instruments)}


def once(system: System, message: str, what: Spoil) -> None:
    """Let something become of the next frame of a message."""
    identifier, bus = message_named(message).frame_id, system.bus
    assert isinstance(bus, SimulatedBus)

    def spoil(sender: int, frame: Frame) -> Iterable[Frame]:
        if frame.identifier != identifier:
            return (frame,)
        bus.spoil = None
        return what(sender, frame)

    bus.spoil = spoil


def test_a_sound_vehicle_is_well_and_what_has_no_power_is_off() -> None:
    system = stepped(started(), 150)
    now = health(system)
    assert tuple(now) == SOURCES
    off = {"GPS", "radio"}
    assert {name for name, source in now.items() if source.condition is Condition.OFF} == off
    assert {source.condition for name, source in now.items() if name not in off} == {Condition.WELL}
    told = system.coordinator.view
    assert told is not None
    assert now["pressure sensor"].heard == pytest.approx(told.health.t, abs=2.0)  # one reading a second
    assert not any(source.lost or source.rejected or source.silences or source.restarts for source in now.values())
    seen = lines(system)
    assert (seen["compass"], seen["GPS"], seen["motion"]) == (("sampling", WELL), ("off", QUIET), ("operational", WELL))
    assert "battery gauge" not in seen


def test_one_lost_and_one_garbled_frame_are_counts() -> None:
    system = stepped(started(), 60)
    once(system, "MotionStatus", lambda *_: ())
    stepped(system, 5)
    once(system, "Battery", lambda _, frame: (Frame(frame.identifier, bytes(7) + frame.data[7:]),))
    stepped(system, 5 + round(HEALTH_EVERY))
    now = health(system)
    # the garbled frame is missing, too, as the counter of the next one tells
    assert (now["motion node"].lost, now["motion node"].rejected) == (1, 0)
    assert (now["battery gauge"].lost, now["battery gauge"].rejected) == (1, 1)
    assert (now["acquisition node"].lost, now["acquisition node"].rejected) == (1, 1)
    assert now["motion node"].condition is now["battery gauge"].condition is Condition.WELL
    assert lines(system)["acquisition"] == ("operational (1 lost, 1 rejected)", WELL)


def test_a_node_without_power_is_silent_once_and_then_counted_as_restarted() -> None:
    system = stepped(started(Fault("brown_out", "motion", 60.0, 20.0, 0.5)), 70)
    # last heard at 59 s, silent after 3.5 s: told at once, not at the next look
    silent = health(system)["motion node"]
    assert (silent.condition, silent.silences, silent.restarts) == (Condition.SILENT, 1, 0)
    assert lines(system)["motion"] == ("silent", BAD)
    stepped(system, 20 + round(HEALTH_EVERY))
    again = health(system)["motion node"]
    assert (again.condition, again.silences, again.restarts) == (Condition.WELL, 1, 1)
    assert health(system)["acquisition node"].silences == 0
    value, _ = lines(system)["motion"]
    assert "1× silent, 1× restarted" in value


def test_a_sensor_that_measures_nothing_is_silent_though_its_node_speaks() -> None:
    system = stepped(started(Fault("sensor_silent", "pressure", 60.0, 20.0, 0.0)), 70)
    now = health(system)
    assert now["pressure sensor"].condition is Condition.SILENT
    assert now["acquisition node"].condition is now["altimeter"].condition is Condition.WELL
    assert lines(system)["pressure sensor"] == ("silent", BAD)
    now = health(stepped(system, 5))
    assert system.coordinator.view is not None
    silent_for = system.coordinator.view.health.t - 60.0 + 1.0
    assert silent_for > 5.0
    assert now["altimeter"].heard - now["pressure sensor"].heard == silent_for


def test_a_shore_that_speaks_is_heard() -> None:
    system = stepped(started(), 20)
    assert health(system)["radio"].condition is Condition.WAITING
    system.link.take(b"\x00" * 7, 20.0)
    now = health(stepped(system, round(HEALTH_EVERY)))["radio"]
    assert (now.condition, now.heard) == (Condition.WELL, 7)


def test_strangers_are_named() -> None:
    system = stepped(started(), 60)
    once(system, "Depth", lambda _, frame: (frame, Frame(0x333, b""), Frame(0x123, b"\x01")))
    stepped(system, 2)
    assert system.coordinator.view is not None
    assert system.coordinator.view.health.unknown == (0x123, 0x333)


def test_the_log_has_every_source_now_and_then_and_each_change_at_once() -> None:
    system = stepped(started(Fault("brown_out", "motion", 60.0, 20.0, 0.5)), 200)
    logbook, disk = system.coordinator.recorder.logbook, system.inject.disk
    assert logbook is not None
    assert disk is not None
    logbook.sync(200.0)
    (name,) = [name for name in disk.sizes() if "essential" in name]
    told = read_log(disk.read(name), name).columns("health")
    for number in range(len(SOURCES)):
        assert told["source"].count(number) >= 4  # at 0, 60, 120 and 180 s
    motion = [
        (t, CONDITIONS[condition])
        for t, source, condition in zip(told["t"], told["source"], told["condition"], strict=True)
        if SOURCES[source] == "motion node" and CONDITIONS[condition] != "late"
    ]
    changes = [motion[0], *(after for before, after in itertools.pairwise(motion) if before[1] != after[1])]
    assert [condition for _, condition in changes] == ["well", "silent", "well"]
    assert changes[1][0] == 63.0  # last heard at 59 s, silent after 3.5 s


def test_a_vehicle_without_altimeter_misses_none(monkeypatch: pytest.MonkeyPatch) -> None:
    usual = loop.coordinator_settings
    monkeypatch.setattr(loop, "coordinator_settings", lambda *a: replace(usual(*a), has_altimeter=False))
    assert health(stepped(started(), 20))["altimeter"].condition is Condition.OFF


def test_a_node_of_another_version_is_refused() -> None:
    system = stepped(started(), 12)
    other = Encoder().frame(
        "AcquisitionInformation", hardware=0, version_major=0, version_minor=0, version_patch=0,
        database_hash=database_hash() ^ 1,
    )  # fmt: skip
    once(system, "AcquisitionInformation", lambda *_: (other,))
    stepped(system, 9)
    now = health(system)
    assert (now["acquisition node"].condition, now["motion node"].condition) == (Condition.REFUSED, Condition.WELL)
    assert lines(system)["acquisition"][1] == BAD
