"""Commands that came by radio, as the coordinator carries them out: what each waits for, and when it is done."""

from collections.abc import Callable
from math import isfinite
from typing import NamedTuple, Protocol

from stommel.errors import StommelError
from stommel.link.commands import table
from stommel.link.commands.port import Answer, Readiness
from stommel.link.commands.states import UNKNOWN_PERCENT, Command, Progress, State
from stommel.onboard.coordination.coordinator import Coordinator
from stommel.onboard.coordination.executive import State as Mode
from stommel.onboard.coordination.situation import OperatorRequests
from stommel.onboard.coordination.view import View

MOST_REMEMBERED = 64
"""Commands whose way is followed; of those that are over the oldest is forgotten."""
SELF_TEST_TIME = 180.0
"""Longest time that a self-test may take [s]."""

READY = Answer(Readiness.READY)


class Missions(Protocol):
    """The missions of the vehicle."""

    def fly_uploaded(self, number: int) -> str:
        """Fly the mission that was uploaded, if it has this number or the number is 0; words on what is flown now."""

    def fly_previous(self) -> str:
        """Fly the mission before this one; words on what is flown now."""


class _Begun(NamedTuple):
    """A command on its way."""

    command: Command
    t: float
    """When it was begun, time of the vehicle [s]."""
    depth: float
    """At that time [m]."""


Follow = Callable[["VehicleCommands", _Begun, View], Progress]

IN_PROGRESS = Progress(State.IN_PROGRESS)
DONE = Progress(State.DONE, 100)


class VehicleCommands:
    """Carries commands out.

    Parameters
    ----------
    coordinator
        Who decides.
    missions
        Holds what is flown.
    restart
        Starts the software anew; None where nobody would start it again.
    """

    def __init__(self, coordinator: Coordinator, missions: Missions, restart: Callable[[], None] | None = None) -> None:
        self.coordinator, self._missions, self._restart = coordinator, missions, restart
        self._begun: dict[int, _Begun] = {}
        self._over: dict[int, Progress] = {}

    @property
    def is_submerged(self) -> bool:
        """Whether the vehicle is under water, by all that is known."""
        view = self.coordinator.view
        return view is not None and view.safety.submerged

    def check(self, command: Command) -> Answer:
        """Say whether a command can be begun now."""
        if self.coordinator.view is None and command.number != table.ABORT:
            return Answer(Readiness.NOT_YET, "the software has just been switched on")
        if command.number in _AT_SURFACE and self.is_submerged:
            return Answer(Readiness.NOT_YET, "the vehicle is under water")
        if command.number in (table.SURFACE, table.RECALL) and not self.is_submerged:
            return READY if command.number == table.RECALL else Answer(Readiness.NEVER, "it is at the surface")
        if command.number == table.START and self.coordinator.pilot.orders is None:
            return Answer(Readiness.NEVER, "there is no mission aboard")
        if command.number == table.RADIO_TIME and self.coordinator.pilot.orders is None:
            return Answer(Readiness.NEVER, "there is no mission aboard")
        if command.number == table.RESTART and self._restart is None:
            return Answer(Readiness.NEVER, "nobody would start the software again")
        return READY

    def begin(self, command: Command) -> Progress:
        """Begin a command.

        Raises
        ------
        StommelError
            It failed.
        """
        view = self.coordinator.view
        t, depth = (0.0, 0.0) if view is None else (view.t, view.situation.readings.depth)
        requests = _REQUESTS.get(command.number)
        if requests is not None:
            self.coordinator.request(requests)
        elif (done := self._at_once(command)) is not None:
            return done
        self._begun[command.id] = _Begun(command, t, depth)
        while len(self._begun) > MOST_REMEMBERED:
            del self._begun[next(iter(self._begun))]
        return IN_PROGRESS

    def _at_once(self, command: Command) -> Progress | None:
        """What needs no decision; None where something is to be followed."""
        number, value = command.number, command.parameters[0] if command.parameters else 0.0
        if number == table.SWITCH_MISSION:
            return DONE._replace(words=self._missions.fly_uploaded(int(value)))
        if number == table.ROLL_BACK_MISSION:
            return DONE._replace(words=self._missions.fly_previous())
        if number == table.RADIO_TIME:
            self.coordinator.stay_at_surface(value)
            return DONE._replace(words="until another mission is taken")
        if number == table.SELF_TEST:
            self.coordinator.self_test()
            return None
        if number == table.RESTART and self._restart is not None:
            self._restart()
            return DONE._replace(words="the software starts anew")
        raise StommelError(f"command {number}: the vehicle does not know it")

    def progress(self, id: int) -> Progress | None:
        """Say how far a command is; None: it is not known here."""
        if id in self._over:
            return self._over[id]
        begun, view = self._begun.get(id), self.coordinator.view
        if begun is None:
            return None
        if view is None or view.t <= begun.t:
            return IN_PROGRESS
        progress = _FOLLOWED[begun.command.number](self, begun, view)
        if progress.state.is_last:
            del self._begun[id]
            self._over[id] = progress
            while len(self._over) > MOST_REMEMBERED:
                del self._over[next(iter(self._over))]
        return progress


# what became of each, by the decisions since


def _started(_: VehicleCommands, _begun: _Begun, view: View) -> Progress:
    executive = view.executive
    if executive.state is Mode.ABORT:
        return Progress(State.FAILED, words="an abort stands: clear it first")
    if not executive.started:
        return Progress(State.FAILED, words=f"it is not started: {executive.words}")
    waits = ", ".join(name for name in view.safety.unproven if name != "mission")
    return DONE._replace(words=f"unproven yet: {waits}" if waits else "")


def _held(_: VehicleCommands, _begun: _Begun, view: View) -> Progress:
    return DONE if not view.executive.started else IN_PROGRESS


def _come_up(_: VehicleCommands, begun: _Begun, view: View) -> Progress:
    if view.executive.surfaced:
        return DONE
    left = view.situation.readings.depth / begun.depth if begun.depth > 0.0 else 1.0
    if not isfinite(left):  # the pressure sensor is silent
        return IN_PROGRESS
    return Progress(State.IN_PROGRESS, min(max(round(100.0 * (1.0 - left)), 0), 99))


def _aborted(_: VehicleCommands, _begun: _Begun, view: View) -> Progress:
    return DONE if view.executive.state is Mode.ABORT else IN_PROGRESS


def _cleared(_: VehicleCommands, _begun: _Begun, view: View) -> Progress:
    left = ", ".join(alarm.name for alarm in view.safety.active)
    if view.executive.state is Mode.ABORT:
        return Progress(State.FAILED, words=f"still so: {left or 'the abort'}")
    return DONE._replace(words=f"still so: {left}" if left else "")


def _checked(_: VehicleCommands, _begun: _Begun, view: View) -> Progress:
    unproven = ", ".join(name for name in view.safety.unproven if name != "mission")
    if not unproven:
        return DONE
    if view.executive.state is Mode.START_UP:
        return Progress(State.IN_PROGRESS, UNKNOWN_PERCENT, f"unproven: {unproven}")
    return Progress(State.FAILED, words=f"unproven: {unproven}")


def _tested(commands: VehicleCommands, begun: _Begun, view: View) -> Progress:
    if (wrong := commands.coordinator.self_test_result) is None:
        if view.t - begun.t > SELF_TEST_TIME:
            return Progress(State.FAILED, words="the motion node has not told a result")
        return IN_PROGRESS
    return Progress(State.FAILED, words=f"does not follow: {wrong}") if wrong else DONE


_AT_SURFACE = frozenset(
    (table.CHECK, table.SELF_TEST, table.SWITCH_MISSION, table.ROLL_BACK_MISSION, table.RADIO_TIME, table.RESTART)
)
"""Commands that wait for the surface."""
_REQUESTS = {
    table.ABORT: OperatorRequests(abort=True),
    table.START: OperatorRequests(start=True),
    table.HOLD: OperatorRequests(hold=True),
    table.SURFACE: OperatorRequests(surface=True),
    table.RECALL: OperatorRequests(hold=True, surface=True),
    table.CLEAR: OperatorRequests(clear=True),
    table.CHECK: OperatorRequests(check=True),
}
_FOLLOWED: dict[int, Follow] = {
    table.ABORT: _aborted,
    table.START: _started,
    table.HOLD: _held,
    table.SURFACE: _come_up,
    table.RECALL: _come_up,
    table.CLEAR: _cleared,
    table.CHECK: _checked,
    table.SELF_TEST: _tested,
}
