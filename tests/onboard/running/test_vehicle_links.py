"""The radio and the bench of a running vehicle, on ports and a clock of the test.

Oracle: what the shore's end of the link hears and is told, and what the coordinator does.
"""

import os
import random
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from stommel.files.folder_storage import FolderStorage
from stommel.link.commands.states import State
from stommel.link.files.folder_disk import FolderDisk
from stommel.link.shore.shore_end import ShoreEnd, ShoreSettings
from stommel.link.signing.guard import Guard
from stommel.link.signing.key_file import KeyFile, new_keys
from stommel.onboard.coordination.config import Configuration
from stommel.onboard.running.vehicle_software import LAST_WORDS
from stommel.simulation.scenario.shipped import mission_path
from tests.onboard.running.rig import Port, Rig, Time, configured, software
from tests.support.command import run_here

KEY = new_keys(1, 1.79e9)


def with_key(folder: Path, change: Callable[[str], str] = str) -> Configuration:
    KeyFile(folder / "radio.key").write(KEY)
    return configured(folder, change)


def unsigned(text: str) -> str:
    assert "unsigned = false" in text
    return text.replace("unsigned = false", "unsigned = true")


class Shore:
    """A shore station at a port of the vehicle, as often as the software sleeps."""

    def __init__(self, folder: Path, port: Port, time: Time, *, signs: bool) -> None:
        self.port, self.time = port, time
        storage, guard = FolderStorage(folder / "shore"), Guard.unsigned(255)
        if signs:
            KeyFile(folder / "shore.key").write(KEY)
            guard = Guard(255, KeyFile(folder / "shore.key"), storage, self.now, os.urandom)
        settings = ShoreSettings(1, 57_600.0)
        self.end = ShoreEnd(settings, guard, random.Random(1), os.urandom, storage, self.now)

    @property
    def now(self) -> float:
        return 1.8e9 + self.time.now

    def __call__(self) -> None:
        said, self.port.written = self.port.written, b""
        self.end.take(said, self.now)
        self.port.incoming += self.end.poll(self.now, 4096)

    def give(self, name: str) -> int:
        return self.end.commands.give(name, {}, self.now, valid_for=600.0)

    def state(self, id: int) -> State:
        return self.end.commands.report(id, self.now).state

    def words(self) -> list[str]:
        return [text.words for text in self.end.heard.texts]


def met(
    folder: Path, configuration: Configuration, *, signs: bool, bench: bool = False, **more: Any
) -> tuple[Rig, Shore]:
    """A vehicle and a shore that have known each other for five seconds."""
    time = Time()
    rig = software(configuration, time, **more)
    shore = Shore(folder, rig.bench if bench else rig.ports["radio"], time, signs=signs)
    time.watch = shore
    rig.vehicle.run(5.0)
    return rig, shore


def test_a_shore_with_the_key_hears_and_commands(tmp_path: Path) -> None:
    rig, shore = met(tmp_path, with_key(tmp_path), signs=True)
    assert shore.end.is_heard(shore.now)
    assert {"HEARTBEAT", "GLIDER_STATE"} <= set(shore.end.heard.last)
    assert shore.end.heard.last["GLIDER_STATE"].values["alarms"] & (1 << 51) == 0
    held = shore.give("hold")
    rig.vehicle.run(10.0)
    assert shore.state(held) is State.DONE
    assert rig.vehicle.figures.link_failures == 0
    assert rig.vehicle.links.guard.refusals.by_reason.total() == 0
    assert shore.end.guard.refusals.by_reason.total() == 0


def no_key(folder: Path) -> str:
    (folder / "radio.key").unlink()
    return "No such file"


def damaged(folder: Path) -> str:
    path = folder / "radio.key"
    path.write_bytes(path.read_bytes().replace(b"key = ", b"key =  "))
    return "is damaged"


def readable(folder: Path) -> str:
    (folder / "radio.key").chmod(0o644)
    return "others may read it"


def of_another(folder: Path) -> str:
    KeyFile(folder / "radio.key").write(KEY._replace(vehicle=2))
    return "is the key of another vehicle; vehicle_id is 1"


@pytest.mark.parametrize("spoil", [no_key, damaged, readable, of_another])
@pytest.mark.parametrize("signs", [True, False])
def test_without_a_sound_key_nobody_is_believed_but_at_the_bench(
    tmp_path: Path, spoil: Callable[[Path], str], signs: bool
) -> None:
    """PX4/PX4-Autopilot#26847: signing was asked for, the key was missing, and everything was accepted."""
    configuration = with_key(tmp_path)
    why = spoil(tmp_path)
    rig, shore = met(tmp_path, configuration, signs=signs)
    held = shore.give("hold")
    rig.vehicle.run(20.0)
    assert shore.state(held) is not State.DONE
    assert rig.vehicle.links.guard.refusals.by_reason.total() > 0
    view = rig.vehicle.coordinator.view
    assert view is not None
    assert "radio key" in {alarm.name for alarm in view.safety.active}
    assert any("no key: nothing is accepted" in words and why in words for words in rig.said), rig.said
    if not signs:  # who signs believes no answer either
        assert shore.end.heard.last["GLIDER_STATE"].values["alarms"] & (1 << 51)
        assert "alarm: radio key" in shore.words()
    rig.vehicle.logbook.sync(0.0)
    assert any(why.encode() in path.read_bytes() for path in (tmp_path / "log").iterdir())
    (tmp_path / "bench").mkdir()
    rig, person = met(tmp_path / "bench", configuration, signs=False, bench=True)
    held = person.give("hold")
    rig.vehicle.run(10.0)
    assert person.state(held) is State.DONE


def test_the_unsigned_mode_has_to_be_chosen_and_is_told(tmp_path: Path) -> None:
    rig, shore = met(tmp_path, configured(tmp_path, unsigned), signs=False)
    held = shore.give("hold")
    rig.vehicle.run(15.0)
    assert shore.state(held) is State.DONE
    assert shore.end.heard.last["LINK_STATISTICS"].values["is_signing"] == 0
    assert any("unsigned mode: whoever is heard may command" in words for words in rig.said)


def test_a_command_of_the_bench_is_not_one_of_the_radio(tmp_path: Path) -> None:
    """Each remembers its own, in a folder of its own."""
    configuration = with_key(tmp_path)
    rig, shore = met(tmp_path, configuration, signs=True)
    held = shore.give("hold")
    rig.vehicle.run(10.0)
    assert shore.state(held) is State.DONE
    bench, radio = tmp_path / "parameters" / "bench", tmp_path / "parameters"
    assert "commands" in " ".join(path.name for path in radio.iterdir())
    assert list(bench.iterdir()) == []


def test_a_radio_without_power_is_not_spoken_to(tmp_path: Path) -> None:
    """What stands in the port is noise; the log and the decisions go on. Oracle: the bytes of the port."""
    time = Time()
    rig = software(configured(tmp_path, unsigned), time)
    coordinator = rig.vehicle.coordinator
    step = coordinator.step

    def dived(*arguments: Any) -> Any:
        done = step(*arguments)
        assert coordinator.view is not None
        coordinator.view = coordinator.view._replace(commands=coordinator.view.commands._replace(radio=False))
        return done

    coordinator.step = dived  # type: ignore[method-assign]
    rig.ports["radio"].incoming = bytes(range(256))
    figures = rig.vehicle.run(10.0)
    assert (rig.ports["radio"].written, rig.ports["radio"].incoming) == (b"", b"")
    assert (figures.decisions, figures.link_failures) == (10, 0)
    coordinator.step = step  # type: ignore[method-assign]
    rig.vehicle.run(3.0)
    assert rig.ports["radio"].written


def test_a_link_that_fails_ends_nothing(tmp_path: Path) -> None:
    rig, shore = met(tmp_path, with_key(tmp_path), signs=True)

    def failing(data: bytes, t: float) -> Any:
        raise ZeroDivisionError("told to fail")

    take = rig.vehicle.links.radio.link.session.take
    rig.vehicle.links.radio.link.session.take = failing  # type: ignore[method-assign]
    figures = rig.vehicle.run(10.0)
    assert figures.decisions == 15
    assert figures.exceptions == 0
    assert figures.link_failures > 100
    assert [words for words in rig.said if "told to fail" in words] == [
        "radio: failed: ZeroDivisionError: told to fail"
    ]
    rig.vehicle.links.radio.link.session.take = take  # type: ignore[method-assign]
    held = shore.give("hold")
    rig.vehicle.run(10.0)
    assert shore.state(held) is State.DONE


def test_a_restart_is_told_before_the_end(tmp_path: Path) -> None:
    rig, shore = met(tmp_path, with_key(tmp_path), signs=True, supervised=True)
    restart = shore.give("restart")
    began = shore.time.now
    figures = rig.vehicle.run(1000.0)
    assert figures.restart
    assert shore.time.now - began < LAST_WORDS + 5.0
    assert shore.state(restart) is State.DONE


def test_nobody_restarts_what_nobody_would_start_again(tmp_path: Path) -> None:
    rig, shore = met(tmp_path, with_key(tmp_path), signs=True)
    restart = shore.give("restart")
    assert not rig.vehicle.run(20.0).restart
    assert shore.end.commands.report(restart, shore.now).words == "nobody would start the software again"


def orders(folder: Path) -> bytes:
    done = run_here(
        folder, "orders", mission_path("kuroshio"), "--output", folder / "orders.toml", "--expires-hours", "2"
    )
    assert done.status == 0, done.err
    return (folder / "orders.toml").read_bytes()


def test_a_mission_by_radio_is_flown_until_its_time_is_over_by_utc(tmp_path: Path) -> None:
    rig, shore = met(tmp_path, with_key(tmp_path), signs=True)
    shore.end.orders.send(orders(tmp_path), shore.now)
    rig.vehicle.run(20.0)
    coordinator = rig.vehicle.coordinator
    assert coordinator.mission == 1
    assert coordinator.expires == pytest.approx(100.0 + 5.0 + 7200.0, abs=20.0)
    assert any(words.startswith("mission 1: ") for words in rig.said)
    shore.time.now += 3600.0  # the computer was off
    again = software(rig.vehicle.configuration, shore.time)
    again.vehicle.take_mission(shore.time.now)
    assert again.vehicle.coordinator.expires == pytest.approx(coordinator.expires, abs=1.0)
    shore.time.ahead -= 30.0 * 86_400.0  # its clock has lost the date: no more time than was given
    again.vehicle.take_mission(shore.time.now)
    assert again.vehicle.coordinator.expires == shore.time.now + 7200.0


def test_a_file_comes_home_and_another_goes_out(tmp_path: Path) -> None:
    rig, shore = met(tmp_path, with_key(tmp_path), signs=True)
    shore.end.orders.send(orders(tmp_path), shore.now)
    rig.vehicle.run(20.0)
    download = shore.end.download("missions/active.orders", FolderDisk(tmp_path / "home"), "active.orders")
    upload = shore.end.upload(b"look at the compass", "inbox/note.txt")
    rig.vehicle.run(30.0)
    assert download.state.is_over
    assert (tmp_path / "home" / "active.orders").read_bytes() == orders(tmp_path)
    assert upload.state.is_over
    assert (tmp_path / "inbox" / "note.txt").read_bytes() == b"look at the compass"
    ashore, aboard = shore.end.statistics.traffic, rig.vehicle.links.radio.link.statistics.traffic
    assert (ashore.new_bytes, aboard.new_bytes) == (len(orders(tmp_path)), len(b"look at the compass"))
    assert aboard.sent_bytes - aboard.again_bytes == ashore.new_bytes


def test_a_decision_is_told_once_however_often_it_is_looked_at(tmp_path: Path) -> None:
    """While the coordinator sleeps its last one stands: its alarms are not new, nor the outcomes of its writings."""
    rig, _ = met(tmp_path, with_key(tmp_path), signs=True)
    link, told = rig.vehicle.links.radio.link, []
    link.telemetry.observe = lambda seen: told.append(seen.view)  # type: ignore[method-assign]
    for later in (0.1, 5.0, 60.0):
        link.observe(rig.vehicle.coordinator.view.t + later)  # type: ignore[union-attr]
    assert told == []
    rig.vehicle.run(5.0)
    assert len(told) == len({id(view) for view in told}) > 1
