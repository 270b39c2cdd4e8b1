"""A radio channel between two ends: slow, late, half-duplex, washed over by waves, gone under water."""

from collections.abc import Callable
from dataclasses import dataclass
from heapq import heappop, heappush
from typing import NamedTuple

import numpy as np

from stommel.link.channel.fading import Fading
from stommel.link.channel.modem import Modem
from stommel.link.channel.settings import ChannelSettings

_MOST_UNREAD = 1 << 20
"""Bytes that an end may leave unread; older ones are lost then."""


@dataclass
class ChannelCounts:
    """What became of the bytes that one end sent."""

    packets: int = 0
    lost: int = 0
    """Packets that never arrived."""
    sent_bytes: int = 0
    arrived_bytes: int = 0
    refused_bytes: int = 0
    """Bytes that found no room in the modem."""
    flipped_bits: int = 0
    turns: int = 0
    """How often this end got to speak."""


class _Arrival(NamedTuple):
    time: float
    number: int
    data: bytes


class ChannelEnd:
    """One end: bytes in and out, as of any transport."""

    def __init__(self, channel: "Channel", settings: ChannelSettings) -> None:
        self._channel = channel
        self.modem = Modem(settings.buffer, settings.packet, whole_frames=settings.whole_frames)
        self.counts = ChannelCounts()
        self.under_way: list[_Arrival] = []
        """Packets to this end, a heap."""
        self.latest = 0.0
        """When the last packet to this end that kept its place arrives [s]."""
        self.unread = bytearray()

    def write(self, data: bytes, t: float) -> int:
        """Hand bytes to the modem at a time [s], and return how many found room."""
        self._channel.advance(t)
        taken = self.modem.put(data, t)
        self._channel.look_again()
        self.counts.refused_bytes += len(data) - taken
        return taken

    def read(self, t: float) -> bytes:
        """Return what has arrived until a time [s]."""
        self._channel.advance(t)
        data = bytes(self.unread)
        self.unread.clear()
        return data

    def room(self, t: float) -> int:
        """Bytes that the modem takes at a time [s]."""
        self._channel.advance(t)
        return self.modem.room

    def waiting(self, t: float) -> int:
        """Bytes that wait in the modem at a time [s]."""
        self._channel.advance(t)
        return self.modem.waiting


class Channel:
    """Two ends and the air between them, on a time that is given and never goes back.

    What arrives depends on the settings, the seed, and what was written when; not on how often anybody looks.

    Parameters
    ----------
    settings
        What the channel does to bytes.
    seed
        Of all chance.
    linked
        Whether anything passes at a time [s], beside the outages of the settings: the antenna is out of the water.
    """

    def __init__(self, settings: ChannelSettings, seed: int = 0, linked: Callable[[float], bool] | None = None) -> None:
        self.settings = settings
        self.least_loss = 0.0
        """Share of packets that is lost whatever the settings say: a worse day than they are for."""
        self.vehicle, self.shore = ChannelEnd(self, settings), ChannelEnd(self, settings)
        self._draw = np.random.default_rng((seed, 0))
        self._fading = Fading(settings.fade_every, settings.fade_length, np.random.default_rng((seed, 1)))
        self._linked = linked
        self._turn = self.vehicle
        self._turn_since = 0.0
        self._free = {id(end): 0.0 for end in (self.vehicle, self.shore)}
        self._number = 0
        self._next = float("inf")
        """Before this time nothing happens [s]."""

    def is_linked(self, t: float) -> bool:
        """Whether anything passes at a time [s]."""
        if any(begin <= t < end for begin, end in self.settings.outages):
            return False
        return self._linked is None or self._linked(t)

    def next_event(self) -> float:
        """When something arrives or begins to be sent next [s]; infinity if nothing is on its way."""
        arrivals = [end.under_way[0].time for end in (self.vehicle, self.shore) if end.under_way]
        begins = [begin for end in (self.vehicle, self.shore) if (begin := self._begin(end)) is not None]
        return min((*arrivals, *begins), default=float("inf"))

    def advance(self, t: float) -> None:
        """Let pass what passes until a time [s]."""
        if t < self._next:
            return
        while True:
            waiting = [(begin, end) for end in (self.vehicle, self.shore) if (begin := self._begin(end)) is not None]
            begin = min((begin for begin, _ in waiting), default=float("inf"))
            if begin > t:
                break
            self._send([end for at, end in waiting if at <= begin], begin)
        for end in (self.vehicle, self.shore):
            self._deliver(end, t)
        self._next = self.next_event()

    def look_again(self) -> None:
        """Look at both ends anew when time goes on: one of them has been given bytes."""
        self._next = float("-inf")

    def other(self, end: ChannelEnd) -> ChannelEnd:
        """Whom an end speaks to."""
        return self.shore if end is self.vehicle else self.vehicle

    def _begin(self, end: ChannelEnd) -> float | None:
        """When an end can begin to send; None if it has nothing to say."""
        ready = end.modem.ready()
        return None if ready is None else max(ready, self._free[id(end)])

    def _send(self, ready: list[ChannelEnd], t: float) -> None:
        """Send a packet of one of those who could at a time."""
        end, begin = ready[0], t
        if self.settings.half_duplex:
            end = self._whose_turn(ready, t)
            if end is not self._turn:
                begin = t + self.settings.turn_round
                self._turn, self._turn_since = end, begin
                end.counts.turns += 1
        packet = end.modem.cut()
        done = begin + len(packet) / self.settings.bytes_a_second
        for speaker in (self.vehicle, self.shore) if self.settings.half_duplex else (end,):
            self._free[id(speaker)] = done
        end.counts.packets += 1
        end.counts.sent_bytes += len(packet)
        if self._is_lost(t):
            end.counts.lost += 1
            return
        self._put_under_way(end, self._garbled(end, packet), done)

    def _whose_turn(self, ready: list[ChannelEnd], t: float) -> ChannelEnd:
        """One goes on until it has no more to say, or has gone on for long while the other one waits."""
        others = [end for end in ready if end is not self._turn]
        if not others:
            return self._turn
        goes_on = len(ready) > 1 and t - self._turn_since < self.settings.longest_turn
        return self._turn if goes_on else others[0]

    def _is_lost(self, t: float) -> bool:
        settings = self.settings
        share = settings.fade_loss if self._fading.at(t) else settings.loss
        return self._draw.random() < max(share, self.least_loss) or not self.is_linked(t)

    def _garbled(self, end: ChannelEnd, packet: bytes) -> bytes:
        if not self.settings.bit_error_rate:
            return packet
        bits = 8 * len(packet)
        flipped = int(self._draw.binomial(bits, self.settings.bit_error_rate))
        if not flipped:
            return packet
        end.counts.flipped_bits += flipped
        garbled = bytearray(packet)
        for bit in self._draw.choice(bits, flipped, replace=False):
            garbled[bit // 8] ^= 1 << (bit % 8)
        return bytes(garbled)

    def _put_under_way(self, end: ChannelEnd, packet: bytes, done: float) -> None:
        settings, far = self.settings, self.other(end)
        arrival = done + settings.latency
        if settings.jitter:
            arrival += settings.jitter * self._draw.random()
        arrival = max(arrival, far.latest)
        if settings.reordering and self._draw.random() < settings.reordering:
            self._push(far, arrival + settings.reordering_delay, packet)
        else:
            far.latest = arrival
            self._push(far, arrival, packet)
        if settings.duplication and self._draw.random() < settings.duplication:
            self._push(far, arrival + settings.reordering_delay, packet)

    def _push(self, far: ChannelEnd, arrival: float, packet: bytes) -> None:
        self._number += 1
        heappush(far.under_way, _Arrival(arrival, self._number, packet))

    def _deliver(self, far: ChannelEnd, t: float) -> None:
        near = self.other(far)
        while far.under_way and far.under_way[0].time <= t:
            arrival = heappop(far.under_way)
            if not self.is_linked(arrival.time):
                near.counts.lost += 1
                continue
            far.unread += arrival.data
            near.counts.arrived_bytes += len(arrival.data)
        if len(far.unread) > _MOST_UNREAD:
            del far.unread[: len(far.unread) - _MOST_UNREAD]
