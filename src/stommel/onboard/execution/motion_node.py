"""The motion-control node: frames and readings in, frames and drive outputs out."""

from collections.abc import Sequence
from math import inf, isnan

from stommel.messages.codec import Received
from stommel.messages.commanding import Order
from stommel.messages.database import MOTION
from stommel.messages.frames import Frame
from stommel.messages.nodes import UNSTATED, NodeKind
from stommel.messages.parameters import ParameterStore, ParameterType, to_bits
from stommel.onboard.execution.exercise import OIL_STILL, Exercise
from stommel.onboard.execution.motion_drives import MotionDrives
from stommel.onboard.execution.motion_io import AT_REST, DriveOutputs, MotionReadings
from stommel.onboard.execution.node_link import NodeLink
from stommel.onboard.execution.node_states import Event, Mode
from stommel.onboard.nodes.motion_settings import MotionSettings

BLOWING = frozenset((Mode.LEFT_ALONE, Mode.ABORTED))
"""Modes in which the node pumps all oil out and takes the mass aft; in others, but operational, it stops and brakes."""

AT_WORK, AT_REST_PERIOD = 0.1, 1.0
"""Between two frames of status, while something moves and while nothing does [s]."""
_EARLY = 1e-6
"""Times that are sums of steps fall short by rounding [s]."""

STATUS_LIMITS = (3e-3, 0.6, 1.6)
"""Greatest ballast volume, position and angle that the status can say."""
MOST_CURRENT = 20.46
"""Greatest current that a frame can say [A]."""

NO_OIL, NO_MASS, NO_STEERING, BROKEN_SWITCH, CURRENT_AT_REST, STUCK = 1, 2, 4, 8, 16, 32
"""Bits of what a self-test found: sensors that do not answer, a switch, too much current, drives given up."""

CREPT = 30
"""Number of the parameter `oil_crept`."""

_EVENTS = {"Start": Event.START, "Stop": Event.STOP, "Brake": Event.BRAKE, "Blow": Event.ABORT}


class MotionNode:
    """The node that closes the loops of buoyancy engine, pitch drive and steering.

    `step` may be called more than once at a time: the drives learn from the first call, and do what the last one says.
    """

    def __init__(
        self,
        settings: MotionSettings,
        restarts: int = 0,
        store: ParameterStore | None = None,
        kind: NodeKind = UNSTATED,
    ) -> None:
        self.link = NodeLink(MOTION, settings, restarts, store, kind)
        self.drives = self._new_drives(settings)
        self.outputs = AT_REST
        self.weight_released = False
        """Whether the drop weight was told to go."""
        self._goals: tuple[float, float, float] | None = None
        self._exercise: tuple[Order, Exercise] | None = None
        self._release_ends = -inf
        self._told_at = -inf

    def _new_drives(self, settings: MotionSettings) -> MotionDrives:
        """Drives that have not moved yet, with the values of the parameters; what crept away counts on."""
        drives = MotionDrives(self.link.settings_with(settings))
        drives.engine.crept = self._creep_told = drives.settings.oil_crept
        return drives

    @property
    def settings(self) -> MotionSettings:
        """Settings that hold now."""
        return self.drives.settings

    def step(
        self, t: float, frames: Sequence[Frame], readings: MotionReadings, interval: float
    ) -> tuple[list[Frame], DriveOutputs]:
        """Take frames and readings at a time [s]; return frames, and what the drives do for an interval [s]."""
        link, drives, ran = self.link, self.drives, self.outputs
        fresh = link.begin_step(t)
        drives.observe(link.now, readings)
        for received in link.hear(frames):
            self._take(received, readings)
        settings = drives.settings
        link.watch_silence(settings.quiet_after, settings.blow_after)
        self._go_on_with_exercise()
        self.outputs = self._drive(interval)
        if fresh:
            self._report()
            self._tell(readings, ran)
        return link.end_step(), self.outputs

    def _drive(self, interval: float) -> DriveOutputs:
        link, drives = self.link, self.drives
        mode = link.modes.mode
        if mode is not Mode.OPERATIONAL:
            self._goals = None  # an old set point is not obeyed again
        if mode in BLOWING:
            self._drop_if_lost(mode)
        drop = link.now < self._release_ends
        if mode in BLOWING:
            return drives.blow(interval, drop=drop)
        if self._exercise is not None:
            return drives.drive(*self._exercise[1].goals, interval, drop=drop)
        if self._goals is None:
            return drives.hold(interval, drop=drop)
        return drives.drive(*self._goals, interval, drop=drop)

    def _go_on_with_exercise(self) -> None:
        """Look how far the self-test is, and say how it ended; whatever takes the node out of its mode ends it."""
        if self._exercise is None:
            return
        order, exercise = self._exercise
        if self.link.modes.mode is not Mode.OPERATIONAL:
            self._exercise = None
            self.link.acknowledge(order, "Refused")
            return
        exercise.observe(self.link.now)
        if exercise.done:
            self._exercise = None
            self.link.acknowledge(order, "Failed" if exercise.found else "Done", exercise.found)

    def _drop_if_lost(self, mode: Mode) -> None:
        """Drop the weight of a vehicle that nobody commands and that could not pump its oil out."""
        drives = self.drives
        s, engine = drives.settings, drives.engine
        lost = mode is Mode.LEFT_ALONE and self.link.silence >= s.drop_after
        if lost and not engine.reading >= s.ballast_high - s.oil_tolerance:
            self._drop_weight()

    def _drop_weight(self) -> bool:
        if not self.drives.settings.has_drop_weight:
            return False
        if not self.weight_released:
            self.weight_released = True
            self._release_ends = self.link.now + self.drives.settings.release_time
        return True

    def _take(self, received: Received, readings: MotionReadings) -> None:
        values = received.values
        if received.name == "MotionSetpoint":
            if self.link.obeys():
                self._goals = (values["ballast"], values["moving_mass"], values["steering"])
        elif received.name == "Abort":
            self.link.modes.take(Event.ABORT)
            if values["drop_weight"]:
                self._drop_weight()
        elif received.name == "MotionParameterRequest":
            self._set()
        else:
            order = self.link.order(received)
            if order is not None:
                self._obey(order, readings)

    def _obey(self, order: Order, readings: MotionReadings) -> None:
        link = self.link
        result, detail = "Refused", 0
        if order.command in _EVENTS:
            refused = order.command == "Start" and link.stranger
            if not refused and link.modes.take(_EVENTS[order.command]):
                result = "Done"
                if order.command == "Start":
                    self.drives.clear()
        elif order.command == "DropWeight":
            result = "Done" if self._drop_weight() else "Refused"
        elif order.command == "ClearFault":
            self.drives.clear()
            link.modes.take(Event.CLEAR)
            result = "Done"
        elif order.command == "SelfTest":
            detail = self.self_test(readings)
            result = "Failed" if detail else self._begin_exercise(order)
        elif order.command == "Restart":
            result = "Done"
        link.acknowledge(order, result, detail)
        if order.command == "Restart":
            self._restart()

    def _restart(self) -> None:
        self._goals, self._exercise, self._told_at = None, None, -inf
        self.link.restart()
        self.drives = self._new_drives(self.drives.settings)

    def _begin_exercise(self, order: Order) -> str:
        """Let each drive prove itself by moving, where the node may move them."""
        if self.link.modes.mode is not Mode.OPERATIONAL:
            return "Refused"
        if self._exercise is None:
            self._exercise = (order, Exercise(self.drives, self.link.now))
            return "InProgress"
        return "Refused"

    def self_test(self, readings: MotionReadings) -> int:
        """Bits of what is wrong with the drives before they are moved; 0 is well."""
        drives = self.drives
        found = [
            (NO_OIL, not drives.engine.measured),
            (NO_MASS, not drives.mass.measured),
            (NO_STEERING, not drives.steering.measured),
            (BROKEN_SWITCH, drives.switches.broken or (readings.limit_fore and readings.limit_aft)),
            (CURRENT_AT_REST, any(axis.over_current for axis in (drives.engine, drives.mass, drives.steering))),
            (OIL_STILL, drives.engine.slips),
            (STUCK, any(axis.stuck for axis in (drives.engine, drives.mass, drives.steering))),
        ]
        return sum(bit for bit, wrong in found if wrong)

    def _set(self) -> None:
        settings = self.link.settings_with(self.drives.settings)
        self.drives.engine.crept = self._creep_told = settings.oil_crept
        self.drives.set(settings)

    def _report(self) -> None:
        drives, report = self.drives, self.link.report
        engine, mass, steering = drives.engine, drives.mass, drives.steering
        report("PumpStuck", active=engine.given_up(engine.up))
        report("ValveStuck", active=engine.given_up(engine.down) or engine.slips, detail=int(engine.slips))
        report("MassStuck", active=mass.stuck)
        report("SteeringStuck", active=steering.stuck)
        hot = engine.over_current + 2 * mass.over_current + 4 * steering.over_current
        report("OverCurrent", active=hot > 0, detail=hot)
        report("LimitSwitch", active=drives.switches.broken)
        deaf = (not engine.measured) + 2 * (not mass.measured) + 4 * (not steering.measured)
        report("SensorRange", active=deaf > 0, detail=deaf)
        if engine.crept != self._creep_told:
            self._creep_told = engine.crept
            self.link.set_parameter(CREPT, to_bits(ParameterType.float32, min(engine.crept, 1.0)))

    def _tell(self, readings: MotionReadings, ran: DriveOutputs) -> None:
        out, now = self.outputs, self.link.now
        moves = _moves(ran) or _moves(out)
        if now < self._told_at + (AT_WORK if moves else AT_REST_PERIOD) - _EARLY:
            return
        self._told_at = now
        drives, say = self.drives, self.link.say
        engine, mass, steering = drives.engine, drives.mass, drives.steering
        oil, r_px, angle = (
            min(max(axis.reading, -most), most) if axis.measured else 0.0
            for axis, most in zip((engine, mass, steering), STATUS_LIMITS, strict=True)
        )
        say(
            "MotionStatus", ballast=oil, moving_mass=r_px, steering=angle, ballast_measured=engine.measured,
            mass_measured=mass.measured, steering_measured=steering.measured,
        )  # fmt: skip
        say(
            "MotionDrives", pump_running=ran.pump > 0.0, valve_open=ran.valve > 0.0, mass_moving=ran.mass != 0.0,
            steering_moving=ran.steering != 0.0, brake_on=ran.brake, limit_fore=drives.switches.fore,
            limit_aft=drives.switches.aft, weight_released=self.weight_released,
            pump_current=_sayable(readings.pump_current), mass_current=_sayable(readings.mass_current),
            steering_current=_sayable(readings.steering_current), engine_stuck=engine.stuck, mass_stuck=mass.stuck,
            steering_stuck=steering.stuck, limit_fault=drives.switches.broken,
            over_current=engine.over_current or mass.over_current or steering.over_current,
        )  # fmt: skip


def _moves(out: DriveOutputs) -> bool:
    return out.pump > 0.0 or out.valve > 0.0 or out.mass != 0.0 or out.steering != 0.0


def _sayable(current: float) -> float:
    return min(max(current, 0.0), MOST_CURRENT) if not isnan(current) else 0.0
