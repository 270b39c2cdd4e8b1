"""Taking a file of a log into the archive, in small steps, from where it was interrupted."""

import time
from collections.abc import Callable, Iterator
from functools import partial
from hashlib import sha256
from typing import TypeVar

from stommel.archive.archive import Archive
from stommel.archive.errors import ArchiveBusyError
from stommel.archive.logs.decoding import Decoded, UndatedLogError, decoded
from stommel.archive.logs.rows import GOING, REFUSED, TAKEN, LogRow, LogRows
from stommel.archive.rows import Batch
from stommel.messages.log.layout import MAGIC
from stommel.messages.log.reader import LogContents, opened_log

REST = 0.02
"""Between two batches [s], in which the lines of vehicles write."""
TRIES = 10
"""Of a batch, while the archive is busy."""

Told = Callable[[LogRow], bool]
"""Is told of each step; False ends it there, to be gone on with another time."""
Rest = Callable[[float], None]
"""Waits so long [s]."""
T = TypeVar("T")


def is_log(beginning: bytes) -> bool:
    """Whether a file that begins so is one of a log."""
    return beginning.startswith(MAGIC)


def take_log(
    archive: Archive,
    vehicle: int,
    data: bytes,
    name: str,
    told: Told = lambda _: True,
    *,
    rest: Rest = time.sleep,
) -> LogRow:
    """Take a file into the archive, and return its row; one that is there already changes nothing.

    A file that is cut off or damaged yields its valid beginning, and its row says so. One whose records cannot be
    dated is refused in its row.

    Parameters
    ----------
    archive
        Where to.
    vehicle
        Whose it is.
    data
        The whole file.
    name
        Of the file, for people.
    told
        Is told of each step.
    rest
        Waits between two steps [s].

    Raises
    ------
    FileError
        It is no log.
    ArchiveError
        The archive fails; what was taken stays, and the next time goes on from there.
    """
    contents, first = opened_log(data, name)
    rows = LogRows(archive)
    archive.store(vehicle, Batch())  # which makes it known
    row = rows.begun(LogRow(0, vehicle, sha256(data).hexdigest(), name, len(data)))
    if row.state == TAKEN:
        return row
    try:
        row = _taken(archive, rows, row, decoded(contents, data, first), contents, told, rest)
    except UndatedLogError as error:
        row = row._replace(state=REFUSED, words=str(error))
    if row.state == GOING:
        return row
    if row.state == TAKEN:
        rows.deepen(row)
    rows.change(row)
    told(row)
    return row


def _taken(
    archive: Archive,
    rows: LogRows,
    row: LogRow,
    steps: Iterator[Decoded],
    contents: LogContents,
    told: Told,
    rest: Rest,
) -> LogRow:
    """Go on from where the row says, to the end or until told otherwise."""
    header = contents.header
    if not header:
        return row._replace(state=REFUSED, words=f"its header cannot be read: {contents.verdict}")
    done = row.offset
    row = row._replace(state=GOING, words="", series=str(header["series"]), software=str(header["software"]))
    for step in steps:
        row = row._replace(
            records=step.records, samples=step.samples, texts=step.texts, dives=step.dives, begin=step.begin,
            end=step.last, offset=max(step.end, done),
        )  # fmt: skip
        if step.end <= done:
            continue  # it is there since before the interruption
        kept = _patiently(partial(archive.store_sound, row.vehicle, step.batch._replace(log=row.id)), rest)
        row = row._replace(left_out=row.left_out + len(kept.left_out))
        _patiently(partial(rows.change, row), rest)
        if not told(row):
            return row
        rest(REST)
    return row._replace(state=TAKEN, words=contents.verdict)


def _patiently(write: Callable[[], T], rest: Rest) -> T:
    for _ in range(TRIES):
        try:
            return write()
        except ArchiveBusyError:
            rest(1.0)
    return write()
