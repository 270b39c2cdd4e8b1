"""Driver of the compass: bytes in, readings out."""

import struct
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum

from stommel.instruments.framing import Framer
from stommel.instruments.health import Health
from stommel.instruments.settings import refuse, require_positive
from stommel.instruments.tcm.calibration import KNOWN, MANUALS, Calibration, ModuleInfo, module_info, score
from stommel.instruments.tcm.components import CONFIG_CODES, MEASURED, Config, config_payload, order_mark
from stommel.instruments.tcm.frames import Datagram, Id, encoded, look
from stommel.instruments.tcm.reading import CompassReading, reading

FIR_TAPS = (0, 4, 8, 16, 32)
"""Numbers of taps that the filter of the field may have."""
_FIR = bytes((3, 1))
_EPSILON = 1e-6
"""Slack of a time that is a sum of intervals [s]."""


class CompassState(StrEnum):
    """How the compass does."""

    STARTING = "starting"
    """It is asked who it is, or configured."""
    SAMPLING = "sampling"
    SILENT = "silent"
    """No byte comes."""
    GARBLED = "garbled"
    """Bytes come, but no frame: another baud rate, noise."""
    UNKNOWN_REVISION = "unknown revision"
    """Its firmware is none whose bytes are known."""
    NO_READING = "no reading"
    """Frames come, but none is a reading."""


@dataclass(frozen=True)
class CompassSettings:
    """How the compass is to measure."""

    interval: float = 1.0
    """Between two readings [s]."""
    polled: bool = True
    """Whether each reading is asked for; otherwise the compass sends them by itself."""
    big_endian: bool = True
    """Order of the bytes of its values (config 6)."""
    config: Mapping[int, float] = field(default_factory=dict)
    """Further configuration values by number."""
    taps: tuple[float, ...] = ()
    """Of the filter of its field; empty leaves the instrument's own."""
    revisions: Mapping[str, str] = field(default_factory=lambda: KNOWN)
    """Number of the manual that holds, by type and revision of the firmware."""
    answer_time: float = 2.5
    """That an answer may take [s]; more than two steps of the software that calls the driver."""
    silence: float = 5.0
    """Without a reading before it begins anew [s]."""
    gap: float = 0.1
    """Longest between two bytes of a frame [s]."""

    def __post_init__(self) -> None:
        for number in self.config:
            if number not in CONFIG_CODES or number == Config.BIG_ENDIAN:
                raise refuse("compass.config", number, sorted(set(CONFIG_CODES) - {Config.BIG_ENDIAN}))
        for manual in self.revisions.values():
            if manual not in MANUALS:
                raise refuse("compass.revisions", manual, MANUALS)
        if len(self.taps) not in FIR_TAPS:
            raise refuse("number of compass.taps", len(self.taps), FIR_TAPS)
        for name in ("interval", "answer_time", "silence", "gap"):
            require_positive(f"compass.{name}", getattr(self, name))


class CompassDriver:
    """Asks the compass who it is, configures it, samples it; begins anew after silence or its restart."""

    def __init__(self, settings: CompassSettings | None = None) -> None:
        self._set = settings or CompassSettings()
        self._framer: Framer[Datagram] = Framer(look, self._set.gap)
        self._steps: Iterator[tuple[bytes, int | None]] = iter(())
        self._queue = b""
        self._state = CompassState.STARTING
        self._reason = "not asked yet"
        self._request = b""
        self._awaited: int | None = None
        self._asked = self._next = self._heard = self._framed = self._last = float("-inf")
        self._began = float("nan")
        self._unanswered = float("inf")
        self._good = self._refused = 0
        self.info: ModuleInfo | None = None
        """What it calls itself."""
        self.calibration = Calibration()

    @property
    def interval(self) -> float:
        """Between two readings [s]."""
        return self._set.interval

    def poll(self, t: float, *, asked: bool = True) -> bytes:
        """Bytes to send now; a compass whose readings are asked for may rest meanwhile."""
        out, self._queue = self._queue, b""
        if self._began != self._began:
            self._begin(t, "")
        sampling = self._state is CompassState.SAMPLING
        if sampling and t - self._awaited_since(t) > self._set.silence:
            self._begin(t, ": ".join(filter(None, (f"no reading for {self._set.silence:g} s", self._reason))))
        elif sampling:
            return out + (self._demand(t) if asked else b"")
        if t - self._asked > self._set.answer_time:
            if self._awaited != Id.MOD_INFO_RESP:
                self._begin(t, f"frame {self._awaited} did not come")
            self._asked = t
            return out + self._request
        if self._request and self._asked == float("-inf"):
            self._asked = t
        return out

    def take(self, data: bytes, t: float) -> list[CompassReading]:
        """Readings that are complete with these bytes."""
        if data:
            self._heard = t
        readings = []
        for frame, at in self._framer.take(data, t):
            self._good += 1
            self._framed = at
            if frame.identifier == Id.DATA_RESP:
                got = self._data(frame.payload, at)
                if got:
                    readings.append(got)
            else:
                self._other(frame, t)
        return readings

    def health(self, t: float) -> Health:
        """Return how the compass does."""
        state, reason = self._state_at(t)
        return Health("compass", state, self._last, self._good, self._framer.runs + self._refused, reason)

    def start_calibration(self, option: int = 10) -> None:
        """Begin a user calibration; the option is that of kStartCal in the manual of the firmware."""
        self.calibration = Calibration()
        self._send(Id.START_CAL, struct.pack(self._mark + "I", option))

    def take_calibration_point(self) -> None:
        """Take one sample of a user calibration."""
        self._send(Id.TAKE_USER_CAL_SAMPLE)

    def stop_calibration(self) -> None:
        """End a user calibration without a score."""
        self._send(Id.STOP_CAL)

    def forget_calibration(self) -> None:
        """Go back to the maker's calibration."""
        self._send(Id.FACTORY_USER_CAL)

    def use_coefficients(self, number: int) -> None:
        """Measure with another of the eight sets of coefficients, as for "motor on"."""
        self._send(Id.SET_CONFIG, config_payload(Config.COEFFICIENT_SET, number, self._set.big_endian))

    def save(self) -> None:
        """Keep configuration and calibration over a loss of power."""
        self._send(Id.SAVE)

    @property
    def _mark(self) -> str:
        return order_mark(self._set.big_endian)

    def _send(self, identifier: int, payload: bytes = b"") -> None:
        self._queue += encoded(identifier, payload)

    def _begin(self, t: float, reason: str) -> None:
        """Ask who it is; one that sends by itself is told to be quiet first."""
        self._state, self._reason = CompassState.STARTING, reason
        self._request = encoded(Id.STOP_INTERVAL_MODE) + encoded(Id.GET_MOD_INFO)
        self._awaited = Id.MOD_INFO_RESP
        self._unanswered = float("inf")
        self._asked = float("-inf")
        self._began = t

    def _demand(self, t: float) -> bytes:
        if not self._set.polled or t < self._next - _EPSILON:
            return b""
        self._unanswered = min(self._unanswered, t)
        self._next = t + self._set.interval if t - self._next > self._set.interval else self._next + self._set.interval
        return encoded(Id.GET_DATA)

    def _configuration(self) -> Iterator[tuple[bytes, int | None]]:
        """Frames that configure it, with the answer to each; the first sets how the values of the rest are written."""
        big = self._set.big_endian
        for number, value in {Config.BIG_ENDIAN: big, **self._set.config}.items():
            yield encoded(Id.SET_CONFIG, config_payload(number, value, big)), Id.SET_CONFIG_DONE
        if self._set.taps:
            taps = struct.pack(f"{self._mark}{len(self._set.taps)}d", *self._set.taps)
            yield encoded(Id.SET_PARAM, _FIR + bytes((len(self._set.taps),)) + taps), Id.SET_PARAM_DONE
        acquisition = struct.pack(self._mark + "??ff", self._set.polled, False, 0.0, self._set.interval)
        components = encoded(Id.SET_DATA_COMPONENTS, bytes((len(MEASURED), *MEASURED)))  # has no answer
        yield components + encoded(Id.SET_ACQ_PARAMS, acquisition), Id.ACQ_PARAMS_DONE
        if not self._set.polled:
            yield encoded(Id.START_INTERVAL_MODE), None

    def _advance(self, t: float) -> None:
        """Send the next frame of the configuration; after the last one it samples."""
        for request, answer in self._steps:
            self._queue += request
            self._request, self._awaited, self._asked = request, answer, t
            if answer is not None:
                return
        self._state, self._reason, self._began, self._next = CompassState.SAMPLING, "", t, float("-inf")
        self._awaited, self._request = None, b""

    def _data(self, payload: bytes, t: float) -> CompassReading | None:
        if self._state is not CompassState.SAMPLING:
            return None  # of a compass that still sends by itself, in whatever order of bytes
        got = reading(payload, self._set.big_endian, t)
        if isinstance(got, CompassReading):
            self._last, self._reason, self._unanswered = t, "", float("inf")
            return got
        self._refused += 1
        self._reason = got
        if got.startswith("components"):
            self._begin(t, f"restarted: it sends {got}")
        return None

    def _other(self, frame: Datagram, t: float) -> None:
        identifier, payload = frame
        if identifier == Id.POWER_UP:
            self._begin(t, "restarted")
        elif identifier == Id.MOD_INFO_RESP:
            self._know(payload, t)
        elif identifier == Id.USER_CAL_SAMP_COUNT:
            self.calibration = replace(self.calibration, points=struct.unpack(self._mark + "I", payload)[0])
        elif identifier == Id.USER_CAL_SCORE and self.info and self.info.name in self._set.revisions:
            manual = self._set.revisions[self.info.name]
            self.calibration = replace(self.calibration, score=score(payload, manual, self._set.big_endian))
        elif identifier == Id.SAVE_DONE:
            self.calibration = replace(self.calibration, saved=not any(payload))
        elif identifier == self._awaited:
            self._advance(t)

    def _know(self, payload: bytes, t: float) -> None:
        if self._awaited != Id.MOD_INFO_RESP:
            return
        self.info = module_info(payload)
        name = self.info.name if self.info else payload.hex(" ")
        if name in self._set.revisions:
            self._steps = self._configuration()
            self._state = CompassState.STARTING
            self._advance(t)
            return
        self._state = CompassState.UNKNOWN_REVISION
        known = ", ".join(self._set.revisions)
        self._reason = f"firmware {name} is none of revisions: {known}; name its manual there ({', '.join(MANUALS)})"

    def _awaited_since(self, t: float) -> float:
        """Since when something is awaited from it [s]; now, if nothing is."""
        if self._began != self._began:
            return t
        if self._set.polled and self._state is CompassState.SAMPLING:
            return min(max(self._last, self._unanswered - self._set.interval), t)
        return max(self._last, self._began)

    def _state_at(self, t: float) -> tuple[CompassState, str]:
        since = self._awaited_since(t)
        if self._state is CompassState.SAMPLING and t - since <= self._set.silence:
            return self._state, self._reason
        quiet = self._set.silence
        if t - self._heard > quiet and t - since <= quiet and self._heard == float("-inf"):
            return CompassState.STARTING, self._reason or "asked who it is"
        if t - self._heard > quiet:
            return CompassState.SILENT, f"no byte for more than {quiet:g} s"
        if t - self._framed > quiet:
            return CompassState.GARBLED, f"{self._framer.skipped} bytes make no frame: is the baud rate right?"
        if self._state is CompassState.SAMPLING:
            return CompassState.NO_READING, self._reason or "frames come, but no readings"
        return self._state, self._reason or "asked who it is"
