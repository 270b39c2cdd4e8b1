"""The shore's side of parameters: all of them for one message where nothing has changed, single ones, and writing."""

import random
from typing import NamedTuple

from stommel.link.endings import Ending, Progress, progress
from stommel.link.once import SESSIONS
from stommel.link.outbox import Outbox, Priority
from stommel.link.parameters.encoding import LONGEST_ID, ParameterValueError, fitting, value_of
from stommel.link.parameters.known import KnownParameters
from stommel.link.parameters.port import Value
from stommel.link.parameters.refreshing import Refreshing
from stommel.link.parameters.single import SingleOutcome, SingleParameters
from stommel.link.patience import WITHIN, Patience
from stommel.link.question import Pace, Question
from stommel.link.service import Received
from stommel.link.values import real, text, whole
from stommel.messages.mavlink import Fields

_AGAIN_AFTER = 2.0
"""Between two looks at a component that is still being read [s]."""
_MOST_CONTRADICTIONS = 5
_BEING_READ = 2


class SetOutcome(NamedTuple):
    """How the refreshing of one component's parameters ended."""

    component: int
    name: str
    ending: Ending
    words: str = ""


class _Refresh:
    """All components on their way."""

    def __init__(self, t: float, within: float, pace: Pace) -> None:
        self.began = t
        self.patience = Patience(t, within)
        self.question = Question(pace)
        self.expected: int | None = None
        """Components that have parameters."""
        self.heard: set[int] = set()
        """Numbers of the sets whose digest has been heard."""
        self.running: dict[int, Refreshing] = {}
        self.not_before = t
        """When digests may be asked for again."""
        self.contradictions: dict[int, int] = {}

    @property
    def lacks_digests(self) -> bool:
        return self.expected is None or len(self.heard) < self.expected


class ParameterClient:
    """Parameters of one vehicle, seen from the shore.

    Parameters
    ----------
    system
        The vehicle.
    known
        What is known of them from before; is kept up to date.
    draw
        Draws the number of this session.
    """

    def __init__(self, system: int, known: KnownParameters, draw: random.Random) -> None:
        self._system, self.known = system, known
        self._pace = Pace()
        self._single = SingleParameters(system, draw.randrange(1, SESSIONS), Pace())
        self._refresh: _Refresh | None = None
        self._writes: set[int] = set()
        self._ended: list[SingleOutcome] = []
        self.refreshed: tuple[SetOutcome, ...] | None = None
        """How the last refreshing ended; None while one runs, or before the first."""

    # what can be asked for

    def refresh(self, t: float, within: float = WITHIN) -> None:
        """Bring all parameters up to date; at the latest after so many seconds this has ended."""
        self._refresh, self.refreshed = _Refresh(t, within, self._pace), None

    def read(self, component: int, parameter: str, within: float = WITHIN) -> int:
        """Ask for one parameter; return the ticket of its outcome."""
        return self._single.read(component, parameter[:LONGEST_ID], within)

    def write(self, component: int, parameter: str, value: Value, within: float = WITHIN) -> int:
        """Set a parameter; return the ticket of its outcome.

        Raises
        ------
        ParameterValueError
            It is known that there is no such parameter, or that it cannot have the value.
        """
        known = self.known.sets.get(component)
        if known is not None:
            number = known.number(parameter)
            if number is None:
                raise ParameterValueError(f"{parameter}: the {known.name} has no such parameter")
            value = fitting(known.descriptions[number], value)
        ticket = self._single.write(component, parameter[:LONGEST_ID], float(value), within)
        self._writes.add(ticket)
        return ticket

    def outcomes(self) -> list[SingleOutcome]:
        """What became of single parameters since this was last asked."""
        outcomes, self._ended = self._ended, []
        return outcomes

    def progress(self, t: float) -> Progress:
        """How far the refreshing has come."""
        if self._refresh is None:
            return Progress(0, 0, None)
        done = [each.done for each in self._refresh.running.values()]
        gathered, of = sum(here for here, _ in done), sum(count for _, count in done)
        return progress(gathered, of, t - self._refresh.began)

    # the service

    def take(self, received: Received, t: float) -> None:
        """Take a message; what is not of the vehicle is passed over."""
        if received.system != self._system:
            return
        self._single.take(received, t)
        for outcome in self._single.outcomes():
            self._single_ended(outcome, t)
        refresh = self._refresh
        if refresh is not None:
            if refresh.patience.heard(t):
                refresh.question.again()
                for each in refresh.running.values():
                    each.again()
            self._take_refresh(refresh, received, t)
        elif received.name == "PARAM_VALUE":
            self._update(received)

    def _take_refresh(self, refresh: _Refresh, received: Received, t: float) -> None:
        running = refresh.running.get(received.component)
        if received.name == "PARAMETER_DIGEST":
            self._take_digest(refresh, received, t)
        elif running is not None and running.take(received, t):
            refresh.patience.helped()
            self._look(refresh, running, t)

    def _take_digest(self, refresh: _Refresh, received: Received, t: float) -> None:
        values, component = received.values, received.component
        refresh.expected = whole(values, "set_count")
        if whole(values, "set_number") in refresh.heard:
            return
        refresh.patience.helped()
        if values["state"] == _BEING_READ:
            refresh.not_before = t + _AGAIN_AFTER
            return
        refresh.heard.add(whole(values, "set_number"))
        if not refresh.lacks_digests:
            refresh.question.answered(t)
        known = self.known.sets.get(component)
        running = refresh.running[component] = Refreshing(self._system, component, values, known, self._pace)
        self._look(refresh, running, t)

    def _look(self, refresh: _Refresh, running: Refreshing, t: float) -> None:
        """Whether a component has ended, or its digest has to be asked for anew."""
        if running.contradicts:
            count = refresh.contradictions[running.component] = refresh.contradictions.get(running.component, 0) + 1
            if count < _MOST_CONTRADICTIONS:
                del refresh.running[running.component]
                refresh.heard.discard(running.set_number)
            else:
                running.end_changing()
        if running.ending is not None and running.known is not None:
            self.known.sets[running.component] = running.known
        if not refresh.lacks_digests and all(each.ending is not None for each in refresh.running.values()):
            self._end(refresh, t)

    def _end(self, refresh: _Refresh, t: float, given_up: str = "") -> None:
        self.refreshed = tuple(
            SetOutcome(each.component, each.name, each.ending or Ending.FAILED, each.words or given_up)
            for each in refresh.running.values()
        )
        if given_up and refresh.lacks_digests:
            self.refreshed += (SetOutcome(0, "vehicle", Ending.FAILED, given_up),)
        self._refresh = None
        self.known.keep(t)

    def _single_ended(self, outcome: SingleOutcome, t: float) -> None:
        self._ended.append(outcome)
        known = self.known.sets.get(outcome.component)
        if outcome.value is not None and known is not None:
            self.known.sets[outcome.component] = known.with_value(outcome.parameter, outcome.value)
            if outcome.ticket in self._writes:
                self.known.keep(t)
        self._writes.discard(outcome.ticket)

    def _update(self, received: Received) -> None:
        """A value that the vehicle says to somebody else is as good."""
        known, values = self.known.sets.get(received.component), received.values
        number = None if known is None else known.number(text(values, "param_id"))
        if known is not None and number is not None and known.descriptions[number].kind == values["param_type"]:
            value = value_of(known.descriptions[number].kind, real(values, "param_value"))
            self.known.sets[received.component] = known.with_value(known.descriptions[number].id, value)

    def poll(self, t: float, outbox: Outbox) -> None:
        """Ask what is due."""
        self.known.keep_again(t)
        self._single.poll(t, outbox)
        for outcome in self._single.outcomes():
            self._single_ended(outcome, t)
        refresh = self._refresh
        if refresh is None:
            return
        if given_up := refresh.patience.given_up(t):
            self._end(refresh, t, given_up)
            return
        if outbox.room(Priority.COMMAND) < 1024:
            return
        is_quiet = refresh.patience.is_quiet(t)
        if refresh.lacks_digests and t >= refresh.not_before and refresh.question.is_due(t):
            refresh.question.asked(t, is_quiet=is_quiet)
            told: Fields = {"target_system": self._system, "target_component": 0}
            outbox.put(Priority.COMMAND, "PARAMETER_DIGEST_REQUEST", told)
        # one after the other: streams of several would look like gaps in each
        going = next((each for each in refresh.running.values() if each.ending is None), None)
        if going is not None:
            going.poll(t, outbox, is_quiet=is_quiet)
            self._look(refresh, going, t)
