"""A simulated glider that flies beside the station in a process of its own, reached over the link like a real one."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from threading import Thread
from types import TracebackType
from typing import Any

from stommel.errors import StommelError, one_line
from stommel.files.toml_reader import read_toml

SPEED = 20.0
"""Times real time, if nobody says."""
PATIENCE = 5.0
"""Time for the glider to end by itself [s]."""
_LONGEST_END = 4096
"""Of what it said, in which the last line is looked for [bytes]."""


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
        Of the station; its key, its log and what it prints lie there in `glider`.
    vehicle
        Its number.

    Raises
    ------
    StommelError
        There is no such mission, or it is none.
    """

    def __init__(self, scenario: str, speed: float, folder: Path, vehicle: int = 1) -> None:
        from stommel.simulation.scenario.shipped import mission_path

        self.folder, self.speed, self.vehicle = folder, speed, vehicle
        self._mission = mission_path(scenario)
        self._told = read_toml(self._mission)
        self._folder = folder / "glider"
        self.key = self._folder / f"vehicle-{vehicle}.key"
        self.words = self._folder / "glider.txt"
        """What it prints."""
        self._port = 0
        """Known once it is started."""
        self._process: subprocess.Popen[bytes] | None = None
        self._ended = ""

    @property
    def address(self) -> str:
        """Where the station reaches it, once it is started."""
        return f"tcp:127.0.0.1:{self._port}"

    @property
    def settings(self) -> dict[str, Any]:
        """How a station reaches it, once it is started."""
        model = str(self._told.get("vehicle", "zju"))
        if model.endswith(".toml"):
            model = str((self._mission.parent / model).resolve())
        return {
            "vehicle": self.vehicle, "name": f"Glider {self.vehicle}", "model": model,
            "link": self.address, "key": self.key, "speed": self.speed, "simulated": True,
        }  # fmt: skip

    @property
    def ended(self) -> str:
        """Why it flies no more; empty while it flies."""
        if self._process is None or (status := self._process.poll()) is None:
            return ""
        if not self._ended:
            self._ended = ended_words(status, self.words)
        return self._ended

    def __enter__(self) -> "SimulatedGlider":
        """Start it.

        Raises
        ------
        SimulatedGliderError
            Its folder cannot be written, or no port is free.
        """
        from stommel.link.transports.inherited import reserved

        try:
            self._folder.mkdir(parents=True, exist_ok=True)
            self._make_key()
            # the glider gets the socket itself: a port that is only known to be free may be taken a moment later
            with self.words.open("wb") as said, reserved("127.0.0.1") as port:
                self._port = port.getsockname()[1]
                # a session of its own: Ctrl-C is for the station, which ends it
                self._process = subprocess.Popen(
                    self._command(port.fileno()), stdin=subprocess.PIPE, stdout=said, stderr=said,
                    start_new_session=True, pass_fds=[port.fileno()],
                )  # fmt: skip
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
        if self._process.stdin is not None:
            self._process.stdin.close()

    def _make_key(self) -> None:
        from stommel.link.signing.key_file import KeyFile, new_keys

        if not self.key.exists():
            KeyFile(self.key).write(new_keys(self.vehicle, time.time()))

    def _command(self, socket: int) -> list[str]:
        program = f"from stommel.cli import main; from stommel.cli.station.simulated import fly; fly(main, {socket})"
        return [
            sys.executable, "-c", program,
            "sitl", "fly", os.fspath(self._mission.resolve()), "--speed", f"{self.speed:g}", "--no-live",
            "--link", f"tcp-listen:127.0.0.1:{self._port}", "--key", os.fspath(self.key),
            "--log", os.fspath(self._folder / "log"),
        ]  # fmt: skip


def ended_words(status: int, said: Path) -> str:
    """Why a simulated glider flies no more, in words, from its status and the last that it said into a file."""
    if status == 0:
        return "the simulated flight is over; start the station again for another one"
    if status < 0:
        try:
            name = signal.Signals(-status).name
        except ValueError:
            name = str(-status)
        return f"the program of the simulated glider was ended from outside ({name}); start the station again"
    try:
        with said.open("rb") as file:
            file.seek(max(0, said.stat().st_size - _LONGEST_END))
            lines = file.read(_LONGEST_END).decode(errors="replace").strip().splitlines()
    except OSError:
        lines = []
    told = one_line(lines[-1], 200) if lines else "it has not said why"
    return f"the program of the simulated glider has failed: {told}; all that it said is in {said}"


def fly(main: Callable[[], None], socket: int) -> None:
    """Run the command line in the glider's process, until the station ends: killed, it could not end its glider.

    Parameters
    ----------
    main
        The command line.
    socket
        File descriptor of the socket that has the port at which the glider listens.
    """
    from stommel.link.transports.inherited import take_over

    take_over(socket)
    Thread(target=_end_with_station, daemon=True).start()
    main()


def _end_with_station() -> None:
    """Wait until nobody holds the other end of the standard input; nothing is ever written to it."""
    os.read(0, 1)
    os.kill(os.getpid(), signal.SIGINT)
