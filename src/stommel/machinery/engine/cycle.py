"""A cycle of the buoyancy engine: inflate, hold, deflate, as the controller runs it."""

from math import ceil, floor, pi

import numpy as np

from stommel.errors import StommelError
from stommel.machinery.engine.circuit import assemble, trains
from stommel.machinery.engine.circuit_equations import BLADDER_FLOW, CURRENT, FIRST_PRESSURE, POWER, VOLTAGE
from stommel.machinery.engine.ideal import ideal_engine
from stommel.machinery.engine.network import (
    HULL_GAS,
    LEDGER,
    LOCKED,
    LOSSES,
    RAMP,
    SEA,
    SOLENOID_VALVE,
    STUCK,
    SUPPLY,
    rad_s,
)  # fmt: skip
from stommel.machinery.engine.rest import all_oil, at_rest, stored_energy
from stommel.machinery.engine.results import Array, Courses, EngineRun, Outcome, PhaseResult
from stommel.machinery.engine.segments import Stepper, stop_motor, switch
from stommel.vehicle.schema import Engine

PATIENCE_S = 20.0
LEAST_PROGRESS = 1e-3
"""A phase that moves less than this share of its oil in `PATIENCE_S` is given up: no flow."""
SHORTEST_HOLD_S, LONGEST_HOLD_S = 1e-3, 86400.0
GREATEST_PA = 2e8
"""Beyond any sea."""
FASTEST_RPM = 50000.0
SETTLING_S = 1.0
"""Longest time in which the oil comes to rest after a valve has closed."""


class EngineRequestError(StommelError):
    """What was asked of the engine is impossible: a volume beyond its range, a negative pressure."""


def simulate(
    engine: Engine,
    *,
    pressure_pa: float,
    inflate_m3: float = 0.0,
    deflate_m3: float = 0.0,
    hold_s: float = 0.0,
    motor_speed_rpm: float | None = None,
    ideal: bool = False,
    name: str = "engine",
) -> EngineRun:
    """Simulate a cycle: inflate from the empty bladder, hold, deflate.

    Parameters
    ----------
    engine
        The circuit.
    pressure_pa
        Gauge pressure of the sea at the bladder [Pa].
    inflate_m3, deflate_m3
        Oil to move [m3]; zero leaves the phase out. Without an inflation the bladder begins full.
    hold_s
        Pause after the inflation, with everything switched off [s]; less than a millisecond is none.
    motor_speed_rpm
        Speed of the inflating motor instead of the file's [r/min].
    ideal
        Without losses, at the ideal pump speed of the file: the case of section 4.3.2.
    name
        Name for messages and plots.

    Returns
    -------
    EngineRun
        Whatever happened, also a stall: `EngineRun.stalled` and the outcome of each phase say so.

    Raises
    ------
    EngineRequestError
        A number is impossible for this engine.
    CircuitError, SimulationError
        The circuit cannot work, or cannot be integrated.
    """
    _check(engine, pressure_pa, inflate_m3, deflate_m3, hold_s, motor_speed_rpm)
    speed = motor_speed_rpm or abs(engine.inflate.motor_speed_rpm)
    if ideal:
        if motor_speed_rpm is None and engine.ideal_pump_speed_rpm is not None:
            speed = engine.ideal_pump_speed_rpm / _pump_ratio(engine)
        engine = ideal_engine(engine)
    cycle = _Cycle(engine, pressure_pa, full=inflate_m3 == 0.0)
    if inflate_m3 > 0.0:
        cycle.run("inflate", speed, inflate_m3)
    if hold_s >= SHORTEST_HOLD_S:
        cycle.hold(hold_s)
    if deflate_m3 > 0.0 and not cycle.stalled:
        cycle.run("deflate", abs(engine.deflate.motor_speed_rpm), -deflate_m3)
    return cycle.result(name, ideal=ideal)


def _check(
    engine: Engine, pressure_pa: float, inflate_m3: float, deflate_m3: float, hold_s: float, speed_rpm: float | None
) -> None:
    if not 0.0 <= pressure_pa <= GREATEST_PA:
        raise EngineRequestError(
            f"pressure = {pressure_pa / 1e6:g} MPa: must be at least 0 (gauge) and at most {GREATEST_PA / 1e6:g}"
        )
    most = engine.measured_piston.working_volume_ml
    for what, volume in (("inflate", inflate_m3), ("deflate", deflate_m3)):
        if not 0.0 <= volume * 1e6 <= most + 1e-6:
            raise EngineRequestError(
                f"{what} = {volume * 1e6:g} ml: the range of {engine.sensor.measures!r} is 0 to {most:.1f} ml"
            )
    if inflate_m3 == 0.0 and deflate_m3 == 0.0:
        raise EngineRequestError("nothing to do: give a volume to inflate or to deflate greater than 0")
    if deflate_m3 > inflate_m3 > 0.0:
        raise EngineRequestError(
            f"deflate = {deflate_m3 * 1e6:g} ml: the bladder holds only the inflated {inflate_m3 * 1e6:g} ml"
        )
    if not 0.0 <= hold_s <= LONGEST_HOLD_S:
        raise EngineRequestError(f"hold = {hold_s:g} s: must be at least 0 and at most {LONGEST_HOLD_S:g}")
    if speed_rpm is not None and not 0.0 < speed_rpm <= FASTEST_RPM:
        raise EngineRequestError(
            f"motor speed = {speed_rpm:g} r/min: must be greater than 0 and at most {FASTEST_RPM:g}"
        )


def _pump_ratio(engine: Engine) -> float:
    """Speed of the pump's or screw's shaft per speed of the motor."""
    shaft = f"{(engine.pumps or engine.screws)[0].name}.shaft"
    return trains(engine)[shaft].ratio


class _Cycle:
    """The controller with its circuit: runs phase after phase and keeps what happens."""

    def __init__(self, engine: Engine, pressure_pa: float, *, full: bool) -> None:
        self.engine = engine
        self.network = assemble(engine)
        self.network.drive[0]["pressure"] = pressure_pa
        self.stepper = Stepper(self.network, at_rest(self.network, engine, full=full))
        self.phases: list[PhaseResult] = []
        self.events: list[tuple[float, str]] = []
        self.at_begin = self.stepper.y.copy()
        self.most_asked = 0.0

    @property
    def stalled(self) -> bool:
        return any(phase.outcome.stalled for phase in self.phases)

    def position(self, y: Array) -> float:
        """Position of the measured piston [m]."""
        return float(y[self.network.first_position + self.network.drive[0]["measured"]])

    def run(self, name: str, speed_rpm: float, volume_m3: float) -> None:
        """Run a phase until the sensor reads the position that `volume_m3` into the bladder leads to."""
        settings = self.engine.inflate if name == "inflate" else self.engine.deflate
        net, stepper = self.network, self.stepper
        drive, piston = net.drive[0], net.pistons[net.drive[0]["measured"]]
        begin, segments, before = stepper.t, len(stepper.segments), stepper.y.copy()
        wanted = self.position(before) - volume_m3 / piston["S"]
        self.most_asked = max(self.most_asked, abs(volume_m3))
        drive["towards"] = -1 if volume_m3 > 0.0 else 1
        drive["target"] = _on_the_grid(wanted, self.engine.sensor.resolution_mm / 1e3, drive["towards"])
        turning = settings.motor_speed_rpm != 0.0
        if turning:
            drive["s"] = 1 if settings.motor_speed_rpm > 0.0 else -1
            drive["omega"] = rad_s(speed_rpm)
            drive["rate"] = drive["omega"] / self.engine.motors[0].ramp_s
            drive["mode"], drive["lead"] = RAMP, 1
        else:
            drive["lead"] = 0
        for i, valve in enumerate(net.passage_names):
            if net.passages[i]["kind"] == SOLENOID_VALVE:
                net.opened[i] = int(valve in settings.open_valves)
        outcome = self._until_done(abs(volume_m3), turning=turning)
        net.opened[: len(net.passages)][net.passages["kind"] == SOLENOID_VALVE] = 0
        self._keep(name, outcome, begin, segments, before)

    def hold(self, duration_s: float) -> None:
        """Let the circuit rest."""
        begin, segments, before = self.stepper.t, len(self.stepper.segments), self.stepper.y.copy()
        while self.stepper.t < begin + duration_s:
            self._advance(begin + duration_s)
        self._keep("hold", Outcome.REACHED, begin, segments, before)

    def _advance(self, until: float) -> str | None:
        """Go to the next event, or to `until`, and switch; return the event's name."""
        self._catch_up()
        event = self.stepper.advance(until)
        found = None
        if event is not None:
            found = switch(self.network, self.stepper.y, event)
            self.events.append((self.stepper.t, found))
        self._catch_up()
        return found

    def _catch_up(self) -> None:
        """Switch what should have switched already, each part at most once."""
        for _ in range(1 + len(self.network.opened) + len(self.network.moving)):
            late = self.stepper.overdue()
            if late is None:
                return
            self.events.append((self.stepper.t, switch(self.network, self.stepper.y, late)))

    def _until_done(self, volume_m3: float, *, turning: bool) -> Outcome:
        """Advance until the oil has been moved and everything rests, or cannot be moved."""
        stepper, measured = self.stepper, self.network.piston_names[self.network.drive[0]["measured"]]
        area = self.network.pistons[self.network.drive[0]["measured"]]["S"]
        patience, checked = stepper.t + PATIENCE_S, self.position(stepper.y)
        settled = np.inf
        while stepper.t < settled:
            event = self._advance(min(patience, settled))
            if event == "stalled":
                return Outcome.MOTOR_STALLED
            if event == f"{measured} at its end stop":
                stop_motor(self.network, stepper.y)
                return Outcome.END_STOP
            if event == "at rest":
                return Outcome.REACHED
            if event == "target" and not turning:
                settled = stepper.t + SETTLING_S
            if settled < np.inf and self._rests():
                return Outcome.REACHED
            if stepper.t >= patience:
                moved = abs(self.position(stepper.y) - checked) * area
                if moved < LEAST_PROGRESS * volume_m3:
                    stop_motor(self.network, stepper.y)
                    return Outcome.NO_FLOW
                patience, checked = stepper.t + PATIENCE_S, self.position(stepper.y)
        return Outcome.REACHED

    def _rests(self) -> bool:
        return self.network.drive[0]["mode"] == LOCKED and bool(np.all(self.network.moving == STUCK))

    def _keep(self, name: str, outcome: Outcome, begin: float, first_segment: int, before: Array) -> None:
        net, y, book = self.network, self.stepper.y, self.network.first_entry
        used = y[book:] - before[book:]
        seen = np.concatenate([segment.seen for segment in self.stepper.segments[first_segment:]])
        states = [(segment.t, segment.states) for segment in self.stepper.segments[first_segment:]]
        revolved = sum(float(np.trapezoid(np.abs(rows[:, 0]), t)) for t, rows in states)
        moved = float(y[1 + net.bladder] - before[1 + net.bladder])
        swept = revolved * float(net.drive[0]["q_rad"])
        piston_swept = abs(self.position(y) - self.position(before)) * float(net.pistons[net.drive[0]["measured"]]["S"])
        self.phases.append(
            PhaseResult(
                name=name,
                outcome=outcome,
                begin_s=begin,
                duration_s=self.stepper.t - begin,
                moved_m3=moved,
                piston_m=(self.position(before), self.position(y)),
                energy_j=float(used[SUPPLY]),
                losses_j={loss: float(used[LEDGER.index(loss)]) for loss in LOSSES},
                sea_work_j=float(used[SEA]),
                hull_gas_work_j=float(used[HULL_GAS]),
                stored_j=stored_energy(net, y) - stored_energy(net, before),
                peak_current_a=float(np.abs(seen[:, CURRENT]).max()),
                peak_supply_current_a=float(seen[:, POWER].max() / net.drive[0]["U"]),
                volumetric_efficiency=piston_swept / swept if swept > 0.0 else None,
            )
        )

    def result(self, name: str, *, ideal: bool) -> EngineRun:
        """Everything that happened."""
        net, y = self.network, self.stepper.y
        lost = abs(all_oil(net, y) - all_oil(net, self.at_begin))
        seen = np.concatenate([segment.seen for segment in self.stepper.segments])
        return EngineRun(
            name=name,
            pressure_pa=float(net.drive[0]["pressure"]),
            ideal=ideal,
            phases=tuple(self.phases),
            events=tuple(self.events),
            courses=self._courses(seen),
            oil_residual=lost / self.most_asked,
            lowest_pressure_pa=float(seen[:, FIRST_PRESSURE:].min()),
        )

    def _courses(self, seen: Array) -> Courses:
        net = self.network
        states = np.concatenate([segment.states for segment in self.stepper.segments])
        bladder = states[:, 1 + net.bladder]
        return Courses(
            t_s=np.concatenate([segment.t for segment in self.stepper.segments]),
            piston_mm=states[:, net.first_position + net.drive[0]["measured"]] * 1e3,
            bladder_ml=(bladder - bladder[0]) * 1e6,
            flow_ml_s=seen[:, BLADDER_FLOW] * 1e6,
            motor_rpm=states[:, 0] * 30.0 / pi,
            current_a=seen[:, CURRENT],
            voltage_v=seen[:, VOLTAGE],
            power_w=seen[:, POWER],
            pressure_mpa={node: seen[:, FIRST_PRESSURE + n] / 1e6 for n, node in enumerate(net.node_names)},
        )


def _on_the_grid(position_m: float, step_m: float, towards: int) -> float:
    """First reading of the sensor at or beyond a position in the direction of travel [m]."""
    steps = position_m / step_m
    return step_m * (floor(steps + 1e-6) if towards < 0 else ceil(steps - 1e-6))
