"""The shore learns the parameters of one component: descriptions if they are new, then values, until digests agree."""

from stommel.link.endings import Ending
from stommel.link.gathering import Gathering
from stommel.link.outbox import Outbox, Priority
from stommel.link.parameters.encoding import ParameterValueError, value_of
from stommel.link.parameters.known import KnownSet, description_of
from stommel.link.parameters.port import Description, ParameterState, Value
from stommel.link.question import Pace
from stommel.link.service import Received
from stommel.link.values import real, text, whole
from stommel.messages.mavlink import Fields

MOST_PARAMETERS = 2000
"""Of one component."""


class Refreshing:
    """Parameters of one component on their way.

    Parameters
    ----------
    system
        The vehicle.
    component
        Whose parameters.
    digest
        Fields of the PARAMETER_DIGEST that they shall agree with.
    known
        What is known of them; None for nothing.
    pace
        Of this vehicle.
    """

    def __init__(self, system: int, component: int, digest: Fields, known: KnownSet | None, pace: Pace) -> None:
        self._system, self.component, self._pace = system, component, pace
        self.name = text(digest, "name")
        self.set_number = whole(digest, "set_number")
        """Of the component among those that have parameters."""
        self._count = whole(digest, "count")
        self._wanted = digest["descriptions"], digest["values"]
        self._state = ParameterState.SILENT
        self._descriptions: dict[int, Description] = {}
        self._values: dict[int, Value] = {}
        self._described: Gathering | None = None
        self._valued: Gathering | None = None
        self.known = known
        """The whole set; only then another than before when the refreshing has ended whole."""
        self.ending: Ending | None = None
        self.words = ""
        """Why it has not ended whole."""
        self.contradicts = False
        """Whether all is here and the digest is another: parameters have changed meanwhile."""
        self._begin(whole(digest, "state"), known)

    def _begin(self, state: int, known: KnownSet | None) -> None:
        if state == ParameterState.SILENT:
            if known is not None:
                self.known = known._replace(state=ParameterState.SILENT)
            self._end(Ending.FAILED, f"the {self.name} is silent; its parameters are as they were last heard")
        elif self._count > MOST_PARAMETERS:
            self._end(
                Ending.FAILED, f"the {self.name} has {self._count} parameters; at most {MOST_PARAMETERS} are read"
            )
        elif known is not None and known.digests == self._wanted:
            self._whole(known)
        elif known is not None and known.digests[0] == self._wanted[0]:
            self._descriptions = dict(enumerate(known.descriptions))
            self._valued = Gathering(self._count, self._pace)
        else:
            self._described = Gathering(self._count, self._pace)

    def _end(self, ending: Ending, words: str = "") -> None:
        self.ending, self.words = ending, words

    def end_changing(self) -> None:
        """End: each time that all was here the digest was another."""
        self._end(Ending.FAILED, f"the parameters of the {self.name} change faster than they are read")

    def _whole(self, known: KnownSet) -> None:
        self.known = known._replace(name=self.name, state=ParameterState.KNOWN)
        self._end(Ending.WHOLE)

    @property
    def done(self) -> tuple[int, int]:
        """Messages that are here, and how many there will have been."""
        if self.ending is not None:
            return 1, 1
        described = 0 if self._described is None else self._count
        gathered = len(self._descriptions) * bool(described) + len(self._values)
        return gathered, described + self._count

    def take(self, received: Received, t: float) -> bool:
        """Take a message of this component; whether it helped."""
        if self.ending is not None:
            return False
        if received.name == "PARAMETER_DESCRIPTION" and self._described is not None and self._valued is None:
            return self._take_description(received.values, self._described, t)
        if received.name == "PARAM_VALUE" and self._valued is not None:
            return self._take_value(received.values, self._valued, t)
        return False

    def _take_description(self, values: Fields, described: Gathering, t: float) -> bool:
        number = whole(values, "param_index")
        if number not in described.missing:
            return False
        try:
            self._descriptions[number] = description_of(values, self.name)
        except ParameterValueError as error:
            self._end(Ending.FAILED, str(error))
            return False
        described.take(number, t)
        if described.is_whole:
            self._check_descriptions()
        return True

    def _check_descriptions(self) -> None:
        found = self._set()
        if found.digests[0] == self._wanted[0]:
            self._valued = Gathering(self._count, self._pace)
        else:
            self.contradicts = True

    def _take_value(self, values: Fields, valued: Gathering, t: float) -> bool:
        number = whole(values, "param_index")
        described = self._descriptions.get(number)
        if described is None or described.id != values["param_id"] or described.kind != values["param_type"]:
            return False
        is_new = valued.take(number, t)
        self._values[number] = value_of(described.kind, real(values, "param_value"))
        if is_new and valued.is_whole:
            found = self._set()
            if found.digests == self._wanted:
                self._whole(found)
            else:
                self.contradicts = True
        return is_new

    def _set(self) -> KnownSet:
        descriptions = tuple(self._descriptions[number] for number in range(self._count))
        values = tuple(self._values.get(number) for number in range(self._count))
        return KnownSet(self.component, self.name, ParameterState.KNOWN, descriptions, values)

    def poll(self, t: float, outbox: Outbox, *, is_quiet: bool) -> None:
        """Ask for what is missing: for all at first, then singly; seldom if the vehicle is not heard."""
        if self.ending is not None or self.contradicts:
            return
        gathering = self._described if self._valued is None else self._valued
        assert gathering is not None
        if gathering.is_whole:  # of a component without parameters
            self._whole(self._set())
        elif gathering.is_stream_due(t):
            gathering.stream(t, is_quiet=is_quiet)
            self._ask_all(outbox)
        else:
            for number in gathering.due(t, is_quiet=is_quiet):
                self._ask(number, outbox)

    def _ask_all(self, outbox: Outbox) -> None:
        target: Fields = {"target_system": self._system, "target_component": self.component}
        if self._valued is None:
            told: Fields = {**target, "first": 0, "count": self._count}
            outbox.put(Priority.COMMAND, "PARAMETER_DESCRIPTION_REQUEST", told)
        else:
            outbox.put(Priority.COMMAND, "PARAM_REQUEST_LIST", target)

    def _ask(self, number: int, outbox: Outbox) -> None:
        target: Fields = {"target_system": self._system, "target_component": self.component}
        if self._valued is None:
            told: Fields = {**target, "first": number, "count": 1}
            outbox.put(Priority.COMMAND, "PARAMETER_DESCRIPTION_REQUEST", told)
        else:
            outbox.put(Priority.COMMAND, "PARAM_REQUEST_READ", {**target, "param_index": number})

    def again(self) -> None:
        """Ask at once for what is missing: the vehicle is heard again."""
        for gathering in (self._described, self._valued):
            if gathering is not None:
                gathering.again()
