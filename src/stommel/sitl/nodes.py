"""What the loop asks of nodes and of their bus, wherever they run."""

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Protocol

from stommel.messages.database import ACQUISITION, MOTION
from stommel.messages.frames import Frame
from stommel.messages.parameter_files import ParameterFiles
from stommel.messages.parameters import MemoryStore, ParameterStore
from stommel.onboard.execution.acquisition_io import AcquisitionOutputs, AcquisitionReadings
from stommel.onboard.execution.motion_io import DriveOutputs, MotionReadings

FILES = {MOTION: "motion", ACQUISITION: "acquisition"}
"""Names of the nodes' parameter files."""


def store_of(node: int, folder: Path | None) -> ParameterStore:
    """Where a node keeps its parameters: in files of a folder, or as long as the flight lasts."""
    return MemoryStore() if folder is None else ParameterFiles(folder, FILES[node])


class Motion(Protocol):
    """The motion-control node."""

    def step(
        self, t: float, frames: list[Frame], readings: MotionReadings, interval: float
    ) -> tuple[list[Frame], DriveOutputs]:
        """Take frames and readings at a time [s]; return frames, and what the drives do for an interval [s]."""


class Acquisition(Protocol):
    """The data-acquisition node."""

    def step(
        self, t: float, frames: Sequence[Frame], readings: AcquisitionReadings, ctd_bytes: bytes
    ) -> tuple[list[Frame], AcquisitionOutputs]:
        """Take frames, readings and the CTD's bytes at a time [s]; return frames and switches."""


class Bus(Protocol):
    """What carries their frames."""

    def send(self, sender: int, frames: Iterable[Frame]) -> None:
        """Put the frames of a node on the bus."""

    def receive(self, node: int) -> list[Frame]:
        """Take what a node has heard since it asked last."""

    def load(self, seconds: float) -> float:
        """Share of a time for which the bus was busy."""
