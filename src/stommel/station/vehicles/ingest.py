"""From what came over the radio, and went, to rows of the archive."""

import math
from collections.abc import Sequence

from stommel.archive.rows import Batch, CtdRow, DiveRow, FrameRow
from stommel.link.frames import FrameSplitter, RawFrame
from stommel.link.service import Received
from stommel.link.session import SILENCE
from stommel.link.shore.heard import Heard
from stommel.link.statistics import LinkStatistics
from stommel.messages.mavlink import Fields
from stommel.station.channels import told_by
from stommel.station.clock import FIRST, LAST, VehicleClock
from stommel.station.periods import Periods

MOST_FRAMES = 50_000
"""That wait for an archive that does not take them; beyond, the line is not read."""
MOST_EARLY = 4 << 20
"""Bytes that wait for the clock of a simulated vehicle; if it is not told until then, ours stands for it."""
MOST_REFUSED = 10_000
"""Looks that wait for the vehicle's clock; beyond, the oldest are forgotten that brought nothing that was believed."""
LINK_EVERY = 10.0
"""Between two looks at the statistics of the link [s]."""
NEAR = 60.0
"""A time that a message tells is believed if it is so near to when it came [s]."""
UNSET_FOR = 900.0
"""A simulated vehicle that has not told its clock for so long gets ours [s by its time since boot]."""
TICK = 2e-6
"""Between two times that the archive, which has whole microseconds, keeps apart [s]."""

Early = tuple[bytes, Sequence[Received], float]


class Ingest:
    """Gathers rows until they are stored.

    Parameters
    ----------
    vehicle
        Its system on the link.
    clock
        Of the vehicle; is set here by its SYSTEM_TIME.
    heard
        Puts sentences together; they are taken from there.
    """

    def __init__(self, vehicle: int, clock: VehicleClock, heard: Heard) -> None:
        self._vehicle, self._clock, self._heard = vehicle, clock, heard
        self._in, self._out = FrameSplitter(), FrameSplitter()
        self._last_in = -math.inf
        self._boot_utc: float | None = None
        """UTC of the vehicle at its time 0 since boot."""
        self._last_time: dict[str, float] = {}
        self.periods = Periods()
        self._early: list[Early] = []
        self._early_bytes = 0
        self._is_early = False
        self._first_boot = math.inf
        """Its time since boot when it was heard first, while its clock was not set [s]."""
        self._link_at = -math.inf
        self._has_come = False
        self.frames: list[FrameRow] = []
        self.samples: list[tuple[str, float, float]] = []
        self.texts: list[tuple[float, int, str]] = []
        self.dives: list[DiveRow] = []
        self.ctd: list[CtdRow] = []
        self.heard_at: float | None = None
        """When the vehicle was heard last, by its clock [s since 1970]."""
        self.came = 0
        """Messages that were accepted since the start."""

    # what came and went; times of the link [s]

    def hear(self, data: bytes, accepted: Sequence[Received], t: float) -> None:
        """Take bytes that came, and the messages that were accepted out of them."""
        clock = self._clock
        for received in accepted:
            if received.system == self._vehicle and received.name == "SYSTEM_TIME":
                self._hear_time(received.values, t)
        if not clock.is_set:
            if data:
                self._early.append((data, accepted, t))
                self._early_bytes += len(data)
                self._is_early |= bool(accepted)
                self._forget_refused()
            if self._early_bytes >= MOST_EARLY or self._is_long_unset(accepted):
                clock.hear(min(max(t, FIRST), LAST), t)  # without a fix it may never know
            if not clock.is_set:
                return
        for early in self._early:
            self._take(*early)
        if not self._early or self._early[-1][1] is not accepted:
            self._take(data, accepted, t)
        self._early, self._early_bytes, self._is_early = [], 0, False

    def _forget_refused(self) -> None:
        """Keep no more than so much of what was not believed: the line is to be read until the vehicle is heard."""
        while len(self._early) > MOST_REFUSED or self._early_bytes >= MOST_EARLY:
            place = next((k for k, (_, accepted, _) in enumerate(self._early) if not accepted), None)
            if place is None:
                return
            self._early_bytes -= len(self._early.pop(place)[0])

    def _is_long_unset(self, accepted: Sequence[Received]) -> bool:
        """Whether the vehicle was heard for long by its own time, of which a slow simulation has less than we."""
        told = [boot for received in accepted if (boot := _since_boot(received)) > 0.0]
        self._first_boot = min([self._first_boot, *told])
        return any(boot - self._first_boot > UNSET_FOR for boot in told)

    def say(self, data: bytes, t: float) -> None:
        """Take bytes that went."""
        if data and self._clock.is_set:
            at = self._clock.of_link(t)
            self.frames += [_row(frame, "out", at) for frame in self._out.take(data)]

    def look_at_link(self, link: LinkStatistics, t: float) -> None:
        """Take how the link is, every so often."""
        if t - self._link_at < LINK_EVERY or not self._clock.is_set:
            return
        self._link_at, at = t, self._clock.of_link(t)
        told = (
            ("link_loss_share", link.loss), ("link_round_trip_s", link.round_trip_time),
            ("link_goodput_b_s", link.goodput), ("link_waiting_b", float(link.bytes_waiting)),
        )  # fmt: skip
        self.samples += [(key, at, value) for key, value in told if math.isfinite(value)]

    # what waits to be stored

    @property
    def is_full(self) -> bool:
        """Whether no more can be kept."""
        return len(self.frames) >= MOST_FRAMES

    @property
    def has_news(self) -> bool:
        """Whether something came that is not stored."""
        return self._has_come or bool(self.samples)

    @property
    def is_early(self) -> bool:
        """Whether something that was believed waits for the vehicle's clock."""
        return self._is_early

    def batch(self) -> Batch:
        """All that waits."""
        return Batch(self.frames, self.samples, self.texts, self.dives, self.ctd)

    def stored(self) -> None:
        """It is on the disk."""
        self.frames, self.samples, self.texts, self.dives, self.ctd = [], [], [], [], []
        self._has_come = False

    # one by one

    def _take(self, data: bytes, accepted: Sequence[Received], t: float) -> None:
        at = self._clock.of_link(t)
        if not data and self._in.pending and t - self._last_in > SILENCE:
            self.frames += [_row(frame, "in", at) for frame in self._in.forget()]
        if data:
            self._last_in, self._has_come = t, True
            self.frames += [_row(frame, "in", at) for frame in self._in.take(data)]
        for received in accepted:
            if received.system == self._vehicle:
                self._take_message(received, at)
        while self._heard.texts:
            text = self._heard.texts.popleft()
            self.texts.append((self._clock.of_link(text.t), text.severity, text.words))

    def _take_message(self, received: Received, at: float) -> None:
        self.came += 1
        self.heard_at = at
        name, values = received.name, received.values
        self.periods.take(name, at)
        if name == "CTD_SAMPLE":
            self._take_ctd(values, at)
        elif name == "DIVE_SUMMARY":
            dive = _dive(values)
            if FIRST <= dive.t_begin <= LAST and FIRST <= (dive.t_end or FIRST) <= LAST:
                self.dives.append(dive)
        told = told_by(received)
        if told:
            t = self._time_of(name, values, at)
            self.samples += [(key, t, value) for key, value in told]

    def _take_ctd(self, values: Fields, at: float) -> None:
        t = self._time_of("CTD_SAMPLE", values, at)
        pressure, temperature, conductivity = (
            _finite(values[name]) for name in ("pressure", "temperature", "conductivity")
        )
        self.ctd.append(CtdRow(t, int(_number(values, "dive")), pressure, temperature, conductivity))

    def _hear_time(self, values: Fields, t: float) -> None:
        utc = 1e-6 * _number(values, "time_unix_usec")
        if not FIRST <= utc <= LAST:
            return
        if self._clock.hear(utc, t):
            self._boot_utc = None
        self._boot_utc = utc - 1e-3 * _number(values, "time_boot_ms")

    def _time_of(self, name: str, values: Fields, at: float) -> float:
        """When a message was true: by its own time where it tells one, else a moment after the one before it."""
        if "time_unix_ms" in values:
            told = 1e-3 * _number(values, "time_unix_ms")
            if FIRST <= told <= at + NEAR:
                return told
        if "time_boot_ms" in values and self._boot_utc is not None:
            told = self._boot_utc + 1e-3 * _number(values, "time_boot_ms")
            if abs(told - at) <= NEAR * self._clock.speed:
                return told
        t = max(at, self._last_time.get(name, -math.inf) + TICK)
        if t - at > NEAR:  # the clock was set back
            t = at
        self._last_time[name] = t
        return t


def _since_boot(received: Received) -> float:
    """Time of the vehicle since its boot that a message tells [s]; 0 if it tells none."""
    told = received.values.get("time_boot_ms", 0)
    return 1e-3 * told if isinstance(told, int) else 0.0


def _row(frame: RawFrame, direction: str, t: float) -> FrameRow:
    return FrameRow(
        t, direction, frame.system, frame.component, frame.message.id, frame.sequence, frame.is_signed, frame.raw
    )


def _dive(values: Fields) -> DiveRow:
    def degrees(name: str) -> float:
        return 1e-7 * _number(values, name)

    return DiveRow(
        dive=int(_number(values, "dive")),
        t_begin=1e-3 * _number(values, "time_begin_unix_ms"),
        t_end=1e-3 * _number(values, "time_end_unix_ms"),
        latitude_begin=degrees("latitude_begin"), longitude_begin=degrees("longitude_begin"),
        latitude_end=degrees("latitude_end"), longitude_end=degrees("longitude_end"),
        greatest_depth_m=_finite(values["greatest_depth"]),
        current_north_m_s=_finite(values["current_north"]), current_east_m_s=_finite(values["current_east"]),
        energy_j=_finite(values["energy"]),
    )  # fmt: skip


def _number(values: Fields, name: str) -> float:
    found = values[name]
    assert isinstance(found, int | float)
    return float(found)


def _finite(value: object) -> float | None:
    return float(value) if isinstance(value, int | float) and math.isfinite(value) else None
