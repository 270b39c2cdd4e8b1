"""Everything about a vehicle in one list by time: dives, notes, what people did and what became of it, its words."""

import re
from collections.abc import Callable, Collection
from typing import Any, Literal, NamedTuple

from sqlalchemy import ColumnElement, Row, String, Table, and_, cast, false, literal, or_, select, true

from stommel.archive import Archive, DiveRow
from stommel.archive.doing_table import doings
from stommel.archive.readers import dive_of
from stommel.archive.schema import alarms, commands, dives, files, missions, notes, parameter_writes, texts
from stommel.archive.times import microseconds, seconds
from stommel.archive.whereabouts.dive_ends import with_true_ends
from stommel.files.sentences import pattern_of
from stommel.station.logbook.searching import has_words
from stommel.station.logbook.told import Told, known_then, told_of

Kind = Literal["alarm", "command", "dive", "hold", "limit", "mission", "note", "parameter", "text", "transfer"]
"""Of an entry."""


class Entry(NamedTuple):
    """Something in the log book; times are those of the vehicle [s since 1970]."""

    kind: Kind
    id: str
    vehicle: int | None
    """None: of the station, by whose clock the time then is."""
    t: float
    user: str | None
    words: str
    state: str | None
    """What has become of it, or how bad the vehicle calls it; None of a note."""
    dive: DiveRow | None = None
    """Of a dive: what is known of it."""


class _Source(NamedTuple):
    table: Table
    time: str
    searched: tuple[str | ColumnElement[str], ...]
    told: Callable[[Row[Any]], Told]
    only: ColumnElement[bool] = true()
    """Which rows of the table."""
    is_also_of_station: bool = False
    number: str = "id"
    """Orders what is of the same time."""


def _alarm(row: Row[Any]) -> Told:
    state = "open" if row.cleared_us is None else "over"
    if row.acknowledged_us is not None:
        state = _with(f"{state}, seen by {row.acknowledged_by}", row.note)
    return Told(None, row.words, state)


def _command(row: Row[Any]) -> Told:
    parameters = ", ".join(f"{key} {value}" for key, value in dict(row.parameters).items())
    return Told(row.user, _with(f"Command {row.name}", parameters), _with(row.state, row.outcome))


def _mission(row: Row[Any]) -> Told:
    return Told(row.user, f"Mission {row.name}", row.state)


def _parameter(row: Row[Any]) -> Told:
    words = f"Parameter {row.name} of component {row.component} set to {row.value:.10g}"
    return Told(row.user, words, _with(row.state, row.words))


def _transfer(row: Row[Any]) -> Told:
    way = "from the vehicle" if row.direction == "download" else "to the vehicle"
    return Told(
        row.user, f"File {row.path} {way}", _with("under way" if row.state == "going" else row.state, row.reason)
    )


def _doing(row: Row[Any]) -> Told:
    return Told(row.user, row.words, None)


def _note(row: Row[Any]) -> Told:
    return Told(row.user, row.words, None)


def _dive(row: Row[Any]) -> Told:
    return told_of(with_true_ends(dive_of(row)))


SEVERITIES = ("emergency", "alert", "critical", "error", "warning", "notice", "info", "debug")
"""Words of MAV_SEVERITY, which is the place in this list."""


def _text(row: Row[Any]) -> Told:
    severity = SEVERITIES[row.severity] if 0 <= row.severity < len(SEVERITIES) else f"severity {row.severity}"
    return Told(None, row.words, severity if row.log_id is None else f"{severity}, from its log")


def _with(words: str, more: str | None) -> str:
    return f"{words}: {more}" if more else words


SOURCES: dict[Kind, _Source] = {
    "alarm": _Source(alarms, "raised_us", ("words", "note", "acknowledged_by"), _alarm, is_also_of_station=True),
    "command": _Source(commands, "given_us", ("name", "outcome", "user"), _command),
    "dive": _Source(dives, "t_begin_us", (literal("Dive ") + cast(dives.c.dive, String),), _dive, number="dive"),
    "hold": _Source(doings, "t_us", ("words", "user"), _doing, doings.c.kind == "hold"),
    "limit": _Source(doings, "t_us", ("words", "user"), _doing, doings.c.kind == "limit"),
    "mission": _Source(missions, "t_us", ("name", "user"), _mission),
    "note": _Source(notes, "t_us", ("words", "user"), _note, is_also_of_station=True),
    "parameter": _Source(parameter_writes, "t_us", ("name", "words", "user"), _parameter),
    "text": _Source(texts, "t_us", ("words",), _text),
    "transfer": _Source(files, "t_us", ("path", "reason", "user"), _transfer),
}
"""Where entries come from; at equal times in this order."""

CURSOR = pattern_of(
    rf"^(\d{{1,17}})-({'|'.join(SOURCES)})-([0-9a-f]{{1,16}})$", "must be the `next` of the page before"
)
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
    kinds: Collection[Kind] = tuple(SOURCES),
    search: str = "",
    severity: int = len(SEVERITIES) - 1,
    until: float | None = None,
    before: str | None = None,
    limit: int = 100,
) -> Page:
    """A page of the log book of a vehicle, with the alarms and notes that are of the station.

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
    until
        Only what had happened by then [s since 1970], and dives as they were then; of all else, what became of it.
    before
        `next` of the page before; anything else gives an empty page.
    limit
        Most entries.
    """
    found: list[tuple[int, str, str, Entry]] = []
    with archive.reading() as connection:
        for kind, source in SOURCES.items():
            if kind not in kinds:
                continue
            t_us, number = source.table.c[source.time], source.table.c[source.number]
            query = select(source.table).where(_is_of(source, vehicle), source.only, _is_before(kind, source, before))
            query = query.where(has_words(search, *(_searched(source, one) for one in source.searched)))
            if until is not None:
                query = query.where(t_us <= microseconds(until))
            if source.table is texts:
                query = query.where(texts.c.severity <= severity)
            rows = connection.execute(query.order_by(t_us.desc(), number.desc()).limit(limit + 1))
            found += [_entry(kind, source, row, until) for row in rows]
    found.sort(key=lambda one: (-one[0], one[1]))  # stable: numbers stay as each table gave them
    last = found[limit - 1] if len(found) > limit else None
    return Page([entry for _, _, _, entry in found[:limit]], last and "-".join(map(str, last[:3])))


def _searched(source: _Source, one: str | ColumnElement[str]) -> ColumnElement[str]:
    return source.table.c[one] if isinstance(one, str) else one


def _entry(kind: Kind, source: _Source, row: Row[Any], until: float | None) -> tuple[int, str, str, Entry]:
    """Time, kind and number of an entry, which are its place in the list, and the entry."""
    t_us, number, told = row._mapping[source.time], str(row._mapping[source.number]), source.told(row)
    id = number
    if told.dive is not None:
        id = f"{number}-{t_us}"  # each mission counts its dives from 1
        told = told if until is None else told_of(known_then(told.dive, until))
    return t_us, kind, number, Entry(kind, id, row.vehicle_id, seconds(t_us), *told)


def _is_of(source: _Source, vehicle: int) -> ColumnElement[bool]:
    of = source.table.c.vehicle_id
    return or_(of == vehicle, of.is_(None)) if source.is_also_of_station else of == vehicle


def _is_before(kind: str, source: _Source, before: str | None) -> ColumnElement[bool]:
    if before is None:
        return true()
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
    return or_(earlier, and_(t_us == int(last_t), source.table.c[source.number] < number))
