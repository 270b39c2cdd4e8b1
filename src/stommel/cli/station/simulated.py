"""A simulated glider that flies beside the station in a process of its own, reached over the link like a real one."""

import os
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path
from types import TracebackType

from stommel.errors import StommelError

PATIENCE = 5.0
"""Time for the glider to end by itself [s]."""


class SimulatedGliderError(StommelError):
    """The simulated glider cannot be started."""


class SimulatedGlider:
    """Flies a mission at a multiple of real time until the block is left.

    Parameters
    ----------
    scenario
        A mission file, or a shipped mission.
    speed
        Times real time.
    folder
        For its key, its log and what it says.
    vehicle
        Its number.
    """

    def __init__(self, scenario: str, speed: float, folder: Path, vehicle: int = 1) -> None:
        self.scenario, self.speed, self.vehicle = scenario, speed, vehicle
        self.key = folder / f"vehicle-{vehicle}.key"
        self.words = folder / "glider.txt"
        """What it prints."""
        self._folder = folder
        self._port = _free_port()
        self._process: subprocess.Popen[bytes] | None = None

    @property
    def address(self) -> str:
        """Where the station reaches it."""
        return f"tcp:127.0.0.1:{self._port}"

    @property
    def ended(self) -> str:
        """Why it flies no more; empty while it flies."""
        if self._process is None or (status := self._process.poll()) is None:
            return ""
        told = self.words.read_text(encoding="utf-8", errors="replace").strip().splitlines()
        return f"the simulated glider ended with status {status}: {told[-1] if told else 'it said nothing'}"

    def __enter__(self) -> "SimulatedGlider":
        """Start it.

        Raises
        ------
        SimulatedGliderError
            Its folder cannot be written.
        """
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
            self._make_key()
            with self.words.open("wb") as said:
                # a session of its own: Ctrl-C is for the station, which ends it
                self._process = subprocess.Popen(
                    self._command(), stdin=subprocess.DEVNULL, stdout=said, stderr=said, start_new_session=True
                )
        except OSError as error:
            raise SimulatedGliderError(f"{error.filename or self._folder}: {error.strerror or error}") from None
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """End it as Ctrl-C does, and if need be at once."""
        if self._process is None:
            return
        self._process.send_signal(signal.SIGINT)
        try:
            self._process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()

    def _make_key(self) -> None:
        from stommel.link.signing.key_file import KeyFile, new_keys

        if not self.key.exists():
            KeyFile(self.key).write(new_keys(self.vehicle, time.time()))

    def _command(self) -> list[str]:
        return [
            sys.executable, "-c", "from stommel.cli import main; main()",
            "sitl", "fly", self.scenario, "--speed", f"{self.speed:g}", "--no-live",
            "--link", f"tcp-listen:127.0.0.1:{self._port}", "--key", os.fspath(self.key),
            "--log", os.fspath(self._folder / "log"),
        ]  # fmt: skip


def _free_port() -> int:
    """A TCP port of this machine on which nobody listens now."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        port: int = server.getsockname()[1]
        return port
