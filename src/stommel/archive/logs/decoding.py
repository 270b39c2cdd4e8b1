"""From the records of a log to rows of the archive, in batches of bounded size."""

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

from stommel.archive.logs.channels import CHANNELS, Fields
from stommel.archive.logs.dives import DiveFinder
from stommel.archive.logs.happenings import text_of
from stommel.archive.rows import Batch, CtdRow
from stommel.errors import StommelError
from stommel.messages.log.reader import LogContents, ReadKind, Record, records_of

AT_ONCE = 500
"""Records of a batch: what the archive takes in some hundredths of a second."""
FIRST, LAST = 946_684_800.0, 4_102_444_800.0
"""Times that a clock which was set can show: 2000 to 2100 [s since 1970]."""


class UndatedLogError(StommelError):
    """A log whose records nobody can date."""


class Decoded(NamedTuple):
    """A batch of a log."""

    batch: Batch
    end: int
    """Offset behind its last record [byte]."""
    records: int
    """So far in the file."""
    samples: int
    """Values of channels so far."""
    texts: int
    """So far."""
    dives: int
    """So far."""
    begin: float | None
    """First time so far [s since 1970]."""
    last: float | None


class LogDecoder:
    """Makes rows of records, and knows of a file what later ones of its records need.

    Parameters
    ----------
    contents
        With the header.

    Raises
    ------
    UndatedLogError
        The header tells no time of the vehicle's clock.
    """

    def __init__(self, contents: LogContents) -> None:
        self._t, self._utc = _clock_of(contents)
        self._names = {kind.name: kind.names for kind in contents.kinds.values()}
        self._finder = DiveFinder(_phases_of(contents), self.dated)
        self._samples: list[tuple[str, float, float]] = []
        self._texts: list[tuple[float, int, str]] = []
        self._ctd: list[CtdRow] = []
        self._undecided: list[CtdRow] = []
        """Samples before the decision of their step, which tells the number of the dive."""
        self._records = self._sampled = self._said = 0
        self._begin = self._last = math.nan

    def dated(self, t: float) -> float:
        """Seconds since 1970 at a time of the software [s]."""
        return self._utc + (t - self._t)

    def take(self, record: Record) -> None:
        """Take a record; one of a kind that says nothing here, or of no time, is only counted."""
        self._records += 1
        names = self._names.get(record.kind, ())
        if record.kind not in CHANNELS or "t" not in names:
            return
        fields = dict(zip(names, record.values, strict=True))
        t = fields["t"]
        if not isinstance(t, float) or not FIRST <= self.dated(t) <= LAST:
            return
        at = self.dated(t)
        self._begin, self._last = min(at, self._begin), max(at, self._last)  # of no number and a number, the number
        for key, value in CHANNELS[record.kind]:
            found = value(fields)
            if found is not None:
                self._samples.append((key, at, found))
        self._follow(record.kind, fields, at)

    def _follow(self, kind: str, fields: Fields, at: float) -> None:
        finder = self._finder
        try:
            if kind == "decision":
                finder.decision(fields)
                self._decide()
            elif kind == "navigation":
                finder.navigation(fields)
            elif kind == "battery":
                finder.battery(fields)
            elif kind == "ctd":
                values = [_known(fields.get(name)) for name in ("pressure", "temperature", "conductivity")]
                self._undecided.append(CtdRow(at, None, *values))
            elif kind == "event" and (text := text_of(fields, at)) is not None:
                self._texts.append(text)
        except (KeyError, TypeError, ValueError, OverflowError):
            return  # a log of other fields tells no dives

    def _decide(self) -> None:
        self._ctd += [row._replace(dive=self._finder.number) for row in self._undecided]
        self._undecided = []

    def batch(self, end: int, *, is_last: bool = False) -> Decoded:
        """What was taken since the last batch."""
        finder = self._finder
        if is_last or len(self._undecided) >= AT_ONCE:
            self._decide()
        made = Batch(samples=self._samples, texts=self._texts, dives=list(finder.found.values()), ctd=self._ctd)
        self._sampled += len(self._samples)
        self._said += len(self._texts)
        self._samples, self._texts, self._ctd = [], [], []
        finder.found = {}
        begin, last = (None if math.isnan(t) else t for t in (self._begin, self._last))
        return Decoded(made, end, self._records, self._sampled, self._said, len(finder.seen), begin, last)


def decoded(contents: LogContents, data: bytes, first: int) -> Iterator[Decoded]:
    """Batches of the valid beginning of a file; `contents` tells at the end what is wrong behind it.

    Parameters
    ----------
    contents, first
        From `stommel.messages.log.reader.opened_log`.
    data
        The whole file.

    Raises
    ------
    UndatedLogError
        Its records cannot be dated.
    """
    decoder = LogDecoder(contents)
    waiting = 0
    for record in records_of(contents, data, first):
        if waiting == AT_ONCE:
            yield decoder.batch(record.offset)
            waiting = 0
        decoder.take(record)
        waiting += 1
    yield decoder.batch(contents.offset, is_last=True)


def _clock_of(contents: LogContents) -> tuple[float, float]:
    clock = contents.header.get("clock")
    t, utc = (clock.get("t"), clock.get("utc")) if isinstance(clock, dict) else (None, None)
    if not isinstance(t, int | float) or not isinstance(utc, int | float):
        raise UndatedLogError("the log does not tell the vehicle's clock: its records cannot be dated")
    if not math.isfinite(t) or not FIRST <= utc <= LAST:
        raise UndatedLogError(
            f"the vehicle's clock was not set: it showed {utc:.0f} s since 1970; allowed are the years 2000 to 2100"
        )
    return float(t), float(utc)


def _phases_of(contents: LogContents) -> tuple[str, ...]:
    """Words of the phases, as the log describes its decisions."""
    kinds: list[ReadKind] = [kind for kind in contents.kinds.values() if kind.name == "decision"]
    for field in kinds[0].fields if kinds else ():
        if field["name"] == "phase" and isinstance(field.get("words"), list | tuple):
            return tuple(str(word) for word in field["words"])
    return ()


def _known(value: Any) -> float | None:
    return float(value) if isinstance(value, int | float) and math.isfinite(value) else None
