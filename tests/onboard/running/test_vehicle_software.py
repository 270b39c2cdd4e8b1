"""The edge of the vehicle's software, on ports and a clock of the test. Oracle: what goes through them in a second."""

from dataclasses import dataclass, field
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from stommel.messages.codec import Decoder, Received
from stommel.messages.frames import Frame
from stommel.onboard.coordination.config import Configuration, read_configuration
from stommel.onboard.running.ports import RealPorts
from stommel.onboard.running.vehicle_software import Clock, VehicleSoftware
from tests.support.command import run_here


@dataclass
class Time:
    """A clock that goes on when somebody sleeps."""

    now: float = 100.0

    def sleep(self, seconds: float) -> None:
        self.now += max(seconds, 1e-3)

    @property
    def clock(self) -> Clock:
        return Clock(lambda: self.now, lambda: 1.8e9 + self.now, self.sleep)


@dataclass
class Bus:
    sent: list[Frame] = field(default_factory=list)

    def send(self, frame: Frame) -> bool:
        self.sent.append(frame)
        return True

    def receive(self) -> list[Frame]:
        return []

    def reports(self) -> list[str]:
        return []


class Port:
    def __init__(self) -> None:
        self.written = b""

    def read(self, t: float) -> bytes:
        return b""

    def write(self, data: bytes, t: float) -> int:
        self.written += data
        return len(data)


@pytest.fixture
def configuration(tmp_path: Path) -> Configuration:
    assert run_here(tmp_path, "vehicle", "config", "zju", "--output", tmp_path).status == 0
    return read_configuration(tmp_path / "CONFIG.toml")


def software(configuration: Configuration, time: Time) -> tuple[VehicleSoftware, Bus, dict[str, Port], list[str]]:
    bus, ports, said = Bus(), {name: Port() for name in ("compass", "gnss", "radio")}, []
    real: Any = SimpleNamespace(bus=bus, serial=ports)
    assert set(RealPorts.__dataclass_fields__) == set(vars(real))
    return VehicleSoftware(configuration, real, said.append, time.clock), bus, ports, said


def syncs(bus: Bus) -> int:
    decoder = Decoder()
    heard = [decoder.take(frame) for frame in bus.sent]
    assert all(isinstance(answer, Received) for answer in heard)
    return sum(isinstance(answer, Received) and answer.name == "Sync" for answer in heard)


def test_it_decides_once_a_second_and_asks_its_instruments(configuration: Configuration) -> None:
    time = Time()
    vehicle, bus, ports, said = software(configuration, time)
    figures = vehicle.run(10.0)
    assert figures.decisions == 10
    assert figures.late == 0
    assert syncs(bus) == 10
    assert ports["compass"].written
    assert b"LOG COM1" in ports["gnss"].written
    assert said[0].startswith("start-up")


def test_a_step_that_fails_is_told_and_the_next_one_is_done(configuration: Configuration) -> None:
    """Oracle: the software goes on, the nodes miss one Sync, and the log says why."""
    time = Time()
    vehicle, bus, _, said = software(configuration, time)
    step, calls = vehicle.coordinator.step, iter(range(100))

    def failing(*arguments: Any) -> Any:
        if next(calls) == 2:
            raise ZeroDivisionError("told to fail")
        return step(*arguments)

    vehicle.coordinator.step = failing  # type: ignore[method-assign]
    figures = vehicle.run(6.0)
    assert (figures.decisions, figures.exceptions) == (5, 1)
    assert syncs(bus) == 5
    assert any("ZeroDivisionError: told to fail" in words for words in said)
    log = next((configuration.folder / "log").glob("*essential*"))
    assert b"told to fail" in log.read_bytes()


def test_a_stop_ends_it_within_a_moment(configuration: Configuration) -> None:
    time = Time()
    vehicle, _, _, _ = software(configuration, time)
    began = time.now
    vehicle.run(1e6, lambda: time.now - began > 3.0)
    assert time.now - began < 3.2


def test_it_knows_how_often_it_has_started(configuration: Configuration) -> None:
    for starts in range(3):
        vehicle, _, _, _ = software(configuration, Time())
        assert vehicle.kept.kept.starts == starts
        vehicle.run(2.0)
