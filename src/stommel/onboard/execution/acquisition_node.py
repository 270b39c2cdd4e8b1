"""The data-acquisition node: readings, frames and the CTD's bytes in; frames, switches and bytes to the CTD out."""

from collections.abc import Sequence
from math import inf, isfinite, nan
from typing import Protocol

from stommel.messages.codec import Received
from stommel.messages.commanding import Order
from stommel.messages.database import ACQUISITION
from stommel.messages.frames import Frame
from stommel.messages.nodes import UNSTATED, NodeKind
from stommel.messages.parameters import ParameterStore
from stommel.onboard.execution.acquisition_io import AcquisitionOutputs, AcquisitionReadings
from stommel.onboard.execution.node_link import NodeLink
from stommel.onboard.execution.node_states import Event, Mode
from stommel.onboard.execution.self_tests import Proof, proof_of
from stommel.onboard.nodes.acquisition_settings import AcquisitionSettings

PERIOD = 1.0
"""Between two frames of each kind [s]."""
_EARLY = 1e-6
"""Times that are sums of steps fall short by rounding [s]."""

DEPTHS, ALTITUDES, HULL_PRESSURES = (-100.0, 8000.0), (0.0, 655.0), (0.0, 655350.0)
"""What a sensor can say [m], [m], [Pa]; anything else is an error value."""
TEMPERATURES, VOLTAGES, CURRENTS = (-40.0, 125.0), (0.0, 65.535), (-32.0, 32.0)
"""[degC], [V], [A]"""
CTD_LIMITS = ((-10.0, 10000.0), (-5.0, 99.8575), (-0.05, 10.4358))
"""Pressure [dbar], temperature [degC], conductivity [S/m] that a frame can say."""

NO_DEPTH, NO_ALTIMETER, NO_HULL_PRESSURE, NO_LEAK_LOOP, NO_BATTERY = 1, 2, 4, 8, 16
"""Bits of sensors that do not answer, detail of the emergency `SensorRange`."""

_EVENTS = {"Start": Event.START, "Stop": Event.STOP, "ClearFault": Event.CLEAR}
_ALONE = frozenset((Mode.QUIET, Mode.LEFT_ALONE))


class CtdDriver(Protocol):
    """What the node asks of the driver of its CTD."""

    def take(self, data: bytes, t: float) -> Sequence[tuple[float, float, float]]:
        """Take bytes that came at a time [s]; return samples: pressure [dbar], temperature [degC], conductivity."""

    def poll(self, t: float, sampling: bool, interval: float) -> bytes:
        """Return bytes to send at a time, so that it samples each `interval` seconds or not at all."""


class AcquisitionNode:
    """The node that reads sensors and switches consumers.

    Outputs of every step are to be used: they hold bytes for the CTD that are given once.
    """

    def __init__(
        self,
        settings: AcquisitionSettings,
        restarts: int = 0,
        store: ParameterStore | None = None,
        kind: NodeKind = UNSTATED,
        ctd: CtdDriver | None = None,
    ) -> None:
        self.link = NodeLink(ACQUISITION, settings, restarts, store, kind)
        self.settings = self.link.settings_with(settings)
        self.proof = Proof()
        self._ctd = ctd
        self._begin()

    def _begin(self) -> None:
        self.proof = Proof()
        self._loads, self._sampling, self._radio = self.settings.least_loads, False, False
        self._interval = PERIOD
        self._began = self._ctd_heard = self.link.now
        self._told_at = -inf
        self._voltage, self._current = _Mean(VOLTAGES), _Mean(CURRENTS)
        self._hull_temperature = self._battery_temperature = TEMPERATURES[0]

    def step(
        self, t: float, frames: Sequence[Frame], readings: AcquisitionReadings, ctd_bytes: bytes
    ) -> tuple[list[Frame], AcquisitionOutputs]:
        """Take frames, readings and the CTD's bytes at a time [s]; return frames and switches."""
        link = self.link
        fresh = link.begin_step(t)
        for received in link.hear(frames):
            self._take(received, readings)
        s = self.settings
        link.watch_silence(s.quiet_after, s.rest_after)
        if link.modes.mode is Mode.LEFT_ALONE:
            self._rest()
            self._radio = s.radio_left_alone
        if self._ctd is not None:
            self._hear_ctd(self._ctd.take(ctd_bytes, link.now))
        if fresh:
            self._voltage.add(readings.voltage)
            self._current.add(readings.current)
            if self.proof.missing and link.now - self._began <= s.settling:
                self.proof = Proof(*map(max, self.proof, proof_of(readings, s)))
            self._report(readings)
            if link.now >= self._told_at + PERIOD - _EARLY:
                self._told_at = link.now
                self._tell(readings)
        to_ctd = b"" if self._ctd is None else self._ctd.poll(link.now, self._sampling, self._interval)
        return link.end_step(), AcquisitionOutputs(self._loads, self._sampling, self._interval, self._radio, to_ctd)

    def _rest(self) -> None:
        self._loads, self._sampling = self.settings.least_loads, False

    def _take(self, received: Received, readings: AcquisitionReadings) -> None:
        if received.name == "Switch":
            self._switch(received.values)
        elif received.name == "Abort":
            self._sampling = False  # until the coordinator says otherwise; what it needs it switches
        elif received.name == "AcquisitionParameterRequest":
            self.settings = self.link.settings_with(self.settings)
        else:
            order = self.link.order(received)
            if order is not None:
                self._obey(order, readings)

    def _switch(self, values: dict[str, float]) -> None:
        mode = self.link.modes.mode
        if self.link.stranger or mode is Mode.STOPPED or mode in _ALONE:
            return
        sampling = bool(values["sampling"])
        if sampling and (not self._sampling or values["sample_interval"] != self._interval):
            self._ctd_heard = self.link.now
        self._loads, self._sampling, self._radio = int(values["loads"]), sampling, bool(values["surface_radio"])
        self._interval = values["sample_interval"]

    def _obey(self, order: Order, readings: AcquisitionReadings) -> None:
        link = self.link
        result, detail = "Refused", 0
        if order.command in ("Start", "Stop"):
            refused = order.command == "Start" and link.stranger
            if not refused and link.modes.take(_EVENTS[order.command]):
                result = "Done"
                if order.command == "Stop":
                    self._rest()
        elif order.command == "ClearFault":
            result = "Done"
        elif order.command == "SelfTest":
            self.proof = proof_of(readings, self.settings)
            detail = self.proof.missing
            result = "Failed" if detail else "Done"
        elif order.command == "Restart":
            result = "Done"
        link.acknowledge(order, result, detail)
        if order.command == "Restart":
            link.restart()
            self.settings = link.settings_with(self.settings)
            self._begin()

    def _hear_ctd(self, samples: Sequence[tuple[float, float, float]]) -> None:
        for sample in samples:
            if all(low <= value <= high for value, (low, high) in zip(sample, CTD_LIMITS, strict=True)):
                self._ctd_heard = self.link.now
                pressure, temperature, conductivity = sample
                self.link.say("CtdSample", pressure=pressure, temperature=temperature, conductivity=conductivity)

    def _report(self, readings: AcquisitionReadings) -> None:
        s, report = self.settings, self.link.report
        wet = bool(readings.leak_fore) + 2 * bool(readings.leak_aft)
        report("Leak", active=wet > 0, detail=wet)
        report("VacuumLoss", active=s.vacuum_high < readings.internal_pressure <= HULL_PRESSURES[1])
        report("Brownout", active=VOLTAGES[0] <= readings.voltage < s.voltage_low)
        deaf = (
            NO_DEPTH * (not _within(readings.depth, DEPTHS))
            + NO_ALTIMETER * (not _altimeter_answers(readings.altitude))
            + NO_HULL_PRESSURE * (not _within(readings.internal_pressure, HULL_PRESSURES))
            + NO_LEAK_LOOP * (not readings.leak_loop)
            + NO_BATTERY * (not (_within(readings.voltage, VOLTAGES) and _within(readings.current, CURRENTS)))
        )
        report("SensorRange", active=deaf > 0, detail=deaf)
        waited = self.link.now - self._ctd_heard
        silent = self._ctd is not None and self._sampling and waited > s.ctd_patience + 2.0 * self._interval
        report("CtdSilent", active=silent)

    def _tell(self, readings: AcquisitionReadings) -> None:
        say, proof = self.link.say, self.proof
        depth_measured = _within(readings.depth, DEPTHS)
        heard = _within(readings.altitude, ALTITUDES)
        say(
            "Depth", depth=readings.depth if depth_measured else 0.0, altitude=readings.altitude if heard else 0.0,
            pressure_proven=proof.pressure, pressure_measured=depth_measured,
            altimeter_answers=_altimeter_answers(readings.altitude), bottom_heard=heard,
        )  # fmt: skip
        self._hull_temperature = _last(readings.hull_temperature, self._hull_temperature)
        hull_measured = _within(readings.internal_pressure, HULL_PRESSURES)
        say(
            "Hull", internal_pressure=readings.internal_pressure if hull_measured else 0.0,
            temperature=self._hull_temperature, leak_fore=bool(readings.leak_fore), leak_aft=bool(readings.leak_aft),
            leak_proven=proof.leak, vacuum_proven=proof.vacuum, pressure_measured=hull_measured,
            leak_measured=bool(readings.leak_loop),
        )  # fmt: skip
        self._battery_temperature = _last(readings.battery_temperature, self._battery_temperature)
        voltage, current = self._voltage.take(), self._current.take()
        measured = isfinite(voltage) and isfinite(current)
        say(
            "Battery", voltage=voltage if measured else 0.0, current=current if measured else 0.0,
            temperature=self._battery_temperature, voltage_proven=proof.voltage, battery_measured=measured,
        )  # fmt: skip


class _Mean:
    """Mean of the readings since it was last taken; error values left out."""

    def __init__(self, limits: tuple[float, float]) -> None:
        self._limits = limits
        self._sum, self._count = 0.0, 0

    def add(self, reading: float) -> None:
        if _within(reading, self._limits):
            self._sum += reading
            self._count += 1

    def take(self) -> float:
        """Return it, not a number if there was no reading, and begin anew."""
        mean = self._sum / self._count if self._count else nan
        self._sum, self._count = 0.0, 0
        return mean


def _within(value: float, limits: tuple[float, float]) -> bool:
    return limits[0] <= value <= limits[1]


def _altimeter_answers(altitude: float) -> bool:
    """Infinite is an answer: no bottom within reach."""
    return altitude >= 0.0


def _last(temperature: float, before: float) -> float:
    return temperature if _within(temperature, TEMPERATURES) else before
