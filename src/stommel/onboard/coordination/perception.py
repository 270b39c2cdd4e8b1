"""What the coordination software knows of the vehicle: the last words of nodes and instruments, as readings."""

import math
from collections.abc import Iterable

from stommel.control.readings import Readings
from stommel.messages.codec import Decoder, Received, Values
from stommel.messages.database import ACQUISITION, MOTION
from stommel.messages.frames import Frame
from stommel.messages.nodes import NodeWatch

SILENT_AFTER = 3.5
"""Time without a message that comes each second, after which who should send it is silent [s]."""

WATCHED = (MOTION, ACQUISITION)
"""Nodes that the coordinator cannot do without."""

SENSORS = {"Depth": ("pressure_measured", "altimeter_answers"), "Battery": ("battery_measured",)}
"""Messages of the acquisition node, and the bits of each that say that a sensor has measured."""


class Attitude:
    """The last attitude by the compass."""

    def __init__(self) -> None:
        self.at = -math.inf
        """When it was measured [s]."""
        self.down_b2, self.down_b3 = 0.0, 1.0
        """Direction down along b2 and b3."""
        self.theta = self.psi = 0.0
        """Pitch, and heading from true north [rad]."""
        self.gravity = self.field = math.nan
        """Strength of the acceleration [g] and of the magnetic field [uT]."""


class Perception:
    """Collects what is heard until the next decision.

    Before a sensor has spoken, and when it is silent, `readings` holds its last value; `silent` tells.
    """

    def __init__(self, t: float) -> None:
        self.decoder = Decoder()
        self.watch = NodeWatch(WATCHED, t)
        self.attitude = Attitude()
        self.latest: dict[str, Values] = {}
        self.heard: dict[str, float] = {}
        self.measured: dict[str, tuple[int, float]] = {}
        """Of the sensors behind the acquisition node, by the signals of `SENSORS`: how often they have measured, and
        when last [s]."""
        self.began = t
        self.compass_patience = SILENT_AFTER
        """Time without a reading of the compass after which it is silent [s]."""
        self._fix: tuple[float, float, float] | None = None

    def take(self, frames: Iterable[Frame], t: float) -> list[Received]:
        """Take frames at a time [s]; return what is believed of them, in order."""
        believed = []
        for frame in frames:
            answer = self.decoder.take(frame)
            self.watch.take(answer, t)
            if isinstance(answer, Received) and self.watch.obeys(answer):
                self.latest[answer.name], self.heard[answer.name] = answer.values, t
                believed.append(answer)
                if answer.name in SENSORS:
                    self._note_sensors(answer, t)
        return believed

    def _note_sensors(self, answer: Received, t: float) -> None:
        for signal in SENSORS[answer.name]:
            if answer.values[signal]:
                self.measured[signal] = (self.measured.get(signal, (0, t))[0] + 1, t)

    def take_fix(self, t: float, latitude: float, longitude: float) -> None:
        """Take a position [rad] that held at a time [s]; the next readings tell it once."""
        self._fix = (t, latitude, longitude)

    def is_silent(self, message: str, t: float) -> bool:
        """Whether a message that comes each second has not come for too long."""
        return t - self.heard.get(message, self.began) > SILENT_AFTER

    def says(self, message: str, signal: str) -> bool:
        """Whether a bit of the last message is set; not before the first."""
        return bool(self.latest.get(message, {}).get(signal, 0))

    def value(self, message: str, signal: str, before: float = 0.0) -> float:
        """A value of the last message; another one before the first."""
        return self.latest.get(message, {}).get(signal, before)

    def readings(self) -> Readings:
        """What control decides by; a fix is told once."""
        depth, motion = self.latest.get("Depth", {}), self.latest.get("MotionStatus", {})
        hull, battery = self.latest.get("Hull", {}), self.latest.get("Battery", {})
        attitude, fix = self.attitude, self._fix
        self._fix = None
        fix_t, latitude, longitude = fix or (0.0, 0.0, 0.0)
        return Readings(
            down_b2=attitude.down_b2,
            down_b3=attitude.down_b3,
            theta=attitude.theta,
            psi=attitude.psi,
            depth=depth.get("depth", 0.0),
            altitude=depth["altitude"] if depth.get("bottom_heard") else math.inf,
            r_px=motion.get("moving_mass", 0.0),
            V_b=motion.get("ballast", 0.0),
            steering=motion.get("steering", 0.0),
            leak=bool(hull.get("leak_fore") or hull.get("leak_aft")),
            internal_pressure=hull.get("internal_pressure", 0.0),
            voltage=battery.get("voltage", 0.0),
            current=battery.get("current", 0.0),
            fixed=fix is not None,
            fix_time=fix_t,
            fix_latitude=latitude,
            fix_longitude=longitude,
        )
