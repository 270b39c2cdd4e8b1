"""A simulated glider that lies at the surface, on the air for software that is not ours."""

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from math import degrees
from pathlib import Path

import pytest

from stommel.dynamics.state import X_EAST, X_NORTH
from stommel.link.parameters.port import COORDINATOR_COMPONENT, Description, ParameterKind, Value
from stommel.link.transports.opening import open_transport
from stommel.link.transports.transport import TransportError
from stommel.onboard.coordination.view import View
from stommel.sitl.flight import fly
from stommel.sitl.radio.outside import Outside
from stommel.sitl.real_time import Pace
from stommel.sitl.scenario import load_scenario
from stommel.sitl.system import System

SPEED = 5.0
"""Times real time: half an hour at the surface is six minutes of tests."""
READY = 60
"""Steps after which every check has passed, and the mission is started."""
SCENARIO = """
format = 1
name = "At the surface"
vehicle = "zju"
start_time = 2026-07-01T00:00:00Z
duration_days = 1
seed = 1
[start]
latitude_deg = 29.0
longitude_deg = 126.0
[[waypoints]]
latitude_deg = 29.5
longitude_deg = 126.0
[[waypoints]]
latitude_deg = 29.5
longitude_deg = 126.5
[dives]
depth_m = 20
pitch_deg = 35
least_speed_m_s = 0.35
[surface]
session_s = 1800
[ocean]
name = "south_china_sea"
"""


class _EndedError(Exception):
    """The test is over."""


class Afloat(threading.Thread):
    """Flies in a thread, and one client at a time may connect to it at a port of this machine."""

    def __init__(self, folder: Path) -> None:
        super().__init__(daemon=True)
        self._transport = open_transport("tcp-listen:127.0.0.1:0")
        self.port = int(self._transport.name.rpartition(":")[2])
        self.system = System(load_scenario(scenario_in(folder)).mission, shore=Outside(self._transport))
        self.failure: BaseException | None = None
        self._ends = threading.Event()
        for _ in range(READY):
            self.system.step()

    def run(self) -> None:
        try:
            fly(self.system, watchers=[self._watch], pace=Pace(SPEED))
        except _EndedError:
            pass
        except BaseException as error:  # noqa: BLE001 - told to the test
            self.failure = error

    def _watch(self, _: System) -> None:
        if self._ends.is_set():
            raise _EndedError

    def end(self) -> None:
        """Leave the air; the system may be flown on by whoever has it."""
        self._ends.set()
        self.join(20.0)
        self._transport.close()
        self.system.air.wait = None
        assert self.failure is None, self.failure
        session = self.system.link.session
        assert not session.failures, list(session.notes)

    @property
    def waypoints(self) -> list[tuple[float, float]]:
        """What the vehicle flies [deg]."""
        orders = self.system.coordinator.pilot.orders
        assert orders is not None
        return [(round(degrees(latitude), 6), round(degrees(longitude), 6)) for latitude, longitude in orders.waypoints]

    def values(self, component: int) -> dict[str, Value]:
        """Parameters of a component as they hold aboard."""
        (found,) = [each for each in self.system.link.parameters.sets() if each.component == component]
        pairs = zip(found.descriptions, found.values, strict=True)
        return {description.id: value for description, value in pairs if value is not None}

    @property
    def own_parameter(self) -> Description:
        """A parameter of the coordinator, by floating point."""
        own = next(each for each in self.system.link.parameters.sets() if each.component == COORDINATOR_COMPONENT)
        return next(each for each in own.descriptions if each.kind is ParameterKind.FLOAT32)

    @property
    def orders_text(self) -> bytes:
        """The file of what it flies."""
        return self.system.link.missions.texts()["active.orders"]

    @property
    def view(self) -> View:
        """The last decision aboard."""
        view = self.system.coordinator.view
        assert view is not None
        return view

    @property
    def place(self) -> tuple[float, float]:
        """Where it is in truth, to the north and the east of where it began [m]."""
        x = self.system.plant.setup.x
        return float(x[X_NORTH]), float(x[X_EAST])


@contextmanager
def afloat(folder: Path) -> Iterator[Afloat]:
    """A vehicle on the air until the block ends."""
    try:
        vehicle = Afloat(folder)
    except TransportError as error:
        pytest.skip(f"no loopback to connect over: {error}")
    vehicle.start()
    try:
        yield vehicle
    finally:
        vehicle.end()


def scenario_in(folder: Path) -> Path:
    """The scenario as a file."""
    path = folder / "afloat.toml"
    path.write_text(SCENARIO, "utf-8")
    return path
