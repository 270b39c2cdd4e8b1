"""A vehicle with parameters of three components, as a test needs it."""

import random
from collections.abc import Sequence

from stommel.link.parameters.client import ParameterClient
from stommel.link.parameters.known import KnownParameters
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
from stommel.link.parameters.server import ParameterServer
from tests.link.line import End, Line

COORDINATOR = tuple(
    Description(f"REPORT_{number}", ParameterKind.FLOAT32, 10.0 + number, 0.1, 3600.0, "s", "Between two reports.")
    for number in range(20)
)
MOTION = (
    Description("PUMP_FLOW", ParameterKind.FLOAT32, 8.3e-6, 1e-6, 5e-5, "m3/s", "Of the pump."),
    Description("RETRIES", ParameterKind.INT32, 2, -5, 100, "", "Before a drive is given up."),
    Description("DROP_WEIGHT", ParameterKind.UINT8, 0, 0, 1, "", "Whether there is one."),
    *(Description(f"MOTION_{number}", ParameterKind.INT32, number, -4_000_000, 2_000_000_000) for number in range(30)),
)
ACQUISITION = (Description("CTD_PERIOD", ParameterKind.FLOAT32, 10.0, 0.5, 600.0, "s", "Between two samples."),)
NAMES = {
    COORDINATOR_COMPONENT: ("coordinator", COORDINATOR),
    MOTION_COMPONENT: ("motion node", MOTION),
    ACQUISITION_COMPONENT: ("acquisition node", ACQUISITION),
}


class Vehicle:
    """A port whose writings take two looks."""

    def __init__(self) -> None:
        self.values: dict[int, list[Value | None]] = {
            component: [each.default for each in described] for component, (_, described) in NAMES.items()
        }
        self.states = dict.fromkeys(NAMES, ParameterState.KNOWN)
        self.writes: list[tuple[int, str, Value]] = []
        self._outcomes: list[list[WriteOutcome]] = [[], []]

    def sets(self) -> Sequence[ParameterSet]:
        return [
            ParameterSet(component, name, self.states[component], described, tuple(self.values[component]))
            for component, (name, described) in NAMES.items()
        ]

    def write(self, component: int, parameter: str, value: Value) -> int:
        self.writes.append((component, parameter, value))
        number = [each.id for each in NAMES[component][1]].index(parameter)
        self.values[component][number] = value
        self._outcomes[-1].append(WriteOutcome(len(self.writes), WriteError.NONE, value))
        return len(self.writes)

    def outcomes(self) -> list[WriteOutcome]:
        self._outcomes.append([])
        return self._outcomes.pop(0)


def joined(vehicle: Vehicle, known: KnownParameters | None = None, seed: int = 1) -> tuple[ParameterClient, Line]:
    """A shore and a vehicle on a line."""
    client = ParameterClient(1, known or KnownParameters(1), random.Random(seed))
    line = Line(End(255, 190, [client]), End(1, 1, [ParameterServer(1, vehicle)]))
    return client, line


def read_values(client: ParameterClient) -> dict[int, list[Value | None]]:
    return {component: list(known.values) for component, known in client.known.sets.items()}
