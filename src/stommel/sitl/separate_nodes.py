"""Both nodes in processes of their own, in place of those in ours."""

import multiprocessing
from collections.abc import Callable, Sequence
from contextlib import suppress
from math import inf
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from stommel.messages.adapters import Adapter
from stommel.messages.bus import CanBus
from stommel.messages.frames import Frame
from stommel.onboard.execution.acquisition_io import AcquisitionOutputs, AcquisitionReadings
from stommel.onboard.execution.motion_io import AT_REST, DriveOutputs, MotionReadings
from stommel.sitl.equipment import acquisition_settings, motion_settings
from stommel.sitl.multicast import CoordinatorsBus
from stommel.sitl.node_process import Settings, serve
from stommel.sitl.system import System

STARTED_WITHIN = 60.0
"""The longest that a process takes to start on a busy machine [s]."""
ANSWERS_WITHIN = 5.0
"""A process that says nothing for so long hangs, and is ended [s]."""
_ENDS_WITHIN = 2.0
_DEAD = AcquisitionOutputs(0, False, inf, False, b"")


class NodeProcess:
    """A process that is a node, as long as it lives; afterwards it says nothing, as a board without power."""

    def __init__(
        self,
        name: str,
        settings: Settings,
        multicast: Adapter | None,
        say: Callable[[str], None],
        parameters: Path | None = None,
    ) -> None:
        spawning = multiprocessing.get_context("spawn")  # a copy of our threads and terminal would do harm
        self._connection, theirs = spawning.Pipe()
        self._name, self._say = name, say
        self._process: BaseProcess | None = spawning.Process(
            target=serve, args=(theirs, settings, multicast, parameters), name=name, daemon=True
        )
        self._process.start()
        theirs.close()
        self._started = False

    @property
    def pid(self) -> int | None:
        """Number of its process; None once that has ended."""
        return None if self._process is None else self._process.pid

    def step(self, t: float, frames: Sequence[Frame], readings: tuple[Any, ...], more: float | bytes) -> Any:
        """Let it take one step; None if it is dead."""
        if self._process is None:
            return None
        if not self._started:
            self._started = self._answer(self._connection, STARTED_WITHIN) is not None
        try:
            self._connection.send((t, [tuple(frame) for frame in frames], tuple(readings), more))
        except OSError:
            return self._died()
        return self._answer(self._connection, ANSWERS_WITHIN)

    def _answer(self, connection: Connection, within: float) -> Any:
        try:
            if connection.poll(within):
                return connection.recv()
        except (EOFError, OSError):
            pass
        return self._died()

    def _died(self) -> None:
        if self._process is not None:
            self.close()
            self._say(f"the process of the {self._name} node has ended: from now on it is silent")

    def close(self) -> None:
        """End its process, whatever it does."""
        process, self._process = self._process, None
        with suppress(OSError):
            self._connection.close()
        if process is None:
            return
        process.join(_ENDS_WITHIN if self._started else 0.0)  # it ends by itself when the connection does
        if process.is_alive():
            process.kill()
            process.join()
        process.close()


class _RemoteMotion:
    def __init__(self, process: NodeProcess) -> None:
        self.process = process

    def step(
        self, t: float, frames: list[Frame], readings: MotionReadings, interval: float
    ) -> tuple[list[Frame], DriveOutputs]:
        answer = self.process.step(t, frames, readings, interval)
        if answer is None:
            return [], AT_REST
        return [Frame(*frame) for frame in answer[0]], DriveOutputs(*answer[1])


class _RemoteAcquisition:
    def __init__(self, process: NodeProcess) -> None:
        self.process = process

    def step(
        self, t: float, frames: Sequence[Frame], readings: AcquisitionReadings, ctd_bytes: bytes
    ) -> tuple[list[Frame], AcquisitionOutputs]:
        answer = self.process.step(t, frames, readings, ctd_bytes)
        if answer is None:
            return [], _DEAD
        return [Frame(*frame) for frame in answer[0]], AcquisitionOutputs(*answer[1])


class SeparateNodes:
    """Puts both nodes of a system that has not yet stepped into processes of their own, and ends these on leaving.

    Parameters
    ----------
    system
        Whose nodes they are; where it keeps their parameters, they do.
    multicast
        Over which frames go in real time; None: over the connections, in lockstep with virtual time.
    say
        Is told when a process ends before its time.

    Raises
    ------
    BusError
        The bus cannot be opened.
    """

    def __init__(
        self, system: System, multicast: Adapter | None = None, say: Callable[[str], None] = lambda _: None
    ) -> None:
        self._system, self._multicast, self._say = system, multicast, say
        self.processes: dict[str, NodeProcess] = {}
        """By name: `motion` and `acquisition`."""
        self._bus: CoordinatorsBus | None = None

    def __enter__(self) -> Self:
        setup, system = self._system.plant.setup, self._system
        machinery = setup.equipment.plant
        settings: dict[str, Settings] = {
            "motion": motion_settings(machinery, setup.orders),
            "acquisition": acquisition_settings(machinery),
        }
        if self._multicast is not None:
            self._bus = system.bus = CoordinatorsBus(CanBus(self._multicast))
        for name, of_node in settings.items():
            self.processes[name] = NodeProcess(name, of_node, self._multicast, self._say, system.parameters)
        system.motion = _RemoteMotion(self.processes["motion"])
        system.acquisition = _RemoteAcquisition(self.processes["acquisition"])
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        for process in self.processes.values():
            process.close()
        if self._bus is not None:
            self._bus.can.close()
