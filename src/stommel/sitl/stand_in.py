"""A simulated vehicle on real ports: whoever runs `stommel vehicle run` on them commands it, in real time.

Plant, nodes and instruments are those of the loop; in the coordinator's place stand a CAN bus and pseudo-terminals.
"""

import os
import time
import tty
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from types import TracebackType
from typing import Self

from stommel.errors import StommelError
from stommel.link.channel.settings import ChannelSettings
from stommel.messages.bus import CanBus
from stommel.messages.frames import Frame
from stommel.onboard.coordination.own_instruments import PORTS, RADIO
from stommel.onboard.execution.acquisition_node import AcquisitionNode
from stommel.onboard.execution.motion_node import MotionNode
from stommel.simulation.scenario.mission import Mission
from stommel.sitl.radio.air import LOOKS, Air, End
from stommel.sitl.radio.outside import MOST_WAITING, Outside
from stommel.sitl.real_time import Pace
from stommel.sitl.system import System

ANSWER_TIME = 1.0 - 1.0 / LOOKS
"""Share of a step within which the coordinator is heard before the nodes obey what they were told."""
_READ_AT_ONCE = 4096


class Terminals:
    """Pseudo-terminals in a folder, one of each name: what is written to one end is read at the other."""

    def __init__(self, folder: Path, names: Iterable[str]) -> None:
        self._ends: dict[str, tuple[int, int]] = {}
        self.paths: dict[str, Path] = {}
        """Of the vehicle's ends."""
        folder.mkdir(parents=True, exist_ok=True)
        for name in names:
            path = folder / name
            if path.exists() and not path.is_symlink():
                self.close()
                raise StommelError(f"{path}: is there already, and no port; name another folder")
            ours, theirs = os.openpty()
            tty.setraw(theirs)
            os.set_blocking(ours, False)
            self._ends[name] = (ours, theirs)
            path.unlink(missing_ok=True)
            path.symlink_to(os.ttyname(theirs))
            self.paths[name] = path

    def read(self, name: str) -> bytes:
        """What the vehicle's software has written since the last call."""
        return _read(self._ends[name][0])

    def write(self, name: str, data: bytes) -> None:
        """Send bytes to the vehicle's software; what nobody reads is lost, as on a wire."""
        try:
            if data:
                os.write(self._ends[name][0], data)
        except BlockingIOError:
            pass

    def close(self) -> None:
        """Take the ports away."""
        for ends in self._ends.values():
            for end in ends:
                os.close(end)
        for path in self.paths.values():
            path.unlink(missing_ok=True)
        self._ends, self.paths = {}, {}


def _read(end: int) -> bytes:
    try:
        return os.read(end, _READ_AT_ONCE)
    except BlockingIOError:
        return b""


class _OtherProcess:
    """The coordinator on the other side of the ports, as the loop asks it."""

    class _Pilot:
        memory = None

    view = None
    pilot = _Pilot()

    def __init__(self, bus: CanBus, terminals: Terminals, wait: Callable[[float], None]) -> None:
        self._bus, self._terminals, self._wait = bus, terminals, wait

    def step(
        self, t: float, frames: Iterable[Frame], bytes_in: Mapping[str, bytes]
    ) -> tuple[list[Frame], dict[str, bytes]]:
        """Send what nodes and instruments say; after a while return what was answered."""
        for frame in frames:
            self._bus.send(frame)
        for name, data in bytes_in.items():
            self._terminals.write(name, data)
        self._wait(t)
        return self._bus.receive(), {name: self._terminals.read(name) for name in bytes_in if name != RADIO}


class _RadioPort:
    """The radio's terminal, as a wire."""

    def __init__(self, terminals: Terminals) -> None:
        self._terminals = terminals

    def read(self, t: float) -> bytes:
        """Return what the vehicle's software has said."""
        del t
        return self._terminals.read(RADIO)

    def write(self, data: bytes, t: float) -> int:
        """Let the vehicle's software hear."""
        del t
        self._terminals.write(RADIO, data)
        return len(data)


class _OtherEnd(Outside):
    """The vehicle's end of the link on the other side of the port, as the loop asks it."""

    def observe(self, t: float) -> None:
        """Nothing is to be seen from here."""

    def rest(self, t: float) -> None:
        """Lose what is said to a radio without power."""
        self.poll(t, MOST_WAITING)


class _AirMeanwhile(Air):
    """The air, whose time passes while the coordinator's answer is waited for."""

    def pass_time(self, vehicle: End | None, t: float, step: float, offset: float, *, on: bool) -> None:
        """Do nothing: it has passed."""

    def meanwhile(self, vehicle: End, t: float, step: float, *, on: bool) -> None:
        """Let a step pass in real time, but for the last of its looks."""
        super().pass_time(vehicle, t, step, 0.0, on=on)


class StandIn:
    """Ports of a simulated vehicle; a context that takes them away at its end.

    Parameters
    ----------
    mission
        Where it floats and what the world is like; what it shall fly is the software's own affair.
    bus
        That the software uses too.
    folder
        In which the serial ports appear, by the names of the configuration's tables.
    radio
        What the air between the radio and the shore is like; as on a calm day if left out.
    shore
        Whoever is at the other end of the radio; nobody if left out.
    clock, sleep
        Of the computer.
    parameters
        Folder in which the nodes keep their parameters; None: they forget them with this object.
    """

    def __init__(
        self,
        mission: Mission,
        bus: CanBus,
        folder: Path,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], None] = time.sleep,
        radio: ChannelSettings | None = None,
        shore: End | None = None,
        parameters: Path | None = None,
    ) -> None:
        self.system = System(mission, parameters=parameters)
        self.terminals = Terminals(folder, PORTS)
        self._bus, self._clock, self._sleep = bus, clock, sleep
        self._pace = Pace(1.0, clock, sleep)
        self._air = _AirMeanwhile(self.system.plant, ChannelSettings() if radio is None else radio, shore)
        self._end = _OtherEnd(_RadioPort(self.terminals))
        self.system.air = self._air
        self.system.link = self._end  # type: ignore[assignment]
        self.system.coordinator = _OtherProcess(bus, self.terminals, self._wait)  # type: ignore[assignment]

    @property
    def modes(self) -> dict[str, str]:
        """What the nodes are about, by their names."""
        nodes = {"motion": self.system.motion, "acquisition": self.system.acquisition}
        return {
            name: node.link.modes.mode.value
            for name, node in nodes.items()
            if isinstance(node, MotionNode | AcquisitionNode)
        }

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.terminals.close()
        self._bus.close()

    def _wait(self, t: float) -> None:
        """Wait for the coordinator's answer; vehicle and shore speak to each other by radio meanwhile."""
        began = self._clock()
        self._air.wait = lambda now: self._sleep(max(0.0, began + now - t - self._clock()))
        self._air.meanwhile(self._end, t, self.system.plant.step, on=self.system.switched.radio)

    def run(self, seconds: float, stop: Callable[[], bool] = lambda: False) -> None:
        """Let a time of the vehicle pass [s], or until told to stop."""
        system = self.system
        until = system.plant.time + seconds
        while system.running and system.plant.time < until and not stop():
            self._pace.wait(system.plant.time)
            system.step()
