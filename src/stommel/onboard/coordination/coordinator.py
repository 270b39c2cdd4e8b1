"""The coordinator: frames and bytes in, frames and bytes out, once a second. No port, no clock, no thread."""

from collections.abc import Iterable, Mapping
from typing import NamedTuple

from stommel.control.commands import Commands
from stommel.control.orders import Orders
from stommel.messages.codec import Encoder
from stommel.messages.database import COORDINATOR, value_named
from stommel.messages.frames import Frame
from stommel.messages.nodes import HeartbeatSender, NodeState
from stommel.onboard.coordination.assessment import Inside, situation_of
from stommel.onboard.coordination.compass.calibration import running_bits
from stommel.onboard.coordination.compass.compensation import CompassCompensation
from stommel.onboard.coordination.deciding import Decide, Pilot
from stommel.onboard.coordination.executive import Executive, ExecutiveState, State
from stommel.onboard.coordination.executive_commands import commands as commands_of
from stommel.onboard.coordination.logbook.logbook import Logbook
from stommel.onboard.coordination.nodes_control import NodesControl
from stommel.onboard.coordination.perception import Perception
from stommel.onboard.coordination.recording import Recorder
from stommel.onboard.coordination.safety import SafetyMonitor, SafetyState
from stommel.onboard.coordination.settings import CoordinatorSettings
from stommel.onboard.coordination.situation import NO_REQUESTS, OperatorRequests, Situation
from stommel.onboard.instruments.gnss.driver import GnssDriver, GnssState
from stommel.onboard.instruments.gnss.fix import Fix
from stommel.onboard.instruments.radio import Radio
from stommel.onboard.instruments.tcm.driver import CompassDriver

COMPASS, GNSS, RADIO = "compass", "gnss", "radio"
PORTS = (COMPASS, GNSS, RADIO)
"""Serial ports of the coordinator."""

GPS_PATIENCE = 10.0
"""Time after switching on in which a receiver need not say anything [s]."""
CTD_PATIENCE = 10.0
"""Time beyond two intervals without a sample, after which the payload is silent [s]."""


class View(NamedTuple):
    """What the coordinator made of the last second, for logs, live views and tests."""

    t: float
    situation: Situation
    safety: SafetyState
    executive: ExecutiveState
    commands: Commands


class Coordinator:
    """The vehicle's coordination software.

    Parameters
    ----------
    settings
        Numbers of the vehicle.
    t
        Time at which it is switched on [s].
    logbook
        Where records go; None keeps none.
    restarts
        How often it has started before.
    standing
        Alarms that stood before a restart (`stommel.onboard.coordination.safety.standing_alarms`).
    started
        Whether the operator had started the mission before a restart.
    decision
        In place of plain Python's `stommel.control.decision.decide`.
    """

    def __init__(
        self,
        settings: CoordinatorSettings,
        t: float,
        *,
        logbook: Logbook | None = None,
        restarts: int = 0,
        standing: tuple[str, ...] = (),
        started: bool = False,
        decision: Decide | None = None,
    ) -> None:
        self.settings = settings
        self.perception = Perception(t)
        self.pilot = Pilot(decision)
        self.safety = SafetyMonitor(settings.safety, settings.has_drop_weight, standing)
        self.executive = Executive(started=started)
        self.compass, self.gnss, self.radio = CompassDriver(settings.compass), GnssDriver(settings.gnss), Radio()
        self.recorder = Recorder(logbook, settings.report_every)
        self.view: View | None = None
        self.expires = float("inf")
        """Time at which the mission's time is over [s]."""
        self._compensation = CompassCompensation(settings.calibration, settings.masking, settings.declination)
        self._encoder = Encoder()
        self._heartbeat = HeartbeatSender(COORDINATOR, self._encoder, restarts, settings.kind)
        self._nodes = NodesControl.of(self._encoder, restarts)
        self._requests = NO_REQUESTS
        self._radio_since = self._sampling_since = float("inf")

    def request(self, requests: OperatorRequests) -> None:
        """Ask for something, at the next decision."""
        self._requests = requests

    def adopt(self, orders: Orders, expires: float = float("inf")) -> None:
        """Take the orders of a mission that has been validated, and fly them until a time [s]."""
        self.pilot.adopt(orders)
        self.expires = expires

    def step(
        self, t: float, frames: Iterable[Frame], bytes_in: Mapping[str, bytes]
    ) -> tuple[list[Frame], dict[str, bytes]]:
        """Take what has come since the last call, and say what shall be until the next."""
        seen = self.perception
        for received in seen.take(frames, t):
            self._nodes.take(received, t)
            self.recorder.received(received, t)
        self._hear(t, bytes_in)
        readings = seen.readings()
        situation = situation_of(seen, self._inside(t), readings, t)
        requests, self._requests = self._requests, NO_REQUESTS
        if requests.check:
            self.safety.checks.again()
        if requests.clear:
            self._nodes.clear_faults(t)
        safety = self.safety.update(situation, clear=requests.clear)
        state = self.executive.update(situation, safety, requests)
        commands = commands_of(state, self.pilot.step(readings, state, t), self.settings.actuators)
        self._note_switches(commands, t)
        self.view = View(t, situation, safety, state, commands)
        self.recorder.decided(self.view, self.pilot, readings, self._nodes.outcomes(), seen)
        return self._say(t, state, commands), self._ask(t, commands)

    def _hear(self, t: float, bytes_in: Mapping[str, bytes]) -> None:
        """Let the drivers make readings of the ports' bytes."""
        seen = self.perception
        drives = seen.latest.get("MotionDrives", {})
        for got in self.compass.take(bytes_in.get(COMPASS, b""), t):
            running = running_bits(
                bool(drives.get("pump_running")), bool(drives.get("valve_open")), bool(drives.get("mass_moving")),
                bool(drives.get("steering_moving")),
            )  # fmt: skip
            estimate = self._compensation.update(got.t, got.acceleration, got.magnetic_field, running)
            attitude = seen.attitude
            attitude.at, attitude.theta, attitude.psi = t, estimate.pitch, estimate.heading
            attitude.down_b2, attitude.down_b3 = estimate.down_b2, estimate.down_b3
            attitude.gravity, attitude.field = _length(got.acceleration), _length(got.magnetic_field)
        if bytes_in.get(GNSS):
            depth = seen.value("Depth", "depth", float("nan"))
            for outcome in self.gnss.take(bytes_in[GNSS], t, depth):
                if isinstance(outcome, Fix):
                    seen.take_fix(outcome.t - outcome.age, outcome.latitude, outcome.longitude)
        self.radio.take(bytes_in.get(RADIO, b""), t)

    def _inside(self, t: float) -> Inside:
        pilot, seen = self.pilot, self.perception
        gps_on = t - self._radio_since
        speaks = (GnssState.SEARCHING, GnssState.FIXED, GnssState.REFUSED)
        gps_silent = gps_on > GPS_PATIENCE and self.gnss.health(t).state not in speaks
        heard = seen.heard.get("CtdSample", float("-inf"))
        ctd_silent = t - max(heard, self._sampling_since) > 2.0 * self.settings.sample_interval + CTD_PATIENCE
        return Inside(
            phase=pilot.phase,
            event=pilot.event,
            alarm=pilot.alarm,
            submerged_since=pilot.submerged_since,
            coming_up=self.view is not None and self.view.executive.coming_up,
            gps_silent=gps_silent,
            ctd_silent=ctd_silent,
            mission_present=pilot.orders is not None,
            mission_expired=t >= self.expires,
            exceptions=pilot.exceptions,
            log_writable=self.recorder.writable,
            drives_proven=self._nodes.drives_proven,
            has_altimeter=self.settings.has_altimeter,
        )

    def _note_switches(self, commands: Commands, t: float) -> None:
        """Remember since when receiver and payload are on."""
        self._radio_since = min(self._radio_since, t) if commands.radio else float("inf")
        self._sampling_since = min(self._sampling_since, t) if commands.sampling else float("inf")

    def _say(self, t: float, state: ExecutiveState, commands: Commands) -> list[Frame]:
        """Frames to the nodes, the most urgent first."""
        frame = self._encoder.frame
        frames = []
        if state.state is State.ABORT:
            reason = value_named("Abort", "reason", state.reason)
            frames.append(frame("Abort", reason=reason, drop_weight=state.drop_weight))
        frames.append(frame("Sync", vehicle_time=t))
        frames.append(
            frame("MotionSetpoint", ballast=commands.V_b, moving_mass=commands.r_px, steering=commands.steering)
        )
        frames.append(
            frame(
                "Switch",
                loads=commands.loads,
                sampling=commands.sampling,
                surface_radio=commands.radio,
                sample_interval=self.settings.sample_interval,
            )
        )
        frames += self._nodes.step(self.perception.watch, state, t)
        frames += self._heartbeat.poll(t, NodeState.Operational)
        return frames

    def _ask(self, t: float, commands: Commands) -> dict[str, bytes]:
        """Bytes to the instruments; those without power are not asked."""
        out = {COMPASS: self.compass.poll(t)}
        if commands.radio:
            out[GNSS] = self.gnss.poll(t)
            out[RADIO] = self.radio.poll(t)
        return out


def _length(vector: tuple[float, float, float]) -> float:
    x, y, z = vector
    return float((x * x + y * y + z * z) ** 0.5)
