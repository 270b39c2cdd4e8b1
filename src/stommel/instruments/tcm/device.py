"""A simulated TCM that answers every frame with the instrument's own bytes."""

import math
import struct
from typing import NamedTuple

from stommel.instruments.framing import Framer
from stommel.instruments.tcm.components import (
    CONFIG_CODES,
    KINDS,
    Component,
    Config,
    config_payload,
    config_value,
    layout,
    order_mark,
)
from stommel.instruments.tcm.frames import MOST_COMPONENTS, Datagram, Id, encoded, look
from stommel.instruments.tcm.reading import Vector

_ALONE = (Component.HEADING, Component.PITCH, Component.ROLL)
"""What it measures until it is told."""
_DISTORTED = 80.0
"""Field on an axis beyond which a TCM5 says that it is distorted [uT]."""
_MOST_AT_ONCE = 16
"""Answers of the interval mode at one call."""


class CompassTruth(NamedTuple):
    """What the compass feels; angles in radians."""

    heading: float
    pitch: float
    roll: float
    acceleration: Vector = (0.0, 0.0, 1.0)
    """[g]"""
    magnetic_field: Vector = (30.0, 0.0, 40.0)
    """[uT]"""
    temperature: float = 15.0
    """[degC]"""


def _float32(value: float) -> float:
    """The number that its four bytes hold."""
    return float(struct.unpack("f", struct.pack("f", value))[0])


class CompassDevice:
    """The instrument: what it is told it keeps, until it restarts without having saved it."""

    def __init__(
        self,
        module: str = "TCM5",
        revision: str = "1208",
        score: tuple[float, ...] = (0.1, 95.0, 95.0, 60.0, 45.0, 0.2),
    ) -> None:
        self._name = f"{module:<4.4}{revision:<4.4}".encode("ascii")
        self._score = score
        self._kept: dict[int, float] = {Config.BIG_ENDIAN: 1, Config.MOUNTING: 1, Config.CALIBRATION_POINTS: 12}
        self._calibrated = True
        self._taps = bytes((3, 1, 0))
        self.restart()
        self._born = False

    def restart(self) -> None:
        """Lose power and come back: everything is forgotten that was not saved."""
        self._framer: Framer[Datagram] = Framer(look, 0.1)
        self._config = dict(self._kept)
        self._components: tuple[int, ...] = tuple(int(component) for component in _ALONE)
        self._acquisition = struct.pack(self._mark + "??ff", True, False, 0.0, 0.0)
        self._interval = math.inf
        self._next = math.inf
        self._points: int | None = None
        self._asleep = False
        self._born = True

    def take(self, data: bytes, truth: CompassTruth, t: float) -> bytes:
        """Bytes that it sends after these have come to it."""
        out = b""
        if self._born or (self._asleep and data):
            self._born = self._asleep = False
            out += encoded(Id.POWER_UP)
        for frame, _ in self._framer.take(data, t):
            out += self._answer(frame, truth, t)
        sent = 0
        while t >= self._next - 1e-6 and sent < _MOST_AT_ONCE:
            self._next += self._interval
            sent += 1
            out += self._data(truth)
        if t >= self._next:
            self._next = t + self._interval
        return out

    @property
    def _big_endian(self) -> bool:
        return bool(self._config[Config.BIG_ENDIAN])

    @property
    def _mark(self) -> str:
        return order_mark(self._big_endian)

    def _answer(self, frame: Datagram, truth: CompassTruth, t: float) -> bytes:
        identifier, payload = frame
        if identifier in (Id.GET_DATA, Id.SYNC_READ):
            return self._data(truth)
        if identifier == Id.GET_MOD_INFO:
            return encoded(Id.MOD_INFO_RESP, self._name)
        if identifier in (Id.SET_CONFIG, Id.GET_CONFIG):
            return self._configure(identifier, payload)
        if identifier in (Id.SET_PARAM, Id.GET_PARAM, Id.SET_ACQ_PARAMS, Id.GET_ACQ_PARAMS):
            return self._parameters(identifier, payload)
        if identifier in (Id.START_INTERVAL_MODE, Id.STOP_INTERVAL_MODE, Id.SET_DATA_COMPONENTS, Id.SET_MODE):
            return self._mode(identifier, payload, t)
        if identifier == Id.POWER_DOWN:
            self._asleep, self._next = True, math.inf
            return encoded(Id.POWER_DOWN_DONE)
        return self._calibrate(identifier)

    def _data(self, truth: CompassTruth) -> bytes:
        degrees = math.degrees
        heading = _float32(degrees(truth.heading) % 360.0)
        values = {
            Component.HEADING: 0.0 if heading >= 360.0 else heading,
            Component.PITCH: degrees(truth.pitch),
            Component.ROLL: degrees(math.remainder(truth.roll, 2.0 * math.pi)),
            Component.TEMPERATURE: truth.temperature,
            Component.DISTORTION: int(max(map(abs, truth.magnetic_field)) > _DISTORTED),
            Component.CAL_STATUS: int(self._calibrated),
            Component.HEADING_STATUS: 0,
        }
        a, m = truth.acceleration, truth.magnetic_field
        values |= {Component.ACCELERATION_X: a[0], Component.ACCELERATION_Y: a[1], Component.ACCELERATION_Z: a[2]}
        values |= {Component.FIELD_X: m[0], Component.FIELD_Y: m[1], Component.FIELD_Z: m[2]}
        said: list[float] = [len(self._components)]
        for component in self._components:
            said += (component, values[Component(component)])
        return encoded(Id.DATA_RESP, layout(self._components, self._big_endian).pack(*said))

    def _configure(self, identifier: int, payload: bytes) -> bytes:
        if identifier == Id.GET_CONFIG:
            number = payload[0]
            if number not in CONFIG_CODES:
                return b""
            return encoded(Id.CONFIG_RESP, config_payload(number, self._config.get(number, 0), self._big_endian))
        said = config_value(payload, self._big_endian)
        if said is None:
            return b""
        self._config[said[0]] = said[1]
        return encoded(Id.SET_CONFIG_DONE)

    def _parameters(self, identifier: int, payload: bytes) -> bytes:
        if identifier == Id.SET_PARAM:
            if len(payload) != 3 + 8 * payload[2]:
                return b""
            self._taps = payload
            return encoded(Id.SET_PARAM_DONE)
        if identifier == Id.GET_PARAM:
            return encoded(Id.PARAM_RESP, self._taps)
        if identifier == Id.GET_ACQ_PARAMS:
            return encoded(Id.ACQ_PARAMS_RESP, self._acquisition)
        self._acquisition = payload
        return encoded(Id.ACQ_PARAMS_DONE)

    def _mode(self, identifier: int, payload: bytes, t: float) -> bytes:
        if identifier == Id.SET_MODE:
            return encoded(Id.SET_MODE_RESP, payload)
        if identifier == Id.STOP_INTERVAL_MODE:
            self._next = math.inf
        elif identifier == Id.SET_DATA_COMPONENTS:
            wanted = tuple(payload[1:])
            if len(wanted) == payload[0] <= MOST_COMPONENTS and all(number in KINDS for number in wanted):
                self._components = wanted
        else:
            polled, _, _, interval = struct.unpack(self._mark + "??ff", self._acquisition)
            self._interval = max(interval, 0.05)
            self._next = math.inf if polled else t
        return b""

    def _calibrate(self, identifier: int) -> bytes:
        if identifier == Id.START_CAL:
            self._points = 0
            return encoded(Id.USER_CAL_SAMP_COUNT, struct.pack(self._mark + "I", 0))
        if identifier == Id.STOP_CAL:
            self._points = None
        elif identifier == Id.TAKE_USER_CAL_SAMPLE and self._points is not None:
            return self._calibration_point()
        elif identifier == Id.SAVE:
            self._kept = dict(self._config)
            return encoded(Id.SAVE_DONE, b"\0\0")
        elif identifier == Id.FACTORY_USER_CAL:
            self._calibrated = False
            return encoded(Id.FACTORY_USER_CAL_DONE)
        elif identifier == Id.FACTORY_INCL_CAL:
            return encoded(Id.FACTORY_INCL_CAL_DONE)
        return b""

    def _calibration_point(self) -> bytes:
        assert self._points is not None
        self._points += 1
        out = encoded(Id.USER_CAL_SAMP_COUNT, struct.pack(self._mark + "I", self._points))
        if self._points >= self._config.get(Config.CALIBRATION_POINTS, 12):
            self._points, self._calibrated = None, True
            out += encoded(Id.USER_CAL_SCORE, struct.pack(self._mark + "6f", *self._score))
        return out
