"""A station's commands without threads, in which anything may happen at any point, and what is true of them.

What the archive and the disk of the queue have outlives a crash; what was sent and executed is never undone. Each point
at which another thread could run, a disk could fail or the power could go asks the draw what happens there.
"""

import random
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from types import SimpleNamespace
from typing import Any

from stommel.archive import ArchiveError
from stommel.link.commands.client import CommandClient
from stommel.link.commands.states import State, When
from stommel.link.commands.table import CommandError
from stommel.link.outbox import Priority
from stommel.link.service import Received
from stommel.station.live.hub import Hub
from stommel.station.vehicles.abort_only import AbortOnly
from stommel.station.vehicles.command_rows import CommandRow, CommandRows
from stommel.station.vehicles.commands import Commands
from stommel.station.vehicles.opening import LateError, VehicleError
from tests.onboard.coordination.disk import Disk

T = 1_700_000_000.0


class CrashError(BaseException):
    """The station is killed."""


class Rows(CommandRows):
    """The table of commands, of which a transaction may fail before or after it is committed."""

    def __init__(self, sea: "Sea") -> None:
        self._sea = sea

    def _commit(self, change: Callable[[], Any]) -> Any:
        sea = self._sea
        sea.point()
        if sea.archive_fails:
            raise ArchiveError("the disk is full")
        if sea.draw.random() < sea.faults:
            raise ArchiveError("the server does not answer")
        found = change()
        sea.point()
        if sea.draw.random() < sea.faults:
            raise ArchiveError("the answer was lost on the way")
        return found

    def add(self, row: CommandRow) -> None:
        """Keep a row, once."""

        def keep() -> None:
            if row.id not in self._sea.rows:
                self._sea.rows[row.id] = row
                self._sea.told(row.id, row.state)

        self._commit(keep)

    def change(self, id: str, state: str, words: str, t: float) -> CommandRow | None:
        """Keep a state."""

        def keep() -> CommandRow | None:
            if id not in self._sea.rows:
                return None
            found = self._sea.rows[id] = self._sea.rows[id]._replace(state=state, words=words, changed=t)
            self._sea.told(id, state)
            return found

        kept: CommandRow | None = self._commit(keep)
        return kept

    def find(self, vehicle: int, id: str) -> CommandRow | None:
        """Look a row up."""
        return self._sea.rows.get(id)

    def open_ones(self, vehicle: int) -> list[CommandRow]:
        """Rows without a last word."""
        return [row for row in self._sea.rows.values() if not row.is_last]


class Storage(Disk):
    """The disk of the queue; a rename may have happened though it is told as failed."""

    sea: "Sea"

    def operate(self) -> bool:
        """Fail, or let the power go."""
        self.sea.point()
        if self.sea.draw.random() < self.sea.faults:
            raise OSError(5, "Input/output error")
        return super().operate()

    def rename(self, old: str, new: str) -> None:
        """Rename, and perhaps fail then."""
        super().rename(old, new)
        self.sea.point()
        if self.sea.draw.random() < self.sea.faults:
            raise OSError(5, "Input/output error")


class Outbox:
    """Everything that is put in leaves."""

    def __init__(self, sea: "Sea") -> None:
        self._sea = sea

    def room(self, _: Priority) -> int:
        """Always enough."""
        return 10_000

    def put(self, _: Priority, name: str, values: Mapping[str, Any], component: int | None = None) -> None:
        """Send."""
        if name == "GLIDER_COMMAND":
            self._sea.leave(f"{values['id']:016x}")
        self._sea.questions.append((values["id"], values["asking"]))
        self._sea.point()


class Line:
    """One vehicle's line: its thread runs when the draw says so."""

    vehicle = 1

    def __init__(self, sea: "Sea", client: CommandClient) -> None:
        self._sea, self.end = sea, SimpleNamespace(commands=client)
        self.clock = SimpleNamespace(of_link=lambda t: t, now=lambda: sea.t)
        self.followers: list[Any] = []
        self.archive_reason = ""
        self.late: list[Callable[[], None]] = []

    def ask(self, function: Callable[[Any, float], Any]) -> "Future[Any]":
        """Serve a request now, never, or when whoever asked has gone."""
        future: Future[Any] = Future()
        self._sea.line_runs()
        kind = self._sea.draw.choice(["now", "now", "now", "never", "late"])
        if kind == "now":
            future.set_running_or_notify_cancel()
            self._serve(future, function)
        if kind == "late":
            future.set_running_or_notify_cancel()
            self.late.append(lambda: self._serve(future, function))
        return future

    def _serve(self, future: "Future[Any]", function: Callable[[Any, float], Any]) -> None:
        try:
            future.set_result(function(self.end, self._sea.t))
        except Exception as error:  # noqa: BLE001 - told to whoever asked
            future.set_exception(error)

    def look(self) -> None:
        """One look of the line's thread: what was asked for, then followers, then what is said."""
        sea = self._sea
        while self.late:
            self.late.pop(0)()
        kept = not sea.archive_fails
        if kept:
            self.archive_reason = ""
            try:
                self.followers[0]._due = 0.0
                self.followers[0].look(self, sea.t)
            except ArchiveError as error:
                self.archive_reason = str(error)
        else:
            self.archive_reason = "the disk is full"
        sea.point()
        outbox: Any = Outbox(sea)
        if self.archive_reason:
            AbortOnly(self.end.commands).poll(sea.t, outbox)
        else:
            self.end.commands.poll(sea.t, outbox)


class Sea:
    """A station, its disks and a vehicle."""

    def __init__(self, draw: random.Random, *, crashes: float, faults: float) -> None:
        self.draw, self.crashes, self.faults = draw, crashes, faults
        self.t = T
        self.rows: dict[str, CommandRow] = {}
        self.sent: set[str] = set()
        self.executed: set[str] = set()
        self.questions: list[tuple[int, int]] = []
        self.claimed_unsent: set[str] = set()
        """Commands that people were told were not sent."""
        self.wrong: list[str] = []
        self.archive_fails = False
        self.is_calm = False
        self.storage = self._disk({})
        self.boot()

    def _disk(self, files: dict[str, bytes]) -> Storage:
        storage = Storage(files)
        storage.sea = self
        return storage

    # what is true

    def told(self, id: str, state: str) -> None:
        """The archive says something of a command."""
        if state == "not_sent":
            self.claimed_unsent.add(id)
            if id in self.sent:
                self.wrong.append(f"{id}: told as not sent after it was sent")
        if state == "done" and id not in self.executed:
            self.wrong.append(f"{id}: told as done, and was not")

    def leave(self, id: str) -> None:
        """A command leaves the station."""
        self.sent.add(id)
        if id in self.claimed_unsent:
            self.wrong.append(f"{id}: sent after it was told as not sent")

    # what happens

    def point(self) -> None:
        """Anything may happen here."""
        if not self.is_calm and self.draw.random() < self.crashes:
            raise CrashError

    def boot(self) -> None:
        """The station starts."""
        while not self._is_booted():
            pass

    def _is_booted(self) -> bool:
        try:
            client = CommandClient(255, 190, 1, self.storage, self.draw, self.t)
        except (CrashError, OSError):
            return False
        self.line = Line(self, client)
        lines: Any = {1: self.line}
        self.commands = commands = Commands.__new__(Commands)
        commands._rows, commands._hub, commands._lines = Rows(self), Hub(), lines
        commands._followers = {}
        commands.follow(lines[1])
        return True

    def crash(self) -> None:
        """The station is killed and started anew; now and then the disk of its queue is another one."""
        files = {name: bytes(content.data) for name, content in self.storage.files.items()}
        is_lost = self.draw.random() < 0.1
        self.storage = self._disk({} if is_lost else files)
        self.boot()

    def line_runs(self) -> None:
        """The line's thread runs for a while."""
        for _ in range(self.draw.randint(0, 2)):
            self.line.look()

    def answer(self) -> None:
        """The vehicle answers a question."""
        if not self.questions:
            return
        id, asking = self.questions.pop(self.draw.randrange(len(self.questions)))
        key = f"{id:016x}"
        state = self.draw.choice([State.DONE, State.WAITING, State.REFUSED, State.FAILED])
        if key in self.executed:
            state = State.DONE
        if key not in self.sent:
            state = State.CANCELLED  # it never heard of it, and is asked only once it is over or taken back
        if state is State.DONE:
            self.executed.add(key)
        values: dict[str, Any] = {
            "id": id, "state": int(state), "percent": 255, "asking": asking, "words": "", "target_system": 255,
            "target_component": 190,
        }  # fmt: skip
        self.line.end.commands.take(Received(1, 1, "GLIDER_COMMAND_STATUS", values), self.t)

    def step(self) -> None:
        """Something happens; the station may be killed in the middle of it."""
        doings: list[Callable[[], object]] = [
            lambda: self.commands.give(1, "ada", "hold", {}, valid_for_s=60.0, when=When.UNTIL_EXPIRY),
            lambda: self.commands.give(1, "ada", "hold", {}, valid_for_s=60.0, when=When.UNTIL_EXPIRY),
            lambda: self.commands.abort(1, "ada", 60.0), self.line.look, self.line.look, self.answer, self.answer,
            self._pass_time, self._turn_archive, self.crash,
        ]  # fmt: skip
        try:
            self.draw.choice(doings)()
        except CrashError:
            self.crash()
        except (ArchiveError, CommandError, VehicleError, LateError):
            pass

    def _pass_time(self) -> None:
        self.t += self.draw.choice([0.5, 5.0, 100.0])

    def _turn_archive(self) -> None:
        self.archive_fails = not self.archive_fails

    def calm_down(self) -> None:
        """Nothing fails any more, and time passes until all is over."""
        self.is_calm, self.archive_fails, self.faults = True, False, 0.0
        for _ in range(12):
            self.line.look()
            while self.questions:
                self.answer()
            self.t += 30.0
        self.line.look()
