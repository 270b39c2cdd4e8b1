"""The vehicle's side of parameters: answers, streams, and carries values to where they are kept."""

from collections import deque
from collections.abc import Sequence
from math import nan
from typing import NamedTuple

from stommel.link.once import Arrival, Once
from stommel.link.outbox import Outbox, Priority
from stommel.link.parameters.encoding import (
    LONGEST_ID,
    LONGEST_WORDS,
    ParameterValueError,
    check_sets,
    description_fields,
    descriptions_digest,
    fitting,
    value_fields,
    value_of,
    values_digest,
)
from stommel.link.parameters.port import (
    COORDINATOR_COMPONENT,
    ParameterPort,
    ParameterSet,
    ParameterState,
    Value,
    WriteError,
    WriteOutcome,
)
from stommel.link.service import Received
from stommel.link.values import real, text, whole
from stommel.link.words import fitted
from stommel.messages.mavlink import Fields

_BACKLOG = 600
"""Bytes that may wait in the outbox when a stream goes on: what waits there long is old when it arrives."""
_MOST_WRITES, _MOST_ANSWERS = 64, 64


class _Asked(NamedTuple):
    """A value that was to be set, and by whom."""

    sender: tuple[int, int]
    session: int
    """0: by PARAM_SET."""
    number: int
    component: int
    parameter: str
    value: Value


class _Answer(NamedTuple):
    """A message that waits to be said."""

    name: str
    values: Fields
    component: int


class ParameterServer:
    """Serves the parameters of a port.

    Parameters
    ----------
    system
        The vehicle.
    port
        Where parameters are kept.

    Raises
    ------
    ParameterValueError
        The port describes a parameter that cannot be said.
    """

    def __init__(self, system: int, port: ParameterPort) -> None:
        self._system, self._port = system, port
        check_sets(port.sets())
        self._streams: dict[int, dict[int, None]] = {}
        """Numbers that are still to be said, by component."""
        self._singles: dict[tuple[int, int], None] = {}
        self._described: dict[tuple[int, int], None] = {}
        self._digests: dict[int, None] = {}
        self._answers: deque[_Answer] = deque(maxlen=_MOST_ANSWERS)
        self._writes: dict[int, _Asked] = {}
        self._once = Once()
        self._last: dict[tuple[int, int], _Answer] = {}
        """Outcome of the newest numbered writing of each sender."""
        self._takes = {
            "PARAM_REQUEST_LIST": self._list,
            "PARAM_REQUEST_READ": self._read,
            "PARAM_SET": self._set,
            "PARAMETER_DIGEST_REQUEST": self._digest,
            "PARAMETER_DESCRIPTION_REQUEST": self._describe,
            "PARAMETER_WRITE": self._write,
        }

    # what is asked

    def take(self, received: Received, t: float) -> None:  # noqa: ARG002 - as every service's
        """Take a message; what does not ask for parameters of this vehicle is passed over."""
        take = self._takes.get(received.name)
        if take is not None and received.values["target_system"] in (0, self._system):
            take(received)

    def _meant(self, received: Received) -> list[ParameterSet]:
        target = received.values["target_component"]
        return [each for each in self._port.sets() if target in (0, each.component)]

    def _list(self, received: Received) -> None:
        """A node that is silent does not answer, as any component that is dead."""
        for each in self._meant(received):
            if not each.is_silent and each.descriptions:
                going = self._streams.get(each.component, {})
                # what has been said already comes again behind the rest
                self._streams[each.component] = going | dict.fromkeys(range(len(each.descriptions)))

    def _read(self, received: Received) -> None:
        index, name = whole(received.values, "param_index"), fitted(text(received.values, "param_id"), LONGEST_ID)
        sets = self._meant(received)
        for each in sets:
            number = each.number(name) if index == -1 else index
            if number is None or not 0 <= number < len(each.descriptions):
                continue
            if each.is_silent or each.values[number] is None:
                self._error(received, each.component, number, each.descriptions[number].id, WriteError.SILENT)
            else:
                self._singles[each.component, number] = None
            return
        if sets:
            self._error(received, sets[0].component, index, name, WriteError.DOES_NOT_EXIST)

    def _error(self, received: Received, component: int, index: int, name: str, error: WriteError) -> None:
        """PARAM_ERROR to who asked."""
        told: Fields = {
            "target_system": received.system, "target_component": received.component,
            "param_index": index, "param_id": name, "error": int(error),
        }  # fmt: skip
        self._answers.append(_Answer("PARAM_ERROR", told, component))

    def _digest(self, received: Received) -> None:
        self._digests |= {each.component: None for each in self._meant(received)}

    def _describe(self, received: Received) -> None:
        first, count = whole(received.values, "first"), whole(received.values, "count")
        for each in self._meant(received):
            last = min(first + count, len(each.descriptions))
            self._described |= {(each.component, number): None for number in range(first, last)}

    # what is to be set

    def _set(self, received: Received) -> None:
        values = received.values
        try:
            value = value_of(whole(values, "param_type"), real(values, "param_value"))
        except ParameterValueError as error:
            self._refuse(_asked(received, 0, 0, 0.0), error)
            return
        self._begin(received, _asked(received, 0, 0, value))

    def _write(self, received: Received) -> None:
        values, sender = received.values, (received.system, received.component)
        session, number = whole(values, "session"), whole(values, "number")
        arrival = self._once.judge(sender, session, number)
        if arrival is Arrival.NEW:
            self._last.pop(sender, None)
            self._begin(received, _asked(received, session, number, real(values, "value")))
        elif arrival is Arrival.AGAIN and sender in self._last:
            self._answers.append(self._last[sender])

    def _begin(self, received: Received, asked: _Asked) -> None:
        """Hand a value to the port, or refuse it."""
        sets = [(each, each.number(asked.parameter)) for each in self._meant(received)]
        each, number = next((found for found in sets if found[1] is not None), (None, None))
        if each is None or number is None:
            words = f"{asked.parameter}: there is no such parameter"
            self._refuse(asked, ParameterValueError(words, WriteError.DOES_NOT_EXIST))
            return
        asked = asked._replace(component=each.component)
        try:
            asked = asked._replace(value=self._acceptable(each, number, asked.value))
        except ParameterValueError as error:
            self._refuse(asked, error)
            return
        if asked not in self._writes.values():
            self._writes[self._port.write(asked.component, asked.parameter, asked.value)] = asked

    def _acceptable(self, each: ParameterSet, number: int, value: Value) -> Value:
        """Return a value as the port takes it."""
        described = each.descriptions[number]
        if each.is_silent:
            raise ParameterValueError(f"{described.id}: the {each.name} is silent", WriteError.SILENT)
        if len(self._writes) >= _MOST_WRITES:
            raise ParameterValueError(f"{described.id}: {_MOST_WRITES} writings are under way", WriteError.DENIED)
        return fitting(described, value)

    def _refuse(self, asked: _Asked, error: ParameterValueError) -> None:
        each, number = self._found(asked)
        value = None if each is None or number is None or each.is_silent else each.values[number]
        self._ended(asked, WriteOutcome(0, error.error, value, str(error)))

    def _found(self, asked: _Asked) -> tuple[ParameterSet | None, int | None]:
        for each in self._port.sets():
            if each.component == asked.component:
                return each, each.number(asked.parameter)
        return None, None

    def _ended(self, asked: _Asked, outcome: WriteOutcome) -> None:
        """Tell what became of a value: the reason to those who know our messages, the value that holds to all."""
        component = asked.component or COORDINATOR_COMPONENT
        told: Fields = {
            "value": nan if outcome.value is None else float(outcome.value), "session": asked.session,
            "number": asked.number, "target_system": asked.sender[0], "target_component": asked.sender[1],
            "error": int(outcome.error), "param_id": asked.parameter,
            "words": fitted(outcome.words, LONGEST_WORDS),
        }  # fmt: skip
        answer = _Answer("PARAMETER_OUTCOME", told, component)
        each, number = self._found(asked)
        if asked.session or outcome.error is not WriteError.NONE:
            self._answers.append(answer)
        if asked.session:
            self._last[asked.sender] = answer
            while len(self._last) > _MOST_ANSWERS:
                del self._last[next(iter(self._last))]
        elif outcome.error is not WriteError.NONE:
            index = -1 if number is None else number
            self._error(Received(*asked.sender, "", {}), component, index, asked.parameter, outcome.error)
        if each is not None and number is not None and not each.is_silent:
            self._singles[each.component, number] = None

    # what is said

    def poll(self, t: float, outbox: Outbox) -> None:  # noqa: ARG002 - as every service's
        """Say answers, and one parameter of a stream."""
        for outcome in self._port.outcomes():
            asked = self._writes.pop(outcome.ticket, None)
            if asked is not None:
                self._ended(asked, outcome)
        if not (self._answers or self._digests or self._singles or self._described or self._streams):
            return
        sets = {each.component: each for each in self._port.sets()}
        while outbox.room(Priority.COMMAND) >= 256 and self._answer(sets, outbox):
            pass
        if outbox.waiting < _BACKLOG and outbox.room(Priority.DATA) >= 256:
            self._stream(sets, outbox)

    def _answer(self, sets: dict[int, ParameterSet], outbox: Outbox) -> bool:
        """Say one answer; whether there was one."""
        if self._answers:
            answer = self._answers.popleft()
            outbox.put(Priority.COMMAND, answer.name, answer.values, answer.component)
        elif self._digests:
            component = next(iter(self._digests))
            del self._digests[component]
            outbox.put(Priority.COMMAND, "PARAMETER_DIGEST", self._short(list(sets.values()), component), component)
        elif self._singles:
            component, number = next(iter(self._singles))
            del self._singles[component, number]
            _say(sets[component], number, Priority.COMMAND, outbox)
        else:
            return False
        return True

    def _stream(self, sets: dict[int, ParameterSet], outbox: Outbox) -> None:
        if self._described:
            component, number = next(iter(self._described))
            del self._described[component, number]
            fields = description_fields(number, sets[component].descriptions[number])
            outbox.put(Priority.DATA, "PARAMETER_DESCRIPTION", fields, component)
            return
        for component, numbers in list(self._streams.items()):
            each = sets[component]
            if each.is_being_read:
                continue
            if not each.is_silent:
                number = next(iter(numbers))
                del numbers[number]
                _say(each, number, Priority.DATA, outbox)
            if not numbers or each.is_silent:
                del self._streams[component]
            return

    def _short(self, sets: Sequence[ParameterSet], component: int) -> Fields:
        number, each = next((number, each) for number, each in enumerate(sets) if each.component == component)
        state = ParameterState.BEING_READ if each.is_being_read else each.state
        return {
            "count": len(each.descriptions), "set_number": number, "set_count": len(sets), "state": int(state),
            "descriptions": descriptions_digest(each.descriptions),
            "values": values_digest(each.descriptions, each.values), "name": each.name,
        }  # fmt: skip


def _asked(received: Received, session: int, number: int, value: Value) -> _Asked:
    values = received.values
    sender, component = (received.system, received.component), whole(values, "target_component")
    return _Asked(sender, session, number, component, fitted(text(values, "param_id"), LONGEST_ID), value)


def _say(each: ParameterSet, number: int, priority: Priority, outbox: Outbox) -> None:
    """PARAM_VALUE, if the value is known."""
    value = each.values[number]
    if value is not None:
        outbox.put(priority, "PARAM_VALUE", value_fields(each, number, value), each.component)
