"""Single parameters, asked for or written one after the other, each until it is answered or given up."""

from collections import deque
from dataclasses import dataclass
from math import isnan
from typing import NamedTuple

from stommel.link.endings import Ending
from stommel.link.outbox import Outbox, Priority
from stommel.link.parameters.encoding import value_of
from stommel.link.parameters.port import ParameterKind, Value, WriteError
from stommel.link.patience import WITHIN, Patience
from stommel.link.question import Pace, Question
from stommel.link.service import Received
from stommel.link.values import real, text, whole
from stommel.messages.mavlink import Fields


class SingleOutcome(NamedTuple):
    """What became of one parameter that was asked for or written."""

    ticket: int
    component: int
    parameter: str
    ending: Ending
    value: Value | None
    """That holds in the vehicle, as far as it said."""
    words: str = ""
    """Why it was refused or has failed."""


@dataclass
class _Single:
    ticket: int
    component: int
    parameter: str
    value: float | None
    """To be written; None: it is asked for."""
    within: float
    patience: Patience | None = None


class SingleParameters:
    """Requests for single parameters of one vehicle, in their order.

    Parameters
    ----------
    system
        The vehicle.
    session
        Drawn at the start of this software.
    pace
        Of this vehicle.
    """

    def __init__(self, system: int, session: int, pace: Pace) -> None:
        self._system, self._session = system, session
        self._question = Question(pace)
        self._waiting: deque[_Single] = deque()
        self._tickets = 0
        self._outcomes: list[SingleOutcome] = []

    def read(self, component: int, parameter: str, within: float = WITHIN) -> int:
        """Ask for a parameter; return the ticket of its outcome."""
        return self._queue(component, parameter, None, within)

    def write(self, component: int, parameter: str, value: float, within: float = WITHIN) -> int:
        """Set a parameter; return the ticket of its outcome."""
        return self._queue(component, parameter, value, within)

    def _queue(self, component: int, parameter: str, value: float | None, within: float) -> int:
        self._tickets += 1
        self._waiting.append(_Single(self._tickets, component, parameter, value, within))
        return self._tickets

    def outcomes(self) -> list[SingleOutcome]:
        """What became of requests since this was last asked."""
        outcomes, self._outcomes = self._outcomes, []
        return outcomes

    def take(self, received: Received, t: float) -> None:
        """Take a message of the vehicle."""
        if not self._waiting:
            return
        single = self._waiting[0]
        if single.patience is not None and single.patience.heard(t):
            self._question.again()
        values = received.values
        if values.get("param_id") != single.parameter or received.component != single.component:
            return
        if single.value is not None:
            if received.name == "PARAMETER_OUTCOME":
                self._take_outcome(single, values, t)
        elif received.name == "PARAM_VALUE" and values["param_type"] in list(ParameterKind):
            value = value_of(whole(values, "param_type"), real(values, "param_value"))
            self._end(single, Ending.WHOLE, value, "", t)
        elif received.name == "PARAM_ERROR":
            self._end(single, Ending.REFUSED, None, _error_words(whole(values, "error")), t)

    def _take_outcome(self, single: _Single, values: Fields, t: float) -> None:
        if (values["session"], values["number"]) != (self._session, single.ticket):
            return
        told = real(values, "value")
        value = None if isnan(told) else told
        if values["error"] == WriteError.NONE:
            self._end(single, Ending.WHOLE, value, "", t)
        else:
            words = text(values, "words") or _error_words(whole(values, "error"))
            self._end(single, Ending.REFUSED, value, words, t)

    def _end(self, single: _Single, ending: Ending, value: Value | None, words: str, t: float) -> None:
        self._waiting.popleft()
        self._question.answered(t)
        self._outcomes.append(SingleOutcome(single.ticket, single.component, single.parameter, ending, value, words))

    def poll(self, t: float, outbox: Outbox) -> None:
        """Ask what is due."""
        while self._waiting:
            single = self._waiting[0]
            single.patience = single.patience or Patience(t, single.within)
            given_up = single.patience.given_up(t)
            if not given_up:
                break
            self._question.forget()
            self._end(single, Ending.FAILED, None, given_up, t)
        else:
            return
        if self._question.is_due(t) and outbox.room(Priority.COMMAND) >= 64:
            self._question.asked(t, is_quiet=single.patience.is_quiet(t))
            self._say(single, outbox)

    def _say(self, single: _Single, outbox: Outbox) -> None:
        told: Fields = {
            "target_system": self._system, "target_component": single.component, "param_id": single.parameter,
        }  # fmt: skip
        if single.value is None:
            outbox.put(Priority.COMMAND, "PARAM_REQUEST_READ", {**told, "param_index": -1})
        else:
            told |= {"session": self._session, "number": single.ticket, "value": single.value}
            outbox.put(Priority.COMMAND, "PARAMETER_WRITE", told)


def _error_words(error: int) -> str:
    known = {
        WriteError.DOES_NOT_EXIST: "there is no such parameter",
        WriteError.OUT_OF_RANGE: "the value is out of its range",
        WriteError.SILENT: "its component is silent",
        WriteError.READ_ONLY: "it cannot be set",
    }
    return next((words for number, words in known.items() if number == error), f"the vehicle refuses it, error {error}")
