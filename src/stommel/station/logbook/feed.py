"""Everything about a vehicle in one list by time: notes, commands, missions, alarms, and what it said in words."""

import re
from collections.abc import Callable, Collection
from typing import Any, NamedTuple

from sqlalchemy import ColumnElement, Row, Table, and_, false, or_, select

from stommel.archive import Archive
from stommel.archive.schema import alarms, commands, missions, notes, texts
from stommel.archive.times import seconds
from stommel.station.logbook.searching import has_words


class Entry(NamedTuple):
    """Something in the log book; times are those of the vehicle [s since 1970]."""

    kind: str
    id: str
    t: float
    user: str | None
    words: str
    state: str | None
    """What has become of it, or how bad the vehicle calls it; None of a note."""


Told = tuple[str | None, str, str | None]
"""User, words and state of an entry."""


class _Source(NamedTuple):
    table: Table
    time: str
    searched: tuple[str, ...]
    told: Callable[[Row[Any]], Told]


def _alarm(row: Row[Any]) -> Told:
    state = "open" if row.cleared_us is None else "over"
    if row.acknowledged_us is not None:
        state = _with(f"{state}, seen by {row.acknowledged_by}", row.note)
    return None, row.words, state


def _command(row: Row[Any]) -> Told:
    parameters = ", ".join(f"{key} {value}" for key, value in dict(row.parameters).items())
    return row.user, _with(f"Command {row.name}", parameters), _with(row.state, row.outcome)


def _mission(row: Row[Any]) -> Told:
    return row.user, f"Mission {row.name}", row.state


def _note(row: Row[Any]) -> Told:
    return row.user, row.words, None


SEVERITIES = ("emergency", "alert", "critical", "error", "warning", "notice", "info", "debug")
"""Words of MAV_SEVERITY, which is the place in this list."""


def _text(row: Row[Any]) -> Told:
    severity = SEVERITIES[row.severity] if 0 <= row.severity < len(SEVERITIES) else f"severity {row.severity}"
    return None, row.words, severity if row.log_id is None else f"{severity}, from its log"


def _with(words: str, more: str | None) -> str:
    return f"{words}: {more}" if more else words


SOURCES: dict[str, _Source] = {
    "alarm": _Source(alarms, "raised_us", ("words", "note", "acknowledged_by"), _alarm),
    "command": _Source(commands, "given_us", ("name", "outcome", "user"), _command),
    "mission": _Source(missions, "t_us", ("name", "user"), _mission),
    "note": _Source(notes, "t_us", ("words", "user"), _note),
    "text": _Source(texts, "t_us", ("words",), _text),
}
"""Where entries come from; at equal times in this order."""

CURSOR = r"^(\d{1,17})-(alarm|command|mission|note|text)-([0-9a-f]{1,16})$"
"""Of a page: time, kind and number of the last entry."""


class Page(NamedTuple):
    """A part of the list, the newest first."""

    entries: list[Entry]
    next: str | None
    """Where the older ones begin; None if there are none."""


def page_of(
    archive: Archive,
    vehicle: int,
    *,
    kinds: Collection[str] = tuple(SOURCES),
    search: str = "",
    severity: int = len(SEVERITIES) - 1,
    before: str | None = None,
    limit: int = 100,
) -> Page:
    """A page of the log book of a vehicle.

    Parameters
    ----------
    archive
        Where everything is.
    vehicle
        Its number.
    kinds
        What is wanted: names of `SOURCES`.
    search
        Words that an entry must have, each of them.
    severity
        Of the texts, the mildest: a place in `SEVERITIES`.
    before
        `next` of the page before; anything else gives an empty page.
    limit
        Most entries.
    """
    found: list[tuple[int, str, Entry]] = []
    with archive.reading() as connection:
        for kind, source in SOURCES.items():
            if kind not in kinds:
                continue
            t_us, number = source.table.c[source.time], source.table.c.id
            query = select(source.table).where(source.table.c.vehicle_id == vehicle, _is_before(kind, source, before))
            query = query.where(has_words(search, *(source.table.c[name] for name in source.searched)))
            if source.table is texts:
                query = query.where(texts.c.severity <= severity)
            rows = connection.execute(query.order_by(t_us.desc(), number.desc()).limit(limit + 1))
            found += [(row._mapping[source.time], kind, _entry(kind, source, row)) for row in rows]
    found.sort(key=lambda one: (-one[0], one[1]))  # stable: numbers stay as each table gave them
    last = found[limit - 1] if len(found) > limit else None
    return Page([entry for _, _, entry in found[:limit]], last and f"{last[0]}-{last[1]}-{last[2].id}")


def _entry(kind: str, source: _Source, row: Row[Any]) -> Entry:
    t = seconds(row._mapping[source.time])
    user, words, state = source.told(row)
    return Entry(kind, str(row.id), t, user, words, state)


def _is_before(kind: str, source: _Source, before: str | None) -> ColumnElement[bool]:
    if before is None:
        return source.table.c.vehicle_id.is_not(None)
    told = re.fullmatch(CURSOR, before)
    if told is None:
        return false()
    t_us, (last_t, last_kind, last_id) = source.table.c[source.time], told.groups()
    earlier: ColumnElement[bool] = t_us < int(last_t)
    if kind > last_kind:
        return or_(earlier, t_us == int(last_t))
    if kind < last_kind:
        return earlier
    number: int | str = last_id
    if kind != "command":
        if not last_id.isdecimal():
            return false()
        number = min(int(last_id), (1 << 63) - 1)
    return or_(earlier, and_(t_us == int(last_t), source.table.c.id < number))
