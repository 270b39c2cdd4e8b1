"""Parameters as the shore knows them, kept on its disk from one day to the next."""

import json
from math import inf, isfinite
from typing import Any, NamedTuple

from stommel.files.storage import Storage, replace_whole
from stommel.link.parameters.encoding import (
    LEAST_INT,
    MOST_INT,
    ParameterValueError,
    check_description,
    descriptions_digest,
    held,
    values_digest,
)
from stommel.link.parameters.port import Description, ParameterKind, ParameterState, Value

_FORMAT = 1
_MOST_BYTES = 8 << 20
"""Of a file that is read."""
DISK_PATIENCE = 10.0
"""After which a disk that took nothing is tried again [s]."""


class KnownSet(NamedTuple):
    """Parameters of one component, as they were last heard."""

    component: int
    name: str
    state: ParameterState
    descriptions: tuple[Description, ...]
    values: tuple[Value | None, ...]

    @property
    def digests(self) -> tuple[bytes, bytes]:
        """Digests of descriptions and values, as PARAMETER_DIGEST says them."""
        return descriptions_digest(self.descriptions), values_digest(self.descriptions, self.values)

    def number(self, parameter: str) -> int | None:
        """Return the number of a parameter; None if there is none of this name."""
        return next((number for number, each in enumerate(self.descriptions) if each.id == parameter), None)

    def with_value(self, parameter: str, value: Value) -> "KnownSet":
        """Return the set with another value of a parameter; a value that it cannot have changes nothing."""
        number = self.number(parameter)
        if number is None:
            return self
        try:
            new = held(self.descriptions[number].kind, value)
        except ParameterValueError:
            return self
        return self._replace(values=(*self.values[:number], new, *self.values[number + 1 :]))


class KnownParameters:
    """What is known of the parameters of one vehicle.

    Parameters
    ----------
    system
        The vehicle.
    storage
        Where it is kept; None: nowhere.
    """

    def __init__(self, system: int, storage: Storage | None = None) -> None:
        self._name, self._storage = f"parameters-{system}.json", storage
        self.notes: list[str] = []
        """What was wrong with the disk, in words; parameters are then asked for anew."""
        self.sets: dict[int, KnownSet] = {}
        """By component."""
        self._problem = ""
        self._again = inf
        self._load()

    def _load(self) -> None:
        if self._storage is None:
            return
        try:
            if self._storage.sizes().get(self._name, _MOST_BYTES + 1) <= _MOST_BYTES:
                self.sets = _sets_of(json.loads(self._storage.read(self._name)))
        except OSError as error:
            self.notes.append(f"{self._name}: cannot be read: {error.strerror or error}")
        except (ValueError, KeyError, TypeError, AttributeError, ParameterValueError, RecursionError):
            self.notes.append(f"{self._name}: is damaged; parameters are asked for anew")

    def keep(self, t: float) -> None:
        """Write what is known to the disk at a time [s]; if it cannot be, that is noted, and tried again."""
        if self._storage is None:
            return
        self._again = inf
        if self._problem in self.notes:
            self.notes.remove(self._problem)
        told = {"format": _FORMAT, "sets": [_told(each) for each in self.sets.values()]}
        try:
            replace_whole(self._storage, self._name, json.dumps(told, indent=1, allow_nan=False).encode())
        except OSError as error:
            self._problem = f"{self._name}: cannot be kept: {error.strerror or error}"
            self.notes.append(self._problem)
            self._again = t + DISK_PATIENCE

    def keep_again(self, t: float) -> None:
        """Try again what could not be written, now and then."""
        if t >= self._again:
            self.keep(t)


def _told(known: KnownSet) -> dict[str, Any]:
    described = [{**each._asdict(), "kind": int(each.kind)} for each in known.descriptions]
    # JSON has no word for what is no number: it is asked for anew
    values = [value if value is not None and isfinite(value) else None for value in known.values]
    return {"component": known.component, "name": known.name, "descriptions": described, "values": values}


def _sets_of(told: Any) -> dict[int, KnownSet]:
    """What a file tells; whatever is wrong with it is an error, for the vehicle can be asked."""
    if told["format"] != _FORMAT:
        return {}
    found = {}
    for each in told["sets"]:
        name = str(each["name"])
        descriptions = tuple(_description(one, name) for one in each["descriptions"])
        pairs = zip(descriptions, each["values"], strict=True)
        values = tuple(None if value is None else held(described.kind, value) for described, value in pairs)
        component = int(each["component"])
        # whether a component is silent now, its digest tells
        found[component] = KnownSet(component, name, ParameterState.SILENT, descriptions, values)
    return found


def _description(told: Any, component: str) -> Description:
    kind = ParameterKind(told["kind"])
    default, low, high = (_number(kind, told[key]) for key in ("default", "low", "high"))
    described = Description(str(told["id"]), kind, default, low, high, str(told["unit"]), str(told["words"]))
    check_description(described, component)
    return described


def description_of(values: Any, component: str) -> Description:
    """Return the description that a PARAMETER_DESCRIPTION tells.

    Raises
    ------
    ParameterValueError
        It contradicts itself.
    """
    told = {"id": values["param_id"], "kind": values["param_type"], "default": values["default_value"]}
    try:
        return _description({**values, **told}, component)
    except ValueError as error:
        raise ParameterValueError(f"parameters of {component}: {error}") from None


def _number(kind: ParameterKind, value: float) -> Value:
    """A number of a description as its type holds it."""
    if kind is ParameterKind.FLOAT32:
        return float(value)
    if not LEAST_INT <= value <= MOST_INT:
        raise ParameterValueError(f"{value}: must be between {LEAST_INT} and {MOST_INT}")
    return int(value)
