"""The coordinator: frames and bytes in, frames and bytes out, once a second. No port, no clock, no thread."""

from collections.abc import Iterable, Mapping

from stommel.control.commands import Commands
from stommel.control.dive_cycle import SURFACE
from stommel.control.orders import Orders
from stommel.messages.codec import Encoder
from stommel.messages.database import COORDINATOR, MOTION, value_named
from stommel.messages.frames import Frame
from stommel.messages.nodes import HeartbeatSender, NodeState
from stommel.onboard.coordination.assessment import Inside, situation_of
from stommel.onboard.coordination.deciding import Decide, Pilot
from stommel.onboard.coordination.engine_proof import EngineProof, Oil
from stommel.onboard.coordination.executive import FLOWN, Executive, ExecutiveState, State
from stommel.onboard.coordination.executive_commands import commands as commands_of
from stommel.onboard.coordination.health import CTD, GPS, RADIO, Health
from stommel.onboard.coordination.logbook.logbook import Logbook
from stommel.onboard.coordination.navigation import NavigationEstimate, Navigator
from stommel.onboard.coordination.node_parameters import NodeParameters
from stommel.onboard.coordination.nodes_control import NodesControl
from stommel.onboard.coordination.own_instruments import OwnInstruments
from stommel.onboard.coordination.perception import Perception
from stommel.onboard.coordination.power import BatteryAccount, BatteryEstimate, Sleeper, wakes
from stommel.onboard.coordination.recording import Recorder
from stommel.onboard.coordination.safety import SafetyMonitor, standing_alarms
from stommel.onboard.coordination.settings import CoordinatorSettings
from stommel.onboard.coordination.situation import NO_REQUESTS, OperatorRequests, Situation
from stommel.onboard.coordination.sources import Periods, Sources
from stommel.onboard.coordination.stores.continuity import Continuity, ContinuityStore
from stommel.onboard.coordination.view import View

PROVING_TIME = 45.0
"""Before a dive, in which the drives prove themselves again: a test that finds a dead pump takes half a minute [s]."""
CTD_PATIENCE = 10.0
"""Time beyond two intervals without a sample, after which the payload is silent [s]."""
LATEST_TIME = 1e9
"""The greatest time that Sync can say [s]."""


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
    store
        What outlived a restart, and where to keep what must outlive the next; None: it has never started before.
    decision
        In place of plain Python's `stommel.control.decision.decide`.
    """

    def __init__(
        self,
        settings: CoordinatorSettings,
        t: float,
        *,
        logbook: Logbook | None = None,
        store: ContinuityStore | None = None,
        decision: Decide | None = None,
    ) -> None:
        before = Continuity() if store is None else store.kept
        self.settings = settings
        self.perception = Perception(t)
        self.pilot = Pilot(decision)
        self.safety = SafetyMonitor(settings.safety, settings.has_drop_weight, before.standing)
        self.executive = Executive(started=before.started)
        self.instruments = OwnInstruments(settings, self.perception)
        self.recorder = Recorder(logbook, settings.report_every)
        self.view: View | None = None
        self.expires = float("inf")
        """Time at which the mission's time is over [s]."""
        self.key_alarm = False
        """Whether somebody has to look after the radio's key; the link says so."""
        self._encoder = Encoder()
        self._heartbeat = HeartbeatSender(COORDINATOR, self._encoder, before.starts, settings.kind)
        self._nodes = NodesControl.of(self._encoder, before.starts)
        self.parameters = NodeParameters(self._encoder, settings.node_parameters)
        self._proof = EngineProof(settings.actuators.V_b_least, settings.actuators.V_b_greatest)
        self._navigator: Navigator | None = None
        usable = settings.usable_energy
        self._battery = None if usable is None else BatteryAccount(usable, mean_over=settings.mean_power_over)
        self._sleeper = Sleeper(settings.schedule)
        self._store, self._before = store, before
        self.mission = before.mission
        """Number of the mission that is flown; 0 for none."""
        self._requests = NO_REQUESTS
        self._was_surfaced = True
        self._sources = Sources(self.perception, self.instruments, t, has_altimeter=settings.has_altimeter)
        self.health = self._sources.monitor
        self._mission_samples_every: float | None = None
        self._sample_every = self._wanted_samples()

    def request(self, requests: OperatorRequests) -> None:
        """Ask for something, at the next decision, beside what was asked before it."""
        self._requests = OperatorRequests(*(a or b for a, b in zip(self._requests, requests, strict=True)))

    def self_test(self) -> None:
        """Have the motion node move each drive a little; `self_test_result` tells what came of it."""
        self._nodes.ask_self_test()

    @property
    def self_test_result(self) -> str | None:
        """Drives that did not follow in the self-test that was asked for last, in words; None until it is over."""
        return self._nodes.self_test_result

    def stay_at_surface(self, time: float) -> None:
        """Stay at the surface for so long after each dive [s], until another mission is adopted."""
        orders = self.pilot.orders
        if orders is not None:
            dives = orders.dives._replace(
                surface_time=time, longest_surface_time=max(time, orders.dives.longest_surface_time)
            )
            self.pilot.orders = orders._replace(dives=dives)

    def aim_at(self, waypoint: int) -> str:
        """Aim at another waypoint of the mission, by its number; why not, in words, or nothing."""
        memory, orders = self.pilot.memory, self.pilot.orders
        if memory is None or orders is None:
            return "the vehicle does not know its position yet"
        if not 0 <= waypoint < len(orders.waypoints):
            return f"waypoint {waypoint}: must be between 0 and {len(orders.waypoints) - 1}"
        memory["waypoint"], memory["until_guidance"] = waypoint, 0
        memory["line_latitude"], memory["line_longitude"] = memory["latitude"], memory["longitude"]
        return ""

    def adopt(
        self, orders: Orders, expires: float = float("inf"), mission: int = 0, sample_every: float | None = None
    ) -> None:
        """Take the orders of a mission that has been validated, and fly them until a time [s].

        The mission that was flown before a restart, by its number, is taken up where it was. `sample_every` is the time
        between two samples of the CTD [s]; None leaves it to the configuration.
        """
        before = self._before
        taken_up = mission == before.mission and before.starts > 0
        self.pilot.adopt(orders, *((before.waypoint, before.energy_used) if taken_up else ()))
        self.expires, self.mission, self._mission_samples_every = expires, mission, sample_every

    def step(
        self, t: float, frames: Iterable[Frame], bytes_in: Mapping[str, bytes]
    ) -> tuple[list[Frame], dict[str, bytes]]:
        """Take what has come since the last call, and say what shall be until the next."""
        seen = self.perception
        for received in seen.take(frames, t):
            self._nodes.take(received, t)
            self.parameters.take(received, t)
            self.recorder.received(received, t)
            self._sleeper.hear(wakes(received))
        self.instruments.hear(t, bytes_in, self.pilot.phase)
        aborts = self.view is not None and self.view.executive.state is State.ABORT
        if self.view is not None and not self._sleeper.due(t, self.pilot.phase, aborts) and not self._is_asked:
            return self._keep_alive(t), self._ask(t, self.view.commands)
        view = self._decide(t)
        self._note_switches(view.commands, t)
        self._keep(view)
        return self._say(t, view.executive, view.commands), self._ask(t, view.commands)

    @property
    def _is_asked(self) -> bool:
        return self._requests is not NO_REQUESTS

    def _decide(self, t: float) -> View:
        """Look at the situation, decide, and write it down."""
        seen, pilot = self.perception, self.pilot
        readings = seen.readings()
        situation = situation_of(seen, self._inside(t), readings, t)
        requests, self._requests = self._requests, NO_REQUESTS
        if requests.check:
            self.safety.checks.again()
        if requests.clear:
            self._nodes.clear_faults(t)
        safety = self.safety.update(situation, clear=requests.clear)
        state = self.executive.update(situation, safety, requests)
        control = pilot.step(readings, state, t, self._sleeper.elapsed)
        commands = self._floats_until_proven(t, state, commands_of(state, control, self.settings.actuators))
        health = self._look_after(situation, t)
        outcomes = self.parameters.outcomes()
        self.view = view = View(
            t, situation, safety, state, commands, health, outcomes, self._navigate(t), self._account(t)
        )
        self.recorder.decided(view, pilot, readings, self._nodes.outcomes(), seen)
        return view

    def _floats_until_proven(self, t: float, state: ExecutiveState, commands: Commands) -> Commands:
        """Hold a descent where the vehicle still floats until the engine has proved itself there."""
        seen, pilot = self.perception, self.pilot
        if state.state not in FLOWN or pilot.orders is None:
            return commands
        stuck = seen.watch.reports(MOTION, "ValveStuck") or seen.watch.reports(MOTION, "PumpStuck")
        oil = Oil(seen.value("MotionStatus", "ballast"), seen.heard.get("MotionStatus", float("-inf")), stuck)
        V_b = self._proof.allowed(t, pilot.phase, commands.V_b, pilot.orders.dives.V_b_climb, oil)
        return commands if V_b == commands.V_b else commands._replace(V_b=V_b)

    def _look_after(self, situation: Situation, t: float) -> Health:
        """Say of each node and instrument how it does."""
        compass_every = self.instruments.compass_every(self.pilot.phase)
        return self._sources.look(situation, Periods(compass_every, self.settings.gnss.interval, self._sample_every), t)

    def _navigate(self, t: float) -> NavigationEstimate | None:
        """Follow how far the position may be wrong."""
        memory = self.pilot.memory
        if memory is None:
            return None
        if self._navigator is None:
            self._navigator = Navigator(self.settings.navigation)
        return self._navigator.update(memory, t, self.instruments.take_fix_sigma())

    def _account(self, t: float) -> BatteryEstimate | None:
        """Follow what is left in the battery."""
        memory = self.pilot.memory
        if memory is None or self._battery is None:
            return None
        return self._battery.update(t, float(memory["energy_used"]))

    def _keep(self, view: View) -> None:
        """Keep what must outlive a restart: at once what an operator or safety did, the way once a surfacing."""
        if self._store is None:
            return
        last, memory, executive = self._store.kept, self.pilot.memory, view.executive
        standing = standing_alarms(view.safety) if view.safety.active else ()
        waypoint, used = last.waypoint, last.energy_used
        if memory is not None and (self.mission != last.mission or executive.surfaced != self._was_surfaced):
            waypoint, used = int(memory["waypoint"]), max(0.0, float(memory["energy_used"]))
        self._was_surfaced = executive.surfaced
        kept = Continuity(self._before.starts + 1, executive.started, standing, self.mission, waypoint, used)
        self._store.keep(kept)

    def _inside(self, t: float) -> Inside:
        pilot, seen = self.pilot, self.perception
        heard = seen.heard.get("CtdSample", float("-inf"))
        ctd_silent = t - max(heard, self.health.since(CTD)) > 2.0 * self._sample_every + CTD_PATIENCE
        return Inside(
            phase=pilot.phase,
            event=pilot.event,
            alarm=pilot.alarm,
            submerged_since=pilot.submerged_since,
            coming_up=self.view is not None and self.view.executive.coming_up,
            gps_silent=self.instruments.gps_silent(self.health.since(GPS), t),
            ctd_silent=ctd_silent,
            mission_present=pilot.orders is not None,
            mission_expired=t >= self.expires,
            exceptions=pilot.exceptions,
            log_writable=self.recorder.writable,
            key_alarm=self.key_alarm,
            drives_proven=self._nodes.drives_proven,
            has_altimeter=self.settings.has_altimeter,
        )

    def _note_switches(self, commands: Commands, t: float) -> None:
        """Remember since when receiver, radio and payload are on."""
        self.health.switch(GPS, commands.radio, t)
        self.health.switch(RADIO, commands.radio, t)
        every = self._wanted_samples()
        if every != self._sample_every:
            self._sample_every = every
            self.health.switch(CTD, False, t)  # what was heard at another interval says nothing of this one
        self.health.switch(CTD, commands.sampling, t)

    def _wanted_samples(self) -> float:
        """Time between two samples of the CTD [s]: that of the mission, else that of the configuration."""
        every = self._mission_samples_every
        return self.settings.schedule.ctd[self.pilot.phase] if every is None else every

    def _dives_soon(self, state: ExecutiveState, t: float) -> bool:
        """Whether the stay at the surface is nearly over: a pump that died since it last ran must be found up here."""
        memory, orders = self.pilot.memory, self.pilot.orders
        if state.state is not State.COMMUNICATE or memory is None or orders is None or state.phase != SURFACE:
            return False
        return t - float(memory["since"]) >= orders.dives.surface_time - PROVING_TIME

    def _keep_alive(self, t: float) -> list[Frame]:
        """Frames of a controller that sleeps on: the nodes hold what they were told."""
        return [self._encoder.frame("Sync", vehicle_time=_sayable(t)), *self._heartbeat.poll(t, NodeState.Operational)]

    def _say(self, t: float, state: ExecutiveState, commands: Commands) -> list[Frame]:
        """Frames to the nodes, the most urgent first."""
        frame = self._encoder.frame
        frames = []
        if state.state is State.ABORT:
            reason = value_named("Abort", "reason", state.reason)
            frames.append(frame("Abort", reason=reason, drop_weight=state.drop_weight))
        frames.append(frame("Sync", vehicle_time=_sayable(t)))
        frames.append(
            frame("MotionSetpoint", ballast=commands.V_b, moving_mass=commands.r_px, steering=commands.steering)
        )
        frames.append(
            frame(
                "Switch",
                loads=commands.loads,
                sampling=commands.sampling,
                surface_radio=commands.radio,
                sample_interval=self._sample_every,
            )
        )
        frames += self._nodes.step(self.perception.watch, state, t, dives_soon=self._dives_soon(state, t))
        frames += self.parameters.step(self.perception.watch, t)
        frames += self._heartbeat.poll(t, NodeState.Operational)
        return frames

    def _ask(self, t: float, commands: Commands) -> dict[str, bytes]:
        phase = self.pilot.phase
        return self.instruments.ask(t, commands, phase, self._sleeper.sleeps_until(phase))


def _sayable(t: float) -> float:
    """A time as a frame can say it [s]: a clock that is wrong must not keep the software from speaking."""
    return min(max(t, 0.0), LATEST_TIME)
