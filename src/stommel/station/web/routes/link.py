"""The radio link to a vehicle: how it is, and every frame as it was."""

import math
from typing import Annotated, Any, Literal

from fastapi import APIRouter, Query
from pydantic import BaseModel

from stommel.archive.readers import StoredFrame
from stommel.link.frames import CHECKSUM, HEAD
from stommel.messages.mavlink import MessageError, message_named, message_types
from stommel.station.web.access import Viewer
from stommel.station.web.errors import refusal
from stommel.station.web.found import Line, TheStation

router = APIRouter(prefix="/api", tags=["link"])


FieldValue = bool | int | float | str | None | list[int | float | str | None]
"""Of a message; null for what is no number, a text for what JSON has no number for."""


class LinkFigures(BaseModel):
    """Counts since the station was started; times in seconds, null before they were measured."""

    good: int
    bad: int
    duplicate: int
    lost: int
    loss_share: float
    unsigned_refused: int
    wrongly_signed_refused: int
    replayed_refused: int
    out_of_step_refused: int
    """Rightly signed, but said before the vehicle had heard this station: harmless, unless it goes on."""
    round_trip_s: float | None
    time_out_s: float | None
    goodput_b_s: float
    retransmit_ratio: float
    bytes_waiting: int
    surface_time_left_s: float | None
    is_signing: bool


class LinkAnswer(BaseModel):
    """How the link to a vehicle is."""

    now: float
    heard: bool
    since: float | None
    """Since when it is heard without a pause [s since 1970]."""
    last_contact: float | None
    transport: str
    is_open: bool
    reason: str
    """Why the vehicle is not heard; empty while it is."""
    archive: str
    """Why what comes is not kept; empty while it is."""
    frames_waiting: int
    """That the archive does not have yet."""
    figures: LinkFigures
    notes: list[str]


class Frame(BaseModel):
    """A frame of the link."""

    number: int
    """In the archive; later ones have greater numbers."""
    t: float
    received: float
    direction: Literal["in", "out"]
    system: int
    component: int
    message_id: int
    message: str
    sequence: int
    signed: bool
    bytes: str
    """As it was, in hexadecimal."""
    values: dict[str, FieldValue]
    """Fields of the message."""


@router.get("/vehicles/{vehicle}/link")
def show_link(_user: Viewer, line: Line) -> LinkAnswer:
    """Return how the link to a vehicle is."""
    status = line.status()
    told = status.statistics
    figures = LinkFigures(
        good=told.good, bad=told.bad, duplicate=told.duplicate, lost=told.lost, loss_share=told.loss,
        unsigned_refused=told.refusals.unsigned, wrongly_signed_refused=told.refusals.wrongly_signed,
        replayed_refused=told.refusals.replayed, out_of_step_refused=told.refusals.out_of_step,
        round_trip_s=_known(told.round_trip_time),
        time_out_s=_known(told.time_out), goodput_b_s=told.goodput, retransmit_ratio=told.retransmit_ratio,
        bytes_waiting=told.bytes_waiting, surface_time_left_s=_known(told.surface_time_left),
        is_signing=told.is_signing,
    )  # fmt: skip
    return LinkAnswer(
        now=line.clock.now(), heard=status.heard, since=status.since, last_contact=status.last_contact,
        transport=status.transport, is_open=status.is_open, reason=status.reason, archive=status.archive,
        frames_waiting=status.waiting, figures=figures, notes=list(status.notes),
    )  # fmt: skip


@router.get("/vehicles/{vehicle}/frames")
def list_frames(
    _user: Viewer,
    line: Line,
    station: TheStation,
    before: Annotated[int | None, Query(ge=1, le=1 << 62, description="Only frames of smaller numbers.")] = None,
    limit: Annotated[int, Query(ge=1, le=1000)] = 100,
    message: Annotated[str | None, Query(max_length=60, description="Name of the message, or its number.")] = None,
) -> list[Frame]:
    """Return the newest frames of a vehicle, the newest first, as they were and with what they say."""
    number = None if message is None else _number(message)
    found = station.archive.frames(line.vehicle, before=before, limit=limit, message=number)
    return [_told(each) for each in found]


@router.get("/vehicles/{vehicle}/messages")
def list_messages(_user: Viewer, line: Line, station: TheStation) -> list[str]:
    """Return the names of all messages of which frames of a vehicle are kept, in their order."""
    return sorted(_name(number) for number in station.archive.messages(line.vehicle))


def _name(number: int) -> str:
    kind = message_types().get(number)
    return kind.name if kind else str(number)


def _number(message: str) -> int:
    if message.isdecimal() and len(message) <= 8:
        return int(message)
    try:
        return message_named(message.upper()).id
    except MessageError:
        raise refusal(
            422, f"there is no message {message}", key="message", value=message,
            allowed="a name as GLIDER_STATE, or a number",
        ) from None  # fmt: skip


def _told(stored: StoredFrame) -> Frame:
    row = stored.row
    kind = message_types().get(row.message_id)
    payload = row.frame[HEAD : HEAD + row.frame[1]] if len(row.frame) >= HEAD + CHECKSUM else b""
    values = {} if kind is None else {name: _plain(value) for name, value in kind.unpack(payload).items()}
    return Frame(
        number=stored.number, t=row.t, received=stored.received,
        direction="out" if row.direction == "out" else "in", system=row.system, component=row.component,
        message_id=row.message_id, message=_name(row.message_id),
        sequence=row.sequence, signed=row.signed, bytes=row.frame.hex(), values=values,
    )  # fmt: skip


def _plain(value: Any) -> Any:
    """What JSON can hold."""
    if isinstance(value, bytes):
        return value.hex()
    if isinstance(value, tuple):
        return [_plain(each) for each in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    if isinstance(value, int) and abs(value) >= 1 << 53:
        return str(value)
    return value


def _known(value: float) -> float | None:
    return value if math.isfinite(value) else None
