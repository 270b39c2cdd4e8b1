"""What decoder, watch of the nodes and drivers know of each source that health tells of."""

import math
from collections.abc import Collection
from typing import NamedTuple

from stommel.messages.codec import Decoder
from stommel.messages.database import ACQUISITION, MOTION, NODES, database
from stommel.onboard.coordination.health import ALTIMETER, CTD, GPS, RADIO, SOURCES, Health, HealthMonitor, Told
from stommel.onboard.coordination.own_instruments import OwnInstruments
from stommel.onboard.coordination.perception import Perception
from stommel.onboard.coordination.situation import Situation

HEALTH_EVERY = 10.0
"""Between two looks at the health of a vehicle of which nothing falls silent [s]: counts are no news."""
EACH_SECOND = 1.0
"""Period of heartbeats and of what the nodes tell [s]."""
RADIO_PERIOD, RADIO_PERIODS = 60.0, 5
"""A shore that listens is heard each minute [s]; so many minutes without a word are silence."""
_FLAGS = slice(Situation._fields.index("motion_silent"), Situation._fields.index("battery_silent") + 1)


class Periods(NamedTuple):
    """Between two messages of the sources that are set up [s]."""

    compass: float
    gps: float
    ctd: float


def signs_of(now: Situation) -> tuple[object, ...]:
    """What of a situation changes the condition of a source at once: who is silent or refused, strangers, restarts."""
    return (now[_FLAGS], now.restarts)


def messages_of(node: int) -> tuple[tuple[str, int], ...]:
    """Names and identifiers of what a node sends."""
    return tuple((m.name, m.frame_id) for m in database().messages if m.senders[0] == NODES[node])


class Sources:
    """Collects it, and keeps the last look at everybody's health.

    Parameters
    ----------
    seen
        By the coordinator.
    own
        Instruments at its own ports.
    t
        Time at which it begins [s].
    has_altimeter
        Whether one is fitted.
    """

    def __init__(self, seen: Perception, own: OwnInstruments, t: float, *, has_altimeter: bool) -> None:
        self.monitor = HealthMonitor()
        for name in SOURCES:
            waits = name in (GPS, CTD, RADIO) or (name == ALTIMETER and not has_altimeter)
            self.monitor.switch(name, not waits, t)
        self._last: Health | None = None
        self._signs: tuple[object, ...] = ()
        self._seen, self._compass, self._gnss, self._radio = seen, own.compass, own.gnss, own.radio
        self._nodes = {node: messages_of(node) for node in (MOTION, ACQUISITION)}
        by_name = dict(self._nodes[ACQUISITION])
        self._depth, self._battery, self._ctd = (
            ((name, by_name[name]),) for name in ("Depth", "Battery", "CtdSample")
        )  # fmt: skip

    def look(self, now: Situation, periods: Periods, t: float) -> Health:
        """Say how everybody does at a time [s]: at once where one falls silent or has power, else now and then."""
        since, last = self.monitor.since, self._last
        signs = (signs_of(now), since(RADIO), since(CTD))
        if last is not None and signs == self._signs and 0.0 <= t - last.t < HEALTH_EVERY:
            return last
        self._signs = signs
        told = self.told(now, periods, since(RADIO), t)
        self._last = self.monitor.snapshot(t, told, self._seen.watch.strangers)
        return self._last

    def told(self, now: Situation, periods: Periods, radio_since: float, t: float) -> tuple[Told, ...]:
        """Return what is known at a time [s], in the order of `SOURCES`.

        Parameters
        ----------
        now
            Says who is silent.
        periods
            That hold now.
        radio_since
            When the radio was switched on [s].
        t
            Time of the vehicle.
        """
        seen = self._seen
        compass, gnss = self._compass.health(t), self._gnss.health(t)
        radio, radio_heard = self._radio.counts(), self._radio.heard_at
        depth, battery = _counts(seen.decoder, self._depth), _counts(seen.decoder, self._battery)
        ctd = _counts(seen.decoder, self._ctd)
        radio_silent = t - max(radio_heard, radio_since) > RADIO_PERIODS * RADIO_PERIOD
        return (
            self._node(MOTION, now.motion_silent, now.motion_refused),
            self._node(ACQUISITION, now.acquisition_silent, now.acquisition_refused),
            Told(periods.compass, seen.attitude.at, compass.good, 0, compass.bad, now.compass_silent),
            Told(periods.gps, gnss.last_reading, gnss.good, 0, gnss.bad, now.gps_silent),
            Told(periods.ctd, seen.heard.get("CtdSample", -math.inf), *ctd, now.ctd_silent),
            self._sensor("pressure_measured", depth, now.pressure_silent),
            self._sensor("altimeter_answers", depth, now.altimeter_silent),
            self._sensor("battery_measured", battery, now.battery_silent),
            Told(RADIO_PERIOD, radio_heard, radio.received, 0, radio.overflowed, radio_silent),
        )

    def _node(self, node: int, silent: bool, refused: bool) -> Told:
        seen = self._seen
        counts = _counts(seen.decoder, self._nodes[node])
        watch = seen.watch
        return Told(EACH_SECOND, watch.heard_at(node), *counts, silent, refused, watch.restarts_of(node))

    def _sensor(self, signal: str, frames: tuple[int, int, int], silent: bool) -> Told:
        """A sensor behind the acquisition node: what it measured, and what became of the node's frames."""
        _, lost, rejected = frames
        heard, heard_at = self._seen.measured.get(signal, (0, -math.inf))
        return Told(EACH_SECOND, heard_at, heard, lost, rejected, silent)


def _counts(decoder: Decoder, messages: Collection[tuple[str, int]]) -> tuple[int, int, int]:
    """Frames of messages that were good, that were lost, and that were rejected."""
    received, lost = decoder.received, decoder.lost
    good = missing = 0
    for name, _ in messages:
        good += received.get(name, 0)
        missing += lost.get(name, 0)
    rejected = 0
    if decoder.rejected:
        rejected = sum(decoder.rejected_of(identifier) for _, identifier in messages)
    return good, missing, rejected
