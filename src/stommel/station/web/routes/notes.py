"""The log book: notes of people, beside them dives, what people did, alarms, and what the vehicle said."""

from typing import Annotated

from fastapi import APIRouter, Query
from pydantic import BaseModel, ConfigDict, Field

from stommel.archive.times import GREATEST_TIME
from stommel.archive.whereabouts.dive_ends import told_dive
from stommel.files.sentences import PRINTABLE
from stommel.station.live.events import Happening
from stommel.station.logbook.feed import CURSOR, SOURCES, Entry, Kind, page_of
from stommel.station.logbook.notes import Notes
from stommel.station.web.access import Pilot, Viewer
from stommel.station.web.errors import refusal
from stommel.station.web.found import Line, TheStation, line_to
from stommel.station.web.routes.data import Dive

router = APIRouter(prefix="/api", tags=["log book"])

GREATEST_NUMBER = (1 << 53) - 1
"""Of a row; beyond it JSON's numbers are not exact."""
_AHEAD = 60.0
"""A note may be of a time so far ahead, for two clocks never agree [s]."""
Search = Annotated[str, Query(max_length=200, pattern=PRINTABLE, description="Words that must be in it.")]


class NoteRow(BaseModel):
    """What somebody wrote."""

    id: int
    vehicle: int | None
    """Null: of the station."""
    t: float
    """Time that it is about, by the vehicle's clock [s since 1970]."""
    written: float
    """When it was written [s since 1970]."""
    user: str
    words: str


class NewNote(BaseModel):
    """What shall be written; of now, if no time is given."""

    model_config = ConfigDict(extra="forbid")

    vehicle: Annotated[int | None, Field(ge=1, le=250)] = None
    t: Annotated[float | None, Field(ge=0, le=GREATEST_TIME, allow_inf_nan=False)] = None
    words: Annotated[str, Field(min_length=1, max_length=10_000, pattern=r"\S")]


class LogEntry(BaseModel):
    """Something in the log book; times are those of the vehicle [s since 1970]."""

    kind: Kind
    id: str
    vehicle: int | None
    """Null: of the station, by whose clock the time then is."""
    t: float
    user: str | None
    words: str
    state: str | None
    """What has become of it, or how bad it is by the vehicle; null of a note."""
    dive: Dive | None
    """Of a dive: what is known of it."""


class LogPage(BaseModel):
    """A part of the log book, the newest first."""

    entries: list[LogEntry]
    next: str | None
    """Gives the older ones as `before`; null if there are none."""


@router.get("/notes")
def read_notes(
    _user: Viewer,
    station: TheStation,
    vehicle: Annotated[int | None, Query(ge=1, le=250)] = None,
    search: Search = "",
    before: Annotated[int | None, Query(ge=1, le=GREATEST_NUMBER, description="The last note of a page.")] = None,
    limit: Annotated[int, Query(ge=1, le=1000)] = 200,
) -> list[NoteRow]:
    """Notes about all vehicles or one, of the newest time first."""
    found = Notes(station.archive).listed(vehicle=vehicle, search=search, before=before, limit=limit)
    return [NoteRow(**note.as_row()) for note in found]


@router.post("/notes", status_code=201)
def add_note(user: Pilot, body: NewNote, station: TheStation) -> NoteRow:
    """Write a note; it stays as it is, with your name and the time."""
    if body.vehicle is not None:
        line_to(body.vehicle, station)
    now = station.now(body.vehicle)
    if body.t is not None and body.t > now + _AHEAD:
        raise refusal(422, "a note is about a time that has passed", key="t", value=body.t, allowed=f"0 to {now:.0f}")
    t = now if body.t is None else body.t
    note = Notes(station.archive).add(body.vehicle, t, user.name, body.words.strip())
    station.hub.publish(Happening("note", note.vehicle, note.as_row()))
    return NoteRow(**note.as_row())


@router.get("/vehicles/{vehicle}/log")
def read_log(
    _user: Viewer,
    line: Line,
    station: TheStation,
    kinds: Annotated[list[Kind] | None, Query(max_length=10, description="What is wanted; all if left out.")] = None,
    search: Search = "",
    severity: Annotated[
        int, Query(ge=0, le=7, description="Of what the vehicle said, the mildest; MAVLink's: 0 emergency to 7 debug.")
    ] = 7,
    until: Annotated[
        float | None,
        Query(
            ge=0,
            le=GREATEST_TIME,
            allow_inf_nan=False,
            description="Only what had happened by then, and dives as they were then [s since 1970].",
        ),
    ] = None,
    before: Annotated[
        str | None, Query(max_length=50, pattern=CURSOR, description="`next` of the page before.")
    ] = None,
    limit: Annotated[int, Query(ge=1, le=500)] = 100,
) -> LogPage:
    """All of a vehicle in one list, the newest first, with the notes and alarms of the station.

    Notes, dives, commands, missions, parameters that were set, transfers, who held command, limits, alarms, its words.
    What has become of each is told as it is known now, but for dives where `until` is given.
    """
    page = page_of(
        station.archive, line.vehicle, kinds=kinds or tuple(SOURCES), search=search, severity=severity, until=until,
        before=before, limit=limit,
    )  # fmt: skip
    return LogPage(entries=[_entry(entry) for entry in page.entries], next=page.next)


def _entry(entry: Entry) -> LogEntry:
    dive = None if entry.dive is None else Dive(**told_dive(entry.dive))
    return LogEntry(**entry._asdict() | {"dive": dive})
