"""The edge of the vehicle's software, on ports and a clock of the test. Oracle: what goes through them in a second."""

import errno
import os
from pathlib import Path
from typing import Any

import pytest

from stommel.files.folder_storage import FolderStorage
from stommel.messages.codec import Decoder, Received
from stommel.onboard.coordination.config import Configuration
from tests.onboard.running.rig import Bus, Time, configured, software
from tests.onboard.running.test_vehicle_links import orders


@pytest.fixture
def configuration(tmp_path: Path) -> Configuration:
    return configured(tmp_path)


def syncs(bus: Bus) -> int:
    decoder = Decoder()
    heard = [decoder.take(frame) for frame in bus.sent]
    assert all(isinstance(answer, Received) for answer in heard)
    return sum(isinstance(answer, Received) and answer.name == "Sync" for answer in heard)


def test_it_decides_once_a_second_and_asks_its_instruments(configuration: Configuration) -> None:
    time = Time()
    rig = software(configuration, time)
    figures = rig.vehicle.run(10.0)
    assert figures.decisions == 10
    assert figures.late == 0
    assert syncs(rig.bus) == 10
    assert rig.ports["compass"].written
    assert b"LOG COM1" in rig.ports["gnss"].written
    assert next(words for words in rig.said if not words.startswith("radio: ")).startswith("start-up")


def test_a_step_that_fails_is_told_and_the_next_one_is_done(configuration: Configuration) -> None:
    """Oracle: the software goes on, the nodes miss one Sync, and the log says why."""
    time = Time()
    rig = software(configuration, time)
    step, calls = rig.vehicle.coordinator.step, iter(range(100))

    def failing(*arguments: Any) -> Any:
        if next(calls) == 2:
            raise ZeroDivisionError("told to fail")
        return step(*arguments)

    rig.vehicle.coordinator.step = failing  # type: ignore[method-assign]
    figures = rig.vehicle.run(6.0)
    assert (figures.decisions, figures.exceptions) == (5, 1)
    assert syncs(rig.bus) == 5
    assert any("ZeroDivisionError: told to fail" in words for words in rig.said)
    log = next((configuration.folder / "log").glob("*essential*"))
    assert b"told to fail" in log.read_bytes()


def test_a_stop_ends_it_within_a_moment(configuration: Configuration) -> None:
    time = Time()
    rig = software(configuration, time)
    began = time.now
    rig.vehicle.run(1e6, lambda: time.now - began > 3.0)
    assert time.now - began < 3.2


def test_it_knows_how_often_it_has_started(configuration: Configuration) -> None:
    for starts in range(3):
        rig = software(configuration, Time())
        assert rig.vehicle.kept.kept.starts == starts
        rig.vehicle.run(2.0)


def test_when_a_mission_began_is_kept_when_the_disk_takes_it(
    configuration: Configuration, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The disk fails at its start; what a restart finds is the start, not the time at which the disk was well."""
    time = Time()
    rig = software(configuration, time)
    rig.vehicle.missions.take_whole(orders(configuration.folder))
    began = time.clock.utc()

    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with monkeypatch.context() as broken:
        broken.setattr(FolderStorage, "create", full)
        rig.vehicle.take_mission(time.now)
        rig.vehicle.run(15.0)
        assert "mission: its start cannot be kept: No space left on device" in rig.said
        assert not rig.vehicle.missions.start_is_kept
    rig.vehicle.run(15.0)
    assert rig.vehicle.missions.start_is_kept
    assert software(configuration, Time()).vehicle.missions.started == began
