"""The vehicle's software on ports and a clock of the test."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from stommel.messages.frames import Frame
from stommel.onboard.coordination.config import Configuration, read_configuration
from stommel.onboard.running.ports import RealPorts
from stommel.onboard.running.vehicle_software import Clock, VehicleSoftware
from tests.support.command import run_here


@dataclass
class Time:
    """A clock that goes on when somebody sleeps."""

    now: float = 100.0
    ahead: float = 1.8e9
    """UTC, less the monotonic time [s]."""
    watch: Callable[[], None] = lambda: None
    """Is called whenever somebody sleeps."""

    def sleep(self, seconds: float) -> None:
        self.now += max(seconds, 1e-3)
        self.watch()

    @property
    def clock(self) -> Clock:
        return Clock(lambda: self.now, lambda: self.ahead + self.now, self.sleep)


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
    """A serial port: what the vehicle wrote, and what it reads next."""

    room, waiting = 65_536, 0

    def __init__(self) -> None:
        self.written = b""
        self.incoming = b""

    def read(self, t: float) -> bytes:
        data, self.incoming = self.incoming, b""
        return data

    def write(self, data: bytes, t: float) -> int:
        self.written += data
        return len(data)


def configured(folder: Path, change: Callable[[str], str] = str) -> Configuration:
    """The configuration of the paper's vehicle, with changes of its text."""
    assert run_here(folder, "vehicle", "config", "zju", "--output", folder).status == 0
    path = folder / "CONFIG.toml"
    path.write_text(change(path.read_text()))
    return read_configuration(path)


@dataclass
class Rig:
    """The software, and what it is put on."""

    vehicle: VehicleSoftware
    bus: Bus
    ports: dict[str, Port]
    bench: Port
    said: list[str]


def software(configuration: Configuration, time: Time, *, supervised: bool = False) -> Rig:
    bus, bench, ports, said = Bus(), Port(), {name: Port() for name in ("compass", "gnss", "radio")}, []
    real: Any = SimpleNamespace(bus=bus, serial=ports, bench=bench)
    assert set(RealPorts.__dataclass_fields__) == set(vars(real))
    vehicle = VehicleSoftware(configuration, real, said.append, time.clock, supervised=supervised)
    return Rig(vehicle, bus, ports, bench, said)
