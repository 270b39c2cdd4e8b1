"""Commands ashore: given, said until they are answered, and followed to the last word."""

import random
from collections.abc import Callable, Iterator, Mapping, Sequence

from stommel.files.storage import Storage
from stommel.link.commands.report import Report, report_of
from stommel.link.commands.shore_queue import ShoreQueue, Waiting
from stommel.link.commands.states import LATEST, MOST_AHEAD, Command, Progress, State, When
from stommel.link.commands.table import ABORT, CommandError, command_named, packed
from stommel.link.outbox import Outbox, Priority
from stommel.link.service import VEHICLE_COMPONENT, Received, is_for
from stommel.link.timing import MOST as LONGEST_WAIT
from stommel.link.timing import RetransmissionTimer
from stommel.link.values import whole
from stommel.messages.mavlink import message_named

LEAST_VALID, MOST_VALID = 1.0, MOST_AHEAD / 1000.0 - 3600.0
"""How long a command may be valid [s]; below what the vehicle takes, for the clocks' sake."""
FOLLOW = 5.0
"""After which a command that is aboard is asked for [s]; the vehicle says changes by itself."""
AGAIN = 1.0
"""After which a command is said again that the vehicle could not take [s]."""
DISK_PATIENCE = 10.0
"""After which a disk that took nothing is tried again [s]."""
MOST_NOTES = 32
UNSENT = Progress(State.CANCELLED, words="taken back before it was sent")
TOO_LATE = Progress(State.EXPIRED, words="expired before it was sent")
SILENCE = 30.0
"""A vehicle that speaks after so long is asked at once [s]."""
SET_BACK = 1000
"""A clock that is behind by more was set back [ms]."""
_COMMAND, _ASK = "GLIDER_COMMAND", "GLIDER_COMMAND_ASK"


class CommandClient:
    """Gives commands to one vehicle.

    Commands arrive in the order in which they were given: one is said when the vehicle has the one before, or that one
    has expired. An abort waits for nothing.

    Parameters
    ----------
    system, component
        Who gives commands.
    vehicle
        System number of the vehicle.
    storage
        Keeps the queue.
    draw
        Draws ids; must be seeded from the operating system, so that no two senders draw the same.
    t
        Now [s]; the same time as is given to all methods.
    clock
        The clock [s] that our TIMESYNC tells, at such a time. It goes on when the program is started anew, as UTC does;
        if it is found set back, all open commands are taken back, since nobody can say when they expire.
    """

    def __init__(
        self,
        system: int,
        component: int,
        vehicle: int,
        storage: Storage,
        draw: random.Random,
        t: float,
        *,
        clock: Callable[[float], float] = lambda t: t,
    ) -> None:
        self._me, self._vehicle = (system, component), (vehicle, VEHICLE_COMPONENT)
        self._draw, self._clock = draw, clock
        self._queue = ShoreQueue(storage)
        self.notes = self._queue.notes
        """What was found damaged or wrong, in words."""
        self.timer = RetransmissionTimer()
        self._problem, self._again = "", t
        self._heard_at = t
        self._now = self._queue.kept_at
        self._read_clock(t)

    # giving

    def give(
        self,
        name: str,
        parameters: Mapping[str, float],
        t: float,
        *,
        valid_for: float,
        when: When = When.UNTIL_EXPIRY,
        id: int | None = None,
    ) -> int:
        """Give a command, and return its id, which is drawn unless it was drawn before; it is on the disk.

        Raises
        ------
        CommandError
            There is no such command, a value is not allowed, too many are open, or the disk does not keep it.
        """
        kind = command_named(name)
        if not LEAST_VALID <= valid_for <= MOST_VALID:
            raise CommandError(f"{name}: valid for {valid_for:g} s; must be from {LEAST_VALID:g} to {MOST_VALID:g} s")
        now = self._read_clock(t)
        given = max([now, *(entry.command.given + 1 for entry in self._queue.waiting.values() if entry.last is None)])
        given = given if given - now < SET_BACK else now
        expires = now + round(valid_for * 1000.0)
        id = id or self._draw.getrandbits(64) or 1
        self._queue.add(Waiting(Command(id, kind.number, packed(kind, parameters), when, given, expires)), now)
        return id

    def abort(self, t: float, *, valid_for: float, id: int | None = None) -> int:
        """Give an abort, and take back all that is open; return the abort's id.

        Raises
        ------
        CommandError
            As `give`.
        """
        before = [entry for entry in self._open() if entry.command.number != ABORT]
        id = self.give("abort", {}, t, valid_for=valid_for, id=id)
        self._take_back(before, t)
        return id

    def cancel(self, id: int, t: float) -> None:
        """Take a command back: for good if it was not sent, else if the vehicle has not begun it; `report` tells.

        Raises
        ------
        CommandError
            There is no such command.
        """
        self._read_clock(t)
        entry = self._entry(id)
        if entry.last is None:
            self._take_back([entry], t)

    def _take_back(self, entries: Sequence[Waiting], t: float) -> None:
        entries = [entry for entry in entries if not entry.cancel]
        for entry in entries:
            entry.cancel, entry.due, entry.tries = True, t, 0
        if entries:
            self._keep(t)
            self._end_unsent(t)

    def _end_unsent(self, t: float) -> None:
        """Say the last word of commands that were not sent, and will not be; not before the disk has it."""
        now, ended = self._shown(t), []
        for entry in self._open():
            if not entry.sent and t >= entry.due and (entry.cancel or now >= entry.command.expires):
                entry.last = UNSENT if entry.cancel else TOO_LATE
                ended.append(entry)
        if ended and not self._keep(t):
            for entry in ended:
                entry.last, entry.due = None, t + DISK_PATIENCE

    # what became of them

    def report(self, id: int, t: float) -> Report:
        """Return what became of a command, as far as it is known.

        Raises
        ------
        CommandError
            There is no such command.
        """
        return report_of(self._entry(id), self._shown(t))

    def reports(self, t: float) -> list[Report]:
        """Return all, in the order in which they were given."""
        return [self.report(id, t) for id in self._queue.waiting]

    def forget(self, id: int, t: float) -> None:
        """Drop a command that has its last word, or whose outcome nobody wants to know any more.

        Raises
        ------
        CommandError
            There is no such command, or the vehicle may still execute it: cancel it first, or wait.
        """
        entry, now = self._entry(id), self._read_clock(t)
        if entry.last is None and now < entry.command.expires:
            raise CommandError(f"command {id:016x}: may still be executed; cancel it, or wait until it has expired")
        del self._queue.waiting[id]
        self._keep(t)

    def _entry(self, id: int) -> Waiting:
        entry = self._queue.waiting.get(id)
        if entry is None:
            raise CommandError(f"command {id:016x}: there is none")
        return entry

    # the link

    def take(self, received: Received, t: float) -> None:
        """Take a message at a time [s]."""
        if received.system != self._vehicle[0]:
            return
        if t - self._heard_at >= SILENCE:
            for entry in self._open():
                entry.due, entry.tries = t, 0
        self._heard_at = max(t, self._heard_at)
        if received.name != "GLIDER_COMMAND_STATUS" or not is_for(received, *self._me):
            return
        values = received.values
        id, number, percent, asking = (whole(values, name) for name in ("id", "state", "percent", "asking"))
        known = self._queue.waiting.get(id)
        if known is not None and known.last is None and known.sent and number in list(State):
            self._hear(known, Progress(State(number), percent, str(values["words"])), asking, t)

    def _hear(self, entry: Waiting, progress: Progress, asking: int, t: float) -> None:
        """Take what the vehicle says of a command, as the answer to a question of this number, or to none."""
        if asking and asking == entry.asking:
            self.timer.measure(t - entry.asked_at)
            entry.tries, entry.asking = 0, 0
            entry.due = t + (FOLLOW if progress.state >= State.WAITING else AGAIN)
        entry.heard = progress
        if progress.state.is_last:
            entry.last = progress
            self._keep(t)

    def poll(self, t: float, outbox: Outbox) -> None:
        """Say what is due at a time [s]."""
        now = self._read_clock(t)
        if not self._queue.is_kept and t >= self._again:
            self._keep(t)
        self._end_unsent(t)
        for entry in self._sayable(now):
            priority = Priority.ABORT if entry.command.number == ABORT else Priority.COMMAND
            if t >= entry.due and outbox.room(priority) >= message_named(_COMMAND).layout.size:
                self._say(entry, priority, now, t, outbox)

    def _open(self) -> list[Waiting]:
        return [entry for entry in self._queue.waiting.values() if entry.last is None]

    def _sayable(self, now: int) -> Iterator[Waiting]:
        """What was sent, all aborts, and the first that was not sent if the vehicle has all before it."""
        is_free = True
        for entry in self._open():
            is_over = entry.cancel or now >= entry.command.expires
            if entry.sent or (not is_over and (is_free or entry.command.number == ABORT)):
                yield entry
            is_free = is_free and (now >= entry.command.expires or entry.is_aboard)

    def _say(self, entry: Waiting, priority: Priority, now: int, t: float, outbox: Outbox) -> None:
        """Say a command, or ask what became of it."""
        command = entry.command
        if not entry.sent:
            entry.sent = True
            if not self._keep(t) and command.number != ABORT:
                entry.sent, entry.due = False, t + self.timer.time_out
                return
        entry.asking = entry.asking % 255 + 1
        if now >= command.expires or entry.cancel or entry.is_aboard:
            name = _ASK
            values = command.values(*self._vehicle, entry.asking) | {"cancel": int(entry.cancel)}
            for other in ("parameters", "command", "when"):
                del values[other]
        else:
            name, values = _COMMAND, command.values(*self._vehicle, entry.asking)
        outbox.put(priority, name, values)
        wait = min(self.timer.time_out * 2.0 ** min(entry.tries, 8), LONGEST_WAIT)
        entry.tries += 1
        entry.asked_at, entry.due = t, t + wait

    def _keep(self, t: float) -> bool:
        """Bring the queue to the disk; whether it was possible. What is not kept is tried again."""
        if self._problem in self.notes:
            self.notes.remove(self._problem)
        try:
            self._queue.keep(self._shown(t))
        except OSError as error:
            self._problem = f"queue of commands: cannot be kept: {error.strerror or error}"
            self.notes.append(self._problem)
            self._again = t + DISK_PATIENCE
            return False
        return True

    def _read_clock(self, t: float) -> int:
        """The clock [ms]; takes all back if it was set back."""
        now = self._shown(t)
        if now < self._now - SET_BACK:
            self.notes.append(f"clock is {(self._now - now) / 1000.0:.0f} s behind: open commands are taken back")
            del self.notes[:-MOST_NOTES]
            self._heard_at = t
            self._now = now
            self._take_back(self._open(), t)
        self._now = now
        return now

    def _shown(self, t: float) -> int:
        """What the clock shows at a time [ms]."""
        shown = self._clock(t)
        if not 0.0 <= shown < LATEST / 1000.0:
            raise CommandError(f"clock shows {shown:g} s; must be from 0 to {LATEST / 1000.0:g} s")
        return int(shown * 1000.0)
