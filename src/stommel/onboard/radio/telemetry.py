"""Says the telemetry that is due, and in words what has changed."""

import math
from collections import deque

from stommel.link.outbox import Outbox, Priority
from stommel.link.service import Received
from stommel.messages.mavlink import Fields, message_named
from stommel.onboard.coordination.failsafes import FAILSAFES, Reaction
from stommel.onboard.radio.observed import Observed
from stommel.onboard.radio.telemetry_table import TELEMETRY, TelemetryRow

SHORTEST, LONGEST = 0.1, 3600.0
"""Intervals that can be asked for [s]."""
_MOST_WORDS = 32
"""Sentences that wait."""
_TEXT = 50
"""Bytes of a STATUSTEXT."""
_EMERGENCY, WARNING, _NOTICE, _INFO = 0, 4, 5, 6
"""MAV_SEVERITY."""
_ROWS = {row.name: row for row in TELEMETRY}
_NUMBERS = {message_named(row.name).id: row for row in TELEMETRY}
_REACTIONS = {row.name: row.reaction for row in FAILSAFES}


SHARE = 0.2
"""Of the line that telemetry takes at most; on a slower line everything is told less often."""
_FRAME = 25
"""Bytes of a signed frame beside its payload."""


def needed_rate() -> float:
    """Bytes a second that the table of telemetry takes as it stands."""
    return sum((message_named(row.name).layout.size + _FRAME) / row.interval for row in TELEMETRY)


class Telemetry:
    """A service of the link that nobody has to ask.

    Parameters
    ----------
    line
        What the line carries [B/s].
    """

    def __init__(self, line: float = math.inf) -> None:
        self._seen: Observed | None = None
        stretch = max(1.0, needed_rate() / (SHARE * line))
        self._usual = {row.name: row.interval * stretch for row in TELEMETRY}
        self._intervals = dict(self._usual)
        self._due = dict.fromkeys(_ROWS, 0.0)
        self._next = 0.0
        """Before this time nothing is due [s]."""
        self._words: deque[tuple[int, str]] = deque(maxlen=_MOST_WORDS)
        self._state = ""
        self._text = 0

    def observe(self, seen: Observed) -> None:
        """Take what a decision saw; alarms and states that are new are told in words."""
        self._seen = seen
        safety, executive = seen.view.safety, seen.view.executive
        for name in safety.raised:
            worst = _REACTIONS.get(name, Reaction.REPORT)
            severity = _EMERGENCY if worst >= Reaction.ABORT else WARNING
            self._words.append((severity, f"alarm: {name}"))
        for name in safety.cleared:
            self._words.append((_NOTICE, f"alarm over: {name}"))
        if executive.words != self._state:
            self._state = executive.words
            self._words.append((_INFO, f"{executive.words}: {executive.because}"))

    def take(self, received: Received, t: float) -> None:
        """Hear nothing: it is asked through commands."""

    def poll(self, t: float, outbox: Outbox) -> None:
        """Say what is due, as far as there is room: what is not said now is said newer the next time."""
        self._tell(outbox)
        if self._seen is None or t < self._next:
            return
        for name, due in self._due.items():
            if t >= due and outbox.room(Priority.STATE) > 512:
                self._due[name] = t + self._intervals[name]  # first: what fails is left until then, and ends no other
                self._say(_ROWS[name], outbox)
        self._next = min(self._due.values())

    def request(self, number: int, t: float) -> bool:
        """Say a message once, soon; whether the vehicle has it."""
        row = _NUMBERS.get(number)
        if row is None or self._seen is None or row.fields(self._seen) is None:
            return False
        self._due[row.name] = self._next = t
        return True

    def set_interval(self, number: int, interval: float | None, t: float) -> bool:
        """Say a message every so often [s], within `SHORTEST` and `LONGEST`; 0: as usual, None: not at all."""
        row = _NUMBERS.get(number)
        if row is None:
            return False
        if interval is None:
            self._intervals[row.name] = self._due[row.name] = math.inf
            return True
        self._intervals[row.name] = min(max(interval, SHORTEST), LONGEST) if interval else self._usual[row.name]
        self._due[row.name] = self._next = t
        return True

    def tell(self, severity: int, words: str) -> None:
        """Say a sentence, of a MAV_SEVERITY, unless it waits already; alarms keep half of the room."""
        if len(self._words) < _MOST_WORDS // 2 and (severity, words) not in self._words:
            self._words.append((severity, words))

    def _say(self, row: TelemetryRow, outbox: Outbox) -> None:
        fields = None if self._seen is None else row.fields(self._seen)
        if fields is not None:
            outbox.put(row.priority, row.name, fields)

    def _tell(self, outbox: Outbox) -> None:
        while self._words and outbox.room(Priority.STATE) > 512:
            severity, words = self._words.popleft()
            encoded = words.encode()
            chunks = [encoded[at : at + _TEXT] for at in range(0, len(encoded), _TEXT)]
            if len(chunks) > 1 and len(chunks[-1]) == _TEXT:
                chunks.append(b"")  # the end is told by a chunk that is not full
            self._text = self._text % 0xFFFF + 1
            number = self._text if len(chunks) > 1 else 0
            for sequence, chunk in enumerate(chunks):
                values: Fields = {"severity": severity, "text": chunk, "id": number, "chunk_seq": sequence}
                outbox.put(Priority.STATE, "STATUSTEXT", values)
