"""Parameters that the shore may see and set: the nodes', by the coordinator's mirror, and some of its own."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

from stommel.link.parameters.port import (
    ACQUISITION_COMPONENT,
    COORDINATOR_COMPONENT,
    MOTION_COMPONENT,
    Description,
    ParameterKind,
    ParameterSet,
    ParameterState,
    Value,
    WriteError,
    WriteOutcome,
)
from stommel.messages.database import ACQUISITION, MOTION
from stommel.messages.parameters import ParameterType
from stommel.onboard.coordination.coordinator import Coordinator
from stommel.onboard.coordination.node_mirror import NodeParameter
from stommel.onboard.coordination.node_mirror import ParameterState as MirrorState

LONGEST_ID = 16
_SHORTER = (("STEERING", "STEER"), ("CURRENT", "CURR"), ("TOLERANCE", "TOL"))
"""By which a name is cut that is too long for the air, one after the other."""
_NODES = {MOTION_COMPONENT: (MOTION, "motion node"), ACQUISITION_COMPONENT: (ACQUISITION, "acquisition node")}
_KINDS = {
    ParameterType.float32: ParameterKind.FLOAT32, ParameterType.int32: ParameterKind.INT32,
    ParameterType.bool: ParameterKind.UINT8,
}  # fmt: skip
_ERRORS = {
    "Ok": WriteError.NONE, "OutOfRange": WriteError.OUT_OF_RANGE, "NoSuchParameter": WriteError.DOES_NOT_EXIST,
    "NoAnswer": WriteError.SILENT, "NotSaved": WriteError.DENIED, "Busy": WriteError.DENIED,
}  # fmt: skip


class _Own(NamedTuple):
    """A parameter of the coordinator itself."""

    description: Description
    read: Callable[[Coordinator], float | None]
    write: Callable[[Coordinator, float], None]


def _surface_time(coordinator: Coordinator) -> float | None:
    orders = coordinator.pilot.orders
    return None if orders is None else float(orders.dives.surface_time)


_OWN = (
    _Own(
        Description(
            "SURFACE_TIME", ParameterKind.FLOAT32, 60.0, 10.0, 86_400.0, "s",
            "stay at the surface after each dive, until another mission is taken",
        ),
        _surface_time,
        lambda coordinator, value: coordinator.stay_at_surface(value),
    ),
)  # fmt: skip


class _Writing(NamedTuple):
    """A value that a node was told."""

    ticket: int
    node: int
    number: int


class VehicleParameters:
    """Serves the link.

    Parameters
    ----------
    coordinator
        Who keeps the mirror.
    """

    def __init__(self, coordinator: Coordinator) -> None:
        self._coordinator = coordinator
        self._tickets = 0
        self._writing: list[_Writing] = []
        self._outcomes: list[WriteOutcome] = []

    def sets(self) -> Sequence[ParameterSet]:
        """All parameters as they are known now."""
        own = ParameterSet(
            COORDINATOR_COMPONENT,
            "coordinator",
            ParameterState.KNOWN,
            tuple(each.description for each in _OWN),
            tuple(each.read(self._coordinator) for each in _OWN),
        )
        return [own, *(self._of_node(component) for component in _NODES)]

    def _of_node(self, component: int) -> ParameterSet:
        node, name = _NODES[component]
        known = [each for each in self._coordinator.parameters.of(node) if each.state is not MirrorState.ABSENT]
        state = ParameterState.KNOWN
        if any(each.state is MirrorState.SILENT for each in known):
            state = ParameterState.SILENT
        elif any(each.state is not MirrorState.KNOWN for each in known):
            state = ParameterState.BEING_READ
        told = [each for each in known if None not in (each.default, each.low, each.high)]
        return ParameterSet(
            component, name, state, tuple(map(_described, told)), tuple(_value(each.value) for each in told)
        )

    def write(self, component: int, parameter: str, value: Value) -> int:
        """Begin to set a parameter; return a ticket by which `outcomes` names it."""
        self._tickets += 1
        if component == COORDINATOR_COMPONENT:
            own = next(each for each in _OWN if each.description.id == parameter)
            own.write(self._coordinator, float(value))
            held = own.read(self._coordinator)
            error, words = (WriteError.DENIED, "there is no mission aboard") if held is None else (WriteError.NONE, "")
            self._outcomes.append(WriteOutcome(self._tickets, error, held, words))
            return self._tickets
        node = _NODES[component][0]
        mirror = self._coordinator.parameters
        found = next(each for each in mirror.of(node) if air_name(each.name) == parameter)
        self._writing.append(_Writing(self._tickets, node, found.number))
        mirror.write(node, found.number, bool(value) if found.type is ParameterType.bool else value)
        mirror.save(node)
        return self._tickets

    def outcomes(self) -> list[WriteOutcome]:
        """What became of writings, since this was last asked."""
        outcomes, self._outcomes = self._outcomes, []
        return outcomes

    def observe(self) -> None:
        """Take what the nodes have answered since the last decision."""
        view = self._coordinator.view
        for told in () if view is None else view.parameters:
            if told.operation != "Write":
                continue
            writing = next((each for each in self._writing if (each.node, each.number) == told[:2]), None)
            if writing is None:
                continue
            self._writing.remove(writing)
            held = next((e.value for e in self._coordinator.parameters.of(told.node) if e.number == told.number), None)
            error = _ERRORS.get(told.result, WriteError.DENIED)
            words = "" if error is WriteError.NONE else told.words
            self._outcomes.append(WriteOutcome(writing.ticket, error, _value(held), words))


def air_name(name: str) -> str:
    """Name of a node's parameter as it goes over the air: capital letters, 16 of them at most."""
    found = name.upper()
    for long, short in _SHORTER:
        if len(found) <= LONGEST_ID:
            break
        found = found.replace(long, short)
    return found


def _described(each: NodeParameter) -> Description:
    default, low, high = (_value(value) for value in (each.default, each.low, each.high))
    assert default is not None
    assert low is not None
    assert high is not None
    return Description(air_name(each.name), _KINDS[each.type], default, low, high, each.unit, each.words)


def _value(value: Value | bool | None) -> Value | None:
    return int(value) if isinstance(value, bool) else value
