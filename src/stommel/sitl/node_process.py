"""A node in a process of its own: readings come over a connection, frames over it too or over a real bus.

The connection stands for the pins of the board: what its sensors say goes in, what its power stages do comes out. In
lockstep the frames go with them, and nothing depends on when the processes run. In real time they go over python-can's
multicast on this machine, as they would over a cable.
"""

import os
import signal
from collections.abc import Callable
from contextlib import ExitStack, suppress
from multiprocessing.connection import Connection
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from stommel.messages.adapters import Adapter
from stommel.messages.bus import CanBus
from stommel.messages.database import ACQUISITION, MOTION
from stommel.messages.frames import Frame
from stommel.onboard.execution.acquisition_io import AcquisitionReadings
from stommel.onboard.execution.acquisition_node import AcquisitionNode
from stommel.onboard.execution.motion_io import MotionReadings
from stommel.onboard.execution.motion_node import MotionNode
from stommel.onboard.nodes.acquisition_settings import AcquisitionSettings
from stommel.onboard.nodes.motion_settings import MotionSettings
from stommel.sitl.ctd_port import CtdPort
from stommel.sitl.nodes import store_of

if TYPE_CHECKING:
    from stommel.sitl.nodes import Acquisition, Motion

Settings = MotionSettings | AcquisitionSettings


class Asked(NamedTuple):
    """One step of a node."""

    t: float
    """[s]"""
    frames: list[tuple[int, bytes]]
    """For it, where they do not come over a bus."""
    readings: tuple[Any, ...]
    more: float | bytes
    """What else its `step` takes: the interval [s], or the CTD's bytes."""


def serve(connection: Connection, settings: Settings, multicast: Adapter | None, parameters: Path | None) -> None:
    """Be a node until the connection ends, its parameters in a folder; this is the main function of its process."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for whom started us, who then ends us
    with ExitStack() as open_things, suppress(EOFError, OSError):
        bus = None if multicast is None else open_things.enter_context(CanBus(multicast))
        step = _stepper(settings, parameters)
        connection.send(os.getpid())
        while True:
            asked = Asked(*connection.recv())
            frames = [Frame(*frame) for frame in asked.frames] if bus is None else bus.receive()
            said, outputs = step(asked.t, frames, asked.readings, asked.more)
            connection.send((_given(said, bus), tuple(outputs)))


def _stepper(settings: Settings, parameters: Path | None) -> Callable[..., tuple[list[Frame], tuple[Any, ...]]]:
    if isinstance(settings, MotionSettings):
        motion: Motion = MotionNode(settings, store=store_of(MOTION, parameters))
        return lambda t, frames, readings, interval: motion.step(t, frames, MotionReadings(*readings), interval)
    acquisition: Acquisition = AcquisitionNode(settings, store=store_of(ACQUISITION, parameters), ctd=CtdPort())
    return lambda t, frames, readings, data: acquisition.step(t, frames, AcquisitionReadings(*readings), data)


def _given(frames: list[Frame], bus: CanBus | None) -> list[tuple[int, bytes]]:
    """Frames for the connection; those that go over a bus are none of it."""
    if bus is None:
        return [(frame.identifier, frame.data) for frame in frames]
    for frame in frames:
        bus.send(frame)
    return []
