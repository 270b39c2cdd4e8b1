"""What the coordinator writes into the log: each decision whole, the rest now and then, and whatever happens."""

import math
from collections.abc import Iterable

import numpy as np

from stommel.control.memory import MEMORY
from stommel.control.readings import Readings
from stommel.messages.codec import Received
from stommel.messages.commanding import Outcome
from stommel.onboard.coordination.deciding import Pilot
from stommel.onboard.coordination.health import CONDITIONS, Condition, Health
from stommel.onboard.coordination.logbook import records
from stommel.onboard.coordination.logbook.logbook import Logbook
from stommel.onboard.coordination.navigation import NavigationEstimate
from stommel.onboard.coordination.perception import Perception
from stommel.onboard.coordination.view import View

_MOST = 0xFFFFFFFF
"""Greatest count of a record."""
_MEMORY = MEMORY.names or ()


class Recorder:
    """Writes records, if there is a logbook.

    Parameters
    ----------
    logbook
        Where they go; None keeps none.
    report_every
        Between two records of hull, battery and bus [s].
    """

    def __init__(self, logbook: Logbook | None, report_every: float) -> None:
        self._log = logbook
        self._report_every = report_every
        self._next_report = float("-inf")
        self._words = ""
        self._failure = ""
        self._conditions: dict[str, Condition] = {}

    @property
    def logbook(self) -> Logbook | None:
        """Where the records go."""
        return self._log

    @property
    def writable(self) -> bool:
        """Whether the disk takes records; without a logbook nothing is missing."""
        return self._log is None or not self._log.blocked

    def received(self, message: Received, t: float) -> None:
        """Write down a sample of the payload, or a fault that a node tells."""
        if self._log is None:
            return
        v = message.values
        if message.name == "CtdSample":
            self._log.append(records.CTD, (t, v["conductivity"], v["temperature"], v["pressure"]))
        elif message.name.endswith("Emergency"):
            state = "begins" if v["active"] else "ends"
            self._log.event(t, "node:emergency", f"{message.name} {int(v['code'])} {state}, detail {int(v['detail'])}")

    def decided(
        self, view: View, pilot: Pilot, readings: Readings, outcomes: Iterable[Outcome], seen: Perception
    ) -> None:
        """Write down a decision and what led to it; changes of state and alarms in words."""
        log, t = self._log, view.t
        if log is None:
            return
        log.append(records.READINGS, (t, *readings))
        log.append(records.COMMANDS, (t, *view.commands))
        self._write_drives(log, seen, t)
        if pilot.memory is not None:
            self._write_memory(log, pilot.memory, t)
        if view.navigation is not None:
            self._write_navigation(log, view.navigation)
        if view.executive.words != self._words:
            self._words = view.executive.words
            log.event(t, "executive", f"{self._words}: {view.executive.because}")
        for name in view.safety.raised:
            log.event(t, "safety:raised", name)
        for name in view.safety.cleared:
            log.event(t, "safety:cleared", name)
        for outcome in outcomes:
            log.event(t, "command", f"{outcome.command} to node {outcome.target}: {outcome.result} {outcome.detail}")
        for parameter in view.parameters:
            log.event(t, "parameter", parameter.words)
        if pilot.exceptions and pilot.failure != self._failure:
            self._failure = pilot.failure
            log.event(t, "exception", pilot.failure)
        reports = t >= self._next_report
        self._write_health(log, view.health, whole=reports)
        if reports:
            self._next_report = t + self._report_every
            self._write_report(log, pilot, seen, t)
        log.step(t)

    def _write_health(self, log: Logbook, health: Health, *, whole: bool) -> None:
        """Write down sources whose condition has changed, or all."""
        conditions = self._conditions
        for k, source in enumerate(health.sources):
            name, condition, age, *counts = source
            if whole or conditions.get(name) is not condition:
                conditions[name] = condition
                number = CONDITIONS.index(condition.value)
                log.append(records.HEALTH, (health.t, k, number, age, *(min(count, _MOST) for count in counts)))

    @staticmethod
    def _write_drives(log: Logbook, seen: Perception, t: float) -> None:
        says, value = seen.says, seen.value
        log.append(
            records.ACTUATORS,
            (
                t, value("MotionStatus", "ballast"), value("MotionStatus", "moving_mass"),
                value("MotionStatus", "steering"), says("MotionDrives", "limit_fore"),
                says("MotionDrives", "limit_aft"), value("MotionDrives", "pump_current"),
                value("MotionDrives", "mass_current"), value("MotionDrives", "steering_current"),
            ),
        )  # fmt: skip

    @staticmethod
    def _write_memory(log: Logbook, memory: np.record, t: float) -> None:
        m = dict(zip(_MEMORY, memory.item(), strict=True))
        dives_here = int(min(m["dives_here"], _MOST))
        log.append(
            records.DECISION,
            (
                t, int(m["phase"]), m["since"], m["submerged_since"], int(m["dives"]), dives_here, int(m["event"]),
                m["alarm"], m["waypoint"], m["heading_wanted"],
            ),
        )  # fmt: skip

    @staticmethod
    def _write_navigation(log: Logbook, at: NavigationEstimate) -> None:
        sigma = math.hypot(at.sigma_north, at.sigma_east)
        log.append(records.NAVIGATION, (at.t, at.latitude, at.longitude, sigma, at.current_north, at.current_east))

    @staticmethod
    def _write_report(log: Logbook, pilot: Pilot, seen: Perception, t: float) -> None:
        says, value = seen.says, seen.value
        log.append(
            records.HULL,
            (
                t, value("Hull", "internal_pressure"), value("Hull", "temperature"), says("Hull", "leak_fore"),
                says("Hull", "leak_aft"), says("Hull", "leak_measured"),
            ),
        )  # fmt: skip
        used = 0.0 if pilot.memory is None else float(pilot.memory["energy_used"])
        log.append(
            records.BATTERY,
            (t, value("Battery", "voltage"), value("Battery", "current"), value("Battery", "temperature"), used),
        )
        decoder = seen.decoder
        log.append(
            records.CAN_STATISTICS,
            (t, decoder.received.total(), decoder.rejected.total(), decoder.lost.total(), 0, 0.0),
        )
