"""Integration of a network between events, and what each event switches.

Between events the equations are smooth; `scipy.integrate` advances them with LSODA, which changes between Adams and
backward differentiation formulas as the stiffness of oil and valves asks for. After each step all event functions are
looked at together, and the first fall through zero is located on the integrator's own interpolant.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from stommel.errors import StommelError
from stommel.machinery.engine.circuit_equations import FIRST_PRESSURE, evaluate, observe, piston_push
from stommel.machinery.engine.network import (
    BRAKE,
    CHECK_VALVE,
    HOLD,
    LIMITED,
    LOCKED,
    PISTON_FRICTION,
    RAMP,
    STUCK,
    TRANSMISSION,
    Network,
)  # fmt: skip

if TYPE_CHECKING:
    from scipy.integrate import LSODA, Radau

Array = NDArray[np.float64]

RTOL = 1e-6
LONGEST_STEP_S = 2.0
_MANY_EVENTS = 300
_MOST_STEPS = 80_000
"""Of the integrator in one simulation, some five seconds: a day's hold takes half of them, a cycle of ordinary parts a
few hundred."""
_BEGINNING = 10
"""Steps that a new segment counts for itself."""
_RADAU_STEP = 20
"""Steps of LSODA that take as long as one of Radau."""


class SimulationError(StommelError):
    """The circuit cannot be simulated: the integrator failed, or the events never end."""


@dataclass(frozen=True)
class Segment:
    """A stretch without events."""

    t: Array
    states: Array
    """A row an instant."""
    seen: Array
    """Observations at the same instants."""
    event: int | None
    """Event that ended it, None if its time was over."""


class Stepper:
    """Advances one network through segments; holds its time and state."""

    def __init__(self, network: Network, y: Array) -> None:
        self.network = network
        self.t = 0.0
        self.y = y
        self._dy = np.empty(network.size)
        self._seen = np.empty(FIRST_PRESSURE + len(network.nodes))
        self._g = np.empty(network.events)
        self._atol = _tolerances(network)
        self.segments: list[Segment] = []
        self._steps = 0

    def evaluate(self, y: Array) -> None:
        """Fill rates, observations and event functions."""
        net = self.network
        evaluate(
            y, net.nodes, net.pumps, net.passages, net.pistons, net.drive, net.opened, net.moving,
            self._dy, self._seen, self._g,
        )  # fmt: skip

    def advance(self, until: float) -> int | None:
        """Integrate to the next event, or to the time `until`; return the event.

        Raises
        ------
        SimulationError
            The integrator failed, or there are far too many steps or events.
        """
        from scipy.integrate import LSODA, Radau  # noqa: PLC0415 - slow to import, and missions seldom need it

        solver = self._solver(LSODA, until)
        times, states, event = [self.t], [self.y], None
        self._steps += _BEGINNING
        before = self._event_values(self.y)
        while solver.status == "running" and event is None:
            self._count(solver, isinstance(solver, Radau))
            failure = solver.step()
            if failure is not None or not np.isfinite(solver.y).all():
                # LSODA can lose its step where nothing changes any more; Radau's takes over from the last good state
                if isinstance(solver, Radau):
                    raise SimulationError(f"engine: the integrator failed at {times[-1]:.6g} s: {failure}")
                self.t, self.y = times[-1], states[-1]
                solver = self._solver(Radau, until)
                continue
            t, y = float(solver.t), solver.y.copy()
            after = self._event_values(y)
            fallen = np.flatnonzero((before >= 0.0) & (after < 0.0))
            if len(fallen):
                t, event = self._first(fallen, solver)
                y = np.asarray(solver.dense_output()(t)) if t < solver.t else y
            times.append(t)
            states.append(y)
            before = after
        rows = np.array(states)
        self.segments.append(Segment(np.array(times), rows, self.observations(rows), event))
        self.t, self.y = times[-1], rows[-1].copy()
        return event

    def _count(self, solver: "LSODA | Radau", slow: bool) -> None:
        """Refuse to go on without end: name what flutters, or the part whose quick answers keep the steps small."""
        self._steps += _RADAU_STEP if slow else 1
        if self._steps <= _MOST_STEPS:
            return
        t, y = float(solver.t), solver.y
        done = f"engine: after {_MOST_STEPS} steps of the integrator it has come to {t:.3g} s"
        if len(self.segments) > _MANY_EVENTS:
            raise SimulationError(
                f"{done} and {len(self.segments)} events: a valve flutters, or a piston sticks and slips because its "
                "Stribeck friction falls faster with speed than its viscous friction grows"
            )
        rate, part = max(self._relaxations(y))
        raise SimulationError(f"{done}: too stiff. Fastest is {part}, with a time constant of {1.0 / rate:.2g} s")

    def _relaxations(self, y: Array) -> Iterator[tuple[float, str]]:
        """How fast each state returns when it is displaced [1/s], and in words what it is and what makes it so."""
        net = self.network
        parts = {0: "the motor (rotor_inertia_g_cm2, ramp_s)"}
        parts |= {
            1 + n: f"the oil at {name!r} (resistances there, oil.node_volume_ml, oil.bulk_modulus_mpa)"
            for n, name in enumerate(net.node_names)
        }
        parts |= {
            net.first_velocity + i: f"the piston {name!r} (friction over its mass)"
            for i, name in enumerate(net.piston_names)
        }
        before = self._rates(0.0, y)
        for k, part in parts.items():
            aside = y.copy()
            aside[k] += 1e3 * self._atol[k]
            slope = (self._rates(0.0, aside)[k] - before[k]) / (1e3 * self._atol[k])
            yield abs(float(slope)), part

    def _solver(self, method: "type[LSODA | Radau]", until: float) -> "LSODA | Radau":
        """Integrator from the present time and state."""
        tolerance: Any = self._atol  # the stubs of Radau know only one number
        return method(self._rates, self.t, self.y, until, rtol=RTOL, atol=tolerance, max_step=LONGEST_STEP_S)

    def _first(self, fallen: NDArray[np.intp], solver: "LSODA | Radau") -> tuple[float, int]:
        """Instant and number of the first of the events that happened within the last step."""
        from scipy.optimize import brentq  # noqa: PLC0415 - slow to import

        course, begin, end = solver.dense_output(), float(solver.t_old or 0.0), float(solver.t)

        def located(j: int) -> float:
            def value(t: float) -> float:
                return float(self._event_values(course(t))[j])

            # the interpolant may differ in the last digits from the solution at the ends of the step
            if value(begin) <= 0.0:
                return begin
            return float(brentq(value, begin, end, xtol=1e-12)) if value(end) < 0.0 else end

        return min((located(int(j)), int(j)) for j in fallen)

    def _event_values(self, y: Array) -> Array:
        self.evaluate(y)
        return self._g.copy()

    def observations(self, states: Array) -> Array:
        """Observations at given states with the present switches."""
        net = self.network
        return np.asarray(
            observe(
                states, net.nodes, net.pumps, net.passages, net.pistons, net.drive, net.opened, net.moving, net.events
            )
        )

    def overdue(self) -> int | None:
        """Switch whose condition has passed already: together with another event, or as a phase began."""
        self.evaluate(self.y)
        if self.network.drive[0]["mode"] in (RAMP, HOLD) and self._g[2] < 0.0:
            return 2
        passages, pistons = len(self.network.passages), len(self.network.pistons)
        for j in range(3, 3 + passages):
            if self._g[j] < 0.0:
                return j
        for i in range(pistons):
            j = 3 + passages + 2 * i
            if self.network.moving[i] == STUCK and self._g[j] < 0.0:
                return j
        return None

    def _rates(self, _t: float, y: Array) -> Array:
        self.evaluate(y)
        return self._dy.copy()


def _tolerances(network: Network) -> Array:
    """Absolute tolerance of each state: about 10 Pa, a nanometre, 0.1 mJ."""
    atol = np.full(network.size, 1e-4)
    atol[1 : network.first_position] = 10.0 * network.nodes["volume"] / network.nodes["K"]
    atol[1 + network.bladder] = 1e-12
    atol[network.first_position : network.first_velocity] = 1e-9
    atol[network.first_velocity : network.first_entry] = 1e-7
    return atol


def switch(network: Network, y: Array, event: int) -> str:
    """Do what an event does to the switches and, at a stop, to the state; return its name.

    Names are `target`, `speed reached`, `at rest`, `limited`, `stalled`, and those of valves, pistons and accumulators
    with what they do.
    """
    passages, pistons = len(network.passages), len(network.pistons)
    if event < 3:
        return _switch_motor(network, y, event)
    event -= 3
    if event < passages:
        assert network.passages[event]["kind"] == CHECK_VALVE
        network.opened[event] = 1 - network.opened[event]
        return f"{network.passage_names[event]} {'opens' if network.opened[event] else 'closes'}"
    event -= passages
    if event < 2 * pistons:
        return _switch_piston(network, y, event // 2, at_stop=bool(event % 2))
    event -= 2 * pistons
    filled = passages + event
    network.opened[filled] = 1 - network.opened[filled]
    return f"accumulator {'fills' if network.opened[filled] else 'is empty'}"


def _switch_motor(network: Network, y: Array, event: int) -> str:
    drive = network.drive[0]
    if event == 0:
        drive["towards"] = 0
        if drive["mode"] == LOCKED:
            network.opened[: len(network.passages)][network.passages["kind"] != CHECK_VALVE] = 0
        else:
            drive["mode"] = BRAKE
        return "target"
    if event == 1:
        resting = drive["mode"] == BRAKE
        y[0] = 0.0 if resting else drive["s"] * drive["omega"]
        drive["mode"] = LOCKED if resting else HOLD
        return "at rest" if resting else "speed reached"
    if drive["mode"] in (RAMP, HOLD):
        drive["mode"] = LIMITED
        return "limited"
    stop_motor(network, y)
    return "stalled"


def stop_motor(network: Network, y: Array) -> None:
    """Lock the motor where it is; what energy the rotor had is lost in the train."""
    drive = network.drive[0]
    y[network.first_entry + TRANSMISSION] += 0.5 * drive["J"] * y[0] ** 2
    y[0] = 0.0
    drive["mode"], drive["towards"] = LOCKED, 0


def _switch_piston(network: Network, y: Array, i: int, *, at_stop: bool) -> str:
    piston, name = network.pistons[i], network.piston_names[i]
    x, v = network.first_position + i, network.first_velocity + i
    if at_stop:
        y[x] = 0.0 if y[x] < 0.5 * piston["stroke"] else piston["stroke"]
        if piston["driven"]:
            stop_motor(network, y)
    if at_stop or network.moving[i] != STUCK:
        y[network.first_entry + PISTON_FRICTION] += 0.5 * piston["mass"] * y[v] ** 2
        y[v] = 0.0
        network.moving[i] = STUCK
        return f"{name} at its end stop" if at_stop else f"{name} stops"
    network.moving[i] = 1 if _push(network, y, i) > 0.0 else -1
    return f"{name} moves"


def _push(network: Network, y: Array, i: int) -> float:
    """Force on a piston from oil and gas, outwards [N]."""
    states = y[np.newaxis, :].copy()
    seen = observe(
        states, network.nodes, network.pumps, network.passages, network.pistons, network.drive, network.opened,
        network.moving, network.events,
    )  # fmt: skip
    pistons, nodes = network.pistons.view(np.recarray), network.nodes.view(np.recarray)
    node = int(pistons[i].node)
    return float(piston_push(pistons[i], seen[0, FIRST_PRESSURE + node], nodes[node]))
