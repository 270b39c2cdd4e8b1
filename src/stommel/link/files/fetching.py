"""Fetches what is missing of a transfer: names ranges, takes segments, never asks for a byte that is on its way."""

from collections.abc import Iterable
from typing import NamedTuple, Protocol

from stommel.link.files.loss import MOST_SEGMENT, LossBySize
from stommel.link.files.pace import Pace
from stommel.link.files.ranges import Range
from stommel.link.files.recovery import MOST_REQUESTS, Recovery
from stommel.link.files.request_words import LONGEST, MOST_RANGES, PROBE, packed_ranges
from stommel.link.outbox import Outbox, Priority
from stommel.link.service import Received
from stommel.link.timing import FIRST, RetransmissionTimer
from stommel.link.traffic import Traffic
from stommel.link.values import octets, whole

STILL_HERE = 4.0
"""Something is said at least so often while segments come [s]: who hears nothing stops sending."""
MOST_WAIT = 15.0
"""Longest time between two requests into silence [s]."""
_MOST_COPIES = 4
_UNDOUBLED = 3
"""Waits before they become longer: a radio that loses many frames is not a crowded one."""
_LOSSY, _HEAVY = 0.02, 0.5
_ROOM = 255


class Keeper(Protocol):
    """Where received bytes go."""

    def write(self, offset: int, data: bytes, t: float) -> None:
        """Keep received bytes."""


class FetchCounts(NamedTuple):
    """What a fetch has seen."""

    received: int = 0
    """Bytes that were new."""
    duplicate: int = 0
    """Bytes that were there already."""
    frames: int = 0
    requests: int = 0
    time_outs: int = 0


class Fetch:
    """The recovery of one transfer.

    Parameters
    ----------
    peer
        System and component of whoever has the file.
    transfer
        Number of the transfer.
    missing
        What to fetch.
    keeper
        Where it goes.
    timer
        What is known of the round trip already.
    before
        The fetch of the same transfer that this one takes the place of: what it counted goes on.
    traffic
        Counts of this end; None: nobody asks.
    """

    def __init__(
        self,
        peer: tuple[int, int],
        transfer: int,
        missing: Iterable[tuple[int, int]],
        keeper: Keeper,
        timer: RetransmissionTimer | None = None,
        before: "Fetch | None" = None,
        traffic: Traffic | None = None,
    ) -> None:
        self.peer, self.transfer, self._keeper = peer, transfer, keeper
        self._traffic = Traffic() if traffic is None else traffic
        self.recovery = Recovery(missing)
        self.loss: LossBySize = LossBySize() if before is None else before.loss
        self.loss.forget_number()
        self.timer = RetransmissionTimer() if timer is None else timer
        self.counts: FetchCounts = FetchCounts() if before is None else before.counts
        self._budget = 8 * MOST_SEGMENT + self.recovery.missing.bytes // 250
        """Bytes that may be asked for more than once at a time, to save round trips at the end."""
        self._sent_at: dict[int, float] = {}
        self._probing: dict[int, bool] = {}
        self._serial: int = transfer * 151 % 256 if before is None else before._serial
        """Begins elsewhere in each transfer, for the other end does not obey a number twice."""
        self._epoch: int | None = None if before is None else before._epoch
        """Is another one whenever what was asked for before shall be forgotten."""
        self._is_begun = False
        self._last_said = self._last_asked = self._awake = float("-inf")
        self._waits = 0
        self.pace: Pace = Pace() if before is None else before.pace

    @property
    def is_whole(self) -> bool:
        """Whether nothing is missing."""
        return not self.recovery.missing

    def begin_again(self) -> None:
        """Forget what was asked for: this end was away."""
        self.recovery.give_up()
        self.loss.forget_number()
        self._sent_at.clear()
        self._forget()
        self._last_asked = self._last_said = float("-inf")
        self._waits = 0

    def _forget(self) -> None:
        """Let the other end forget what was asked for, as soon as it hears the next request."""
        if self._epoch is not None:
            self._epoch = (self._epoch + 1) % 256

    def wake(self, t: float) -> None:
        """Something came from the other end at a time [s]: if that ends a silence, ask now."""
        if self._waits and t - self._awake > self.timer.time_out:
            self._waits = 0
            self._last_asked = float("-inf")
        self._awake = t

    def take(self, received: Received, t: float) -> None:
        """Take FILE_DATA of this transfer at a time [s]."""
        values = received.values
        offset, length, serial, echo = (whole(values, name) for name in ("offset", "length", "serial", "echo"))
        data = octets(values, "data")[:length]
        if not 0 < length <= MOST_SEGMENT or len(data) != length:
            return
        self._measure(echo, t)
        self.loss.note(whole(values, "number"), probing=self._probing.get(echo, False))
        for first, last in self.recovery.missing.within(offset, offset + length):
            self._keeper.write(first, data[first - offset : last - offset], t)
        new = self.recovery.take(serial, offset, length, t)
        counts = self.counts
        self.counts = counts._replace(
            received=counts.received + new, duplicate=counts.duplicate + length - new, frames=counts.frames + 1
        )
        self._traffic.received(new, t)
        self.pace.note(new, t)
        self._waits = 0

    def _measure(self, echo: int, t: float) -> None:
        """The first segment that was sent after a request was heard measures the round trip."""
        sent = self._sent_at.pop(echo, None)
        if sent is None:
            return
        self.timer.measure(t - sent)
        for serial in [each for each in self._sent_at if (echo - each) % 256 < 128]:
            del self._sent_at[serial]

    def stop(self, t: float, outbox: Outbox) -> None:
        """Tell the other end to send nothing more."""
        self._forget()
        self._say(t, outbox, self._next_serial(), [])

    # what to say

    def poll(self, t: float, outbox: Outbox) -> None:
        """Say what is due at a time [s]."""
        if self.is_whole:
            return
        self.recovery.settle(t)
        if self._is_overdue(t):
            self.recovery.give_up()
            self.counts = self.counts._replace(time_outs=self.counts.time_outs + 1)
            self._waits += 1
            self._forget()
        if self._is_due(t) and outbox.room(Priority.COMMAND) >= _ROOM:
            self._ask(t, outbox)
        elif self._is_begun and t - self._last_said >= STILL_HERE and outbox.room(Priority.COMMAND) >= _ROOM:
            self._say(t, outbox, self._next_serial(), [])

    @property
    def _time_out(self) -> float:
        """How long an answer may take: there and back, and the time of the segments that are being sent."""
        least = FIRST if self.timer.round_trip is None else 0.0
        usual = max(self.timer.time_out, least) + 2.0 * self.pace.frame_time(self.loss.share)
        return min(usual * 2.0 ** min(max(self._waits - _UNDOUBLED, 0), 8), MOST_WAIT)

    def _is_overdue(self, t: float) -> bool:
        """Whether what was asked for should have come, or so many frames in a row should have that not all are lost."""
        if not self.recovery.is_expecting:
            return False
        silence = self.pace.silence(self.loss.share, self.recovery.asked_bytes / self.loss.segment)
        return t >= max(self._last_asked + self._time_out, self.pace.heard + silence)

    def _is_due(self, t: float) -> bool:
        """Whether to ask now: the other end is about to run dry, or there is enough to fill a request."""
        recovery = self.recovery
        if not len(recovery.to_ask) or recovery.requests >= MOST_REQUESTS:
            return False
        if not recovery.is_expecting:
            return True
        if len(recovery.to_ask) >= self._most_ranges:
            return True
        spacing = max(self.timer.round_trip or self.timer.time_out, 0.1) / 4.0
        return self._is_running_dry and t - self._last_asked >= spacing

    @property
    def _most_ranges(self) -> int:
        """Ranges of a request: it shall be no longer than a segment, where long frames do not come through."""
        if self.loss.segment < MOST_SEGMENT or self.loss.share > _HEAVY:
            return min(MOST_RANGES, self.loss.segment // 6)
        return MOST_RANGES

    @property
    def _is_running_dry(self) -> bool:
        """Whether all that was asked for comes before the answer to a request would."""
        return self.recovery.asked_bytes < 2.5 * self.timer.time_out * self._line_rate

    @property
    def _line_rate(self) -> float:
        """Bytes a second that the other end sends."""
        return self.loss.segment / self.pace.frame_time(self.loss.share)

    def _ask(self, t: float, outbox: Outbox) -> None:
        serial = self._next_serial()
        ranges = self.recovery.ask(serial, self._most_ranges, LONGEST, LONGEST)
        dry = self._is_running_dry
        lossy = self.loss.share > _LOSSY
        repeats = (3 if self.loss.share > 0.25 else 2) if (dry and lossy) or self._waits or not self._is_begun else 1
        for _ in range(repeats):
            self._say(t, outbox, serial, ranges)
        for _ in range(self._copies(ranges) - 1 if dry and lossy else 0):
            self._budget -= sum(each.size for each in ranges)
            serial = self._next_serial()
            self.recovery.ask_again(serial, ranges)
            self._say(t, outbox, serial, ranges)
        self._is_begun = True
        self._last_asked = t

    def _copies(self, ranges: list[Range]) -> int:
        """How often to ask for the same at once: as the line would else be idle, and within a budget."""
        size = sum(each.size for each in ranges)
        if self.recovery.missing.bytes <= 2 * MOST_SEGMENT:
            return 2
        if self.recovery.missing.bytes > self._budget:
            return 1
        idle = (self.timer.round_trip or 0.0) * self._line_rate - self.recovery.asked_bytes
        return 1 + max(0, min(_MOST_COPIES - 1, self._budget // (2 * size), int(idle / size)))

    def _next_serial(self) -> int:
        self._serial = (self._serial + 1) % 256
        return self._serial

    def _say(self, t: float, outbox: Outbox, serial: int, ranges: list[Range]) -> None:
        base, packed = packed_ranges(ranges)
        if self._epoch is None:  # after a restart it is hardly the same
            self._epoch = int(t * 997.0) % 256
        segment = self.loss.choose()
        flags = PROBE if self.loss.is_probing else 0
        system, component = self.peer
        outbox.put(
            Priority.COMMAND,
            "FILE_REQUEST",
            {
                "target_system": system, "target_component": component, "transfer": self.transfer, "base": base,
                "serial": serial, "segment": segment, "epoch": self._epoch, "flags": flags,
                "count": len(ranges), "ranges": packed,
            },
        )  # fmt: skip
        self.counts = self.counts._replace(requests=self.counts.requests + 1)
        self._last_said = t
        self._sent_at.setdefault(serial, t)
        self._probing.pop(serial, None)
        self._probing[serial] = self.loss.is_probing
        for known in (self._sent_at, self._probing):
            while len(known) > MOST_REQUESTS:
                del known[next(iter(known))]
