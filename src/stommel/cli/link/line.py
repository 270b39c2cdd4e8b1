"""The line to a vehicle, as every verb of `stommel link` uses it: opened, driven until something is done, closed."""

import os
import random
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.numbers import count_option, number_option
from stommel.cli.paths import folder_parser
from stommel.cli.status import INTERRUPTED
from stommel.errors import StommelError

if TYPE_CHECKING:
    from stommel.files.folder_storage import FolderStorage
    from stommel.link.shore.shore_end import ShoreEnd
    from stommel.link.signing.guard import Guard
    from stommel.link.signing.key_file import KeyFile
    from stommel.link.transports.transport import Transport

LOOKS_EVERY = 0.01
"""Between two looks at the line [s]."""
FAST = 1e6
"""Rate of a line that is not known to be slow [bit/s]."""

ToOption = Annotated[
    str,
    typer.Option(
        "--to",
        metavar="ADDRESS",
        envvar="STOMMEL_LINK",
        help="Where the vehicle's radio is: serial:/dev/ttyUSB0:57600, tcp:HOST:PORT, udp:HOST:PORT, pty, ...",
    ),
]
KeyOption = Annotated[
    Path | None,
    typer.Option(
        "--key", metavar="KEY", envvar="STOMMEL_LINK_KEY", help="Key of the vehicle (`stommel link key new`)."
    ),
]
UnsignedOption = Annotated[
    bool, typer.Option("--unsigned", help="Speak to a vehicle that was told to believe everybody.")
]
VehicleOption = Annotated[
    int | None, count_option("--vehicle", 1, 250, "MAVLink system of the vehicle; the key's, or 1, if left out")
]
StateOption = Annotated[
    Path | None,
    typer.Option(
        "--state",
        metavar="FOLDER",
        parser=folder_parser("--state"),
        help="Folder of what must outlive the program, by vehicle: commands, stamps, parameters.",
    ),
]
WithinOption = Annotated[
    float, number_option("--within", 0.1, 604_800.0, "s", "Longest time to try, surfacings waited for")
]


class LinkError(StommelError):
    """The vehicle was not reached, or did not do what was asked."""


class Line:
    """The shore's end and its transport, in real time."""

    def __init__(self, end: "ShoreEnd", transport: "Transport", now: Callable[[], float]) -> None:
        self.end, self.transport, self.now = end, transport, now

    def look(self) -> None:
        """Hear and speak once."""
        from stommel.link.exchange import exchange

        exchange(self.end.session, self.transport, self.now())

    def until(self, done: Callable[[], bool], within: float, watch: Callable[[], None] | None = None) -> bool:
        """Drive the line until something is done, or a time is over [s]; whether it was done."""
        ends = self.now() + within
        while True:
            self.look()
            if watch is not None:
                watch()
            if done():
                return True
            if self.now() >= ends:
                return False
            time.sleep(LOOKS_EVERY)

    def require_vehicle(self, within: float) -> None:
        """Wait until the vehicle is heard.

        Raises
        ------
        LinkError
            It is not, with what there is to say about it.
        """
        if not self.until(lambda: self.end.is_heard(self.now()), within):
            raise LinkError(self.complaint(within))

    def complaint(self, within: float) -> str:
        """Why the vehicle was not heard."""
        end, vehicle = self.end, self.end.vehicle[0]
        what = f"vehicle {vehicle} was not heard within {within:g} s over {self.transport.name}"
        line, others = end.session.line.complaint(self.now()), sorted({system for system, _ in end.session.peers()})
        if self.transport.reason:
            return f"{what}: {self.transport.reason}"
        if line:
            return f"{what}: {line}"
        if end.guard.refusals.by_reason:
            return f"{what}: {'; '.join(end.guard.status)}"
        if others:
            return f"{what}; heard is {', '.join(f'vehicle {system}' for system in others)}: name it with --vehicle"
        if end.session.line.bytes:
            return f"{what}: {end.session.line.bytes} bytes came, but no sound frame of MAVLink 2"
        return f"{what}: nothing came; it is under water, out of reach, or its radio is off"


@contextmanager
def line_to(to: str, key: Path | None, unsigned: bool, vehicle: int | None, state: Path | None) -> Iterator[Line]:
    """Open the line to a vehicle.

    Raises
    ------
    StommelError
        The address, the key or the folder cannot be used.
    """
    from stommel.link.shore.shore_end import ShoreEnd, ShoreSettings
    from stommel.link.transports.address import read_address
    from stommel.link.transports.opening import open_transport

    keys, number = _keys(key, unsigned, vehicle)
    address = read_address(to, "--to")
    began, utc = time.monotonic(), time.time()

    def now() -> float:
        """UTC that goes on evenly, whoever sets the clock meanwhile."""
        return utc + (time.monotonic() - began)

    system = random.SystemRandom()
    settings = ShoreSettings(number, float(address.bit_rate or FAST), half_duplex=address.bit_rate is not None)
    with _storage(state, number) as storage:
        guard = _guard(keys, storage)
        transport = open_transport(address)
        try:
            end = ShoreEnd(settings, guard, system, os.urandom, storage, now())
            try:
                yield Line(end, transport, now)
            except LinkError as error:
                raise LinkError(f"{error}; {end.session.versions}" if end.session.versions else str(error)) from None
        except KeyboardInterrupt:
            typer.echo("interrupted; what has come is kept, and the same command goes on from there", err=True)
            raise typer.Exit(INTERRUPTED) from None
        finally:
            transport.close()


def _keys(key: Path | None, unsigned: bool, vehicle: int | None) -> tuple["KeyFile | None", int]:
    """The key file, if frames are signed, and the vehicle."""
    from stommel.link.signing.key_file import KeyFile

    if (key is None) != unsigned:
        told = "give the vehicle's key, or --unsigned for a vehicle that was told to believe everybody"
        raise typer.BadParameter(told if key is None else "a key signs; leave out --unsigned", param_hint="--key")
    if key is None:
        return None, vehicle or 1
    file = KeyFile(key)
    number = file.read().vehicle
    if vehicle not in (None, number):
        raise typer.BadParameter(f"{vehicle}: {key} is the key of vehicle {number}", param_hint="--vehicle")
    return file, number


def _guard(keys: "KeyFile | None", storage: "FolderStorage") -> "Guard":
    from stommel.link.service import SHORE_SYSTEM
    from stommel.link.signing.guard import Guard

    if keys is None:
        return Guard.unsigned(SHORE_SYSTEM)
    return Guard(SHORE_SYSTEM, keys, storage, time.time(), os.urandom)


@contextmanager
def _storage(state: Path | None, vehicle: int) -> Iterator["FolderStorage"]:
    """The folder of what must outlive the program, which no other program has meanwhile."""
    from stommel.files.folder_lock import FolderInUseError, locked
    from stommel.files.folder_storage import FolderStorage

    folder = _state_folder(state, vehicle)
    with ExitStack() as held:
        try:
            storage = FolderStorage(folder)
            held.enter_context(locked(folder))
        except FolderInUseError:
            told = "another `stommel link` speaks to this vehicle; wait for its end, or give another folder by --state"
            raise LinkError(f"{folder}: {told}") from None
        except OSError as error:
            raise LinkError(f"--state = {folder}: cannot be used: {error.strerror or error}") from None
        yield storage


def _state_folder(state: Path | None, vehicle: int) -> Path:
    """Where the terminal keeps what it must know tomorrow."""
    if state is not None:
        return state / f"vehicle-{vehicle}"  # a command for one vehicle never goes to another
    variable, default = (
        ("LOCALAPPDATA", "AppData/Local") if sys.platform == "win32" else ("XDG_STATE_HOME", ".local/state")
    )
    base = os.environ.get(variable)
    return (Path(base) if base else Path.home() / default) / "stommel" / f"vehicle-{vehicle}"


@contextmanager
def progress(what: str) -> Iterator[Callable[[float | None, str], None]]:
    """Bar on the error output of a share that is done, with words behind it; silent where nobody watches."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeElapsedColumn

    console = Console(stderr=True)
    columns: tuple[Any, ...] = (
        TextColumn(what), BarColumn(), TaskProgressColumn(), TimeElapsedColumn(), TextColumn("{task.fields[words]}")
    )  # fmt: skip
    with Progress(*columns, console=console, disable=not console.is_terminal, transient=True) as bar:
        task = bar.add_task(what, total=None, words="")

        def report(share: float | None, words: str) -> None:
            bar.update(task, total=None if share is None else 1.0, completed=share or 0.0, words=words)

        yield report
