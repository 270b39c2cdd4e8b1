"""Files of a vehicle: what it has, what is on its way, and what lies ashore."""

from email.parser import BytesParser
from email.policy import HTTP
from pathlib import PurePosixPath
from typing import Annotated, Any, Literal

from fastapi import APIRouter, Path, Query, Request
from fastapi.concurrency import run_in_threadpool
from fastapi.responses import FileResponse
from pydantic import BaseModel, ConfigDict, Field

from stommel.station.vehicles.files import MOST_CONTENT
from stommel.station.web.access import Pilot, Viewer
from stommel.station.web.errors import refusal
from stommel.station.web.found import Line, TheStation

router = APIRouter(prefix="/api", tags=["files"])

LONGEST_PATH = 200
_AROUND = 64 << 10
"""Bytes of a form about its file."""
Number = Annotated[int, Path(ge=1, le=1 << 62)]
Limit = Annotated[int, Query(ge=1, le=1000)]
_BODY = {
    "requestBody": {
        "required": True,
        "content": {
            "multipart/form-data": {
                "schema": {
                    "type": "object", "required": ["path", "file"],
                    "properties": {"path": {"type": "string"}, "file": {"type": "string", "format": "binary"}},
                }
            },
        },
    }
}  # fmt: skip


TransferState = Literal["going", "paused", "whole", "refused", "failed", "cancelled"]


class FolderEntry(BaseModel):
    """What stands in a folder aboard."""

    name: str
    size: int
    is_folder: bool


class FolderAnswer(BaseModel):
    """A folder aboard."""

    folder: str
    entries: list[FolderEntry]


class Transfer(BaseModel):
    """A file on its way, or that was; times are of the vehicle's clock [s since 1970]."""

    id: int
    vehicle: int
    path: str
    direction: Literal["download", "upload"]
    user: str | None
    t: float
    state: TransferState
    """At the end whole, refused, failed or cancelled."""
    is_over: bool
    is_paused: bool
    reason: str
    done: int
    """Bytes that are there."""
    size: int | None
    sha256: str | None
    rate: float | None
    """New bytes a second of late."""
    seconds_left: float | None
    loss_share: float | None


class StoredLog(BaseModel):
    """How far a log that lies ashore is in the archive; times are of the vehicle's clock [s since 1970]."""

    state: Literal["waiting", "going", "taken", "refused"]
    words: str
    """Whether it was whole; why it was refused."""
    share: float
    """Of it, that is in the archive."""
    samples: int
    dives: int
    texts: int
    """What happened aboard, in words."""
    left_out: int
    """Rows that no archive takes."""
    begin: float | None
    end: float | None


class StoredFile(BaseModel):
    """A file that lies whole ashore."""

    id: int
    path: str
    size: int | None
    sha256: str | None
    t: float
    state: str
    user: str | None
    log: StoredLog | None
    """Of a file of the vehicle's log."""


class NewTransfer(BaseModel):
    """A file to fetch."""

    model_config = ConfigDict(extra="forbid")

    path: Annotated[str, Field(min_length=1, max_length=LONGEST_PATH)]


@router.get("/vehicles/{vehicle}/listing")
def list_folder(
    _user: Viewer, line: Line, station: TheStation, folder: Annotated[str, Query(max_length=LONGEST_PATH)] = ""
) -> FolderAnswer:
    """Return what stands in a folder aboard; the vehicle is asked, and must be heard."""
    entries = station.files.listing(line.vehicle, folder)
    return FolderAnswer(folder=folder, entries=[FolderEntry.model_validate(each._asdict()) for each in entries])


@router.get("/vehicles/{vehicle}/transfers")
def list_transfers(_user: Viewer, line: Line, station: TheStation, limit: Limit = 100) -> list[Transfer]:
    """Return the last transfers of a vehicle, the newest first."""
    return [Transfer.model_validate(each) for each in station.files.transfers(line.vehicle, limit)]


@router.post("/vehicles/{vehicle}/transfers", status_code=202)
def fetch_file(user: Pilot, line: Line, station: TheStation, new: NewTransfer) -> Transfer:
    """Begin to fetch a file, over as many surfacings as it takes; no byte is asked for twice."""
    row = station.files.download(line.vehicle, user.name, new.path)
    return Transfer.model_validate(station.files.told(row))


@router.get("/vehicles/{vehicle}/files")
def list_files(_user: Viewer, line: Line, station: TheStation, limit: Limit = 1000) -> list[StoredFile]:
    """Return the files of a vehicle that lie whole ashore, the newest first."""
    stored = station.files.whole(line.vehicle, limit)
    told = station.logs.told(line.vehicle, stored)
    return [StoredFile.model_validate(row._asdict() | {"log": told.get(row.id)}) for row in stored]


@router.post(
    "/vehicles/{vehicle}/files", status_code=202, openapi_extra=_BODY, max_body_size=MOST_CONTENT + _AROUND
)  # fmt: skip
async def send_file(user: Pilot, line: Line, station: TheStation, request: Request) -> Transfer:
    """Begin to send a file: a form with `path`, where it shall be aboard, and `file`."""
    path, content = _form(request.headers.get("content-type", ""), await request.body())
    row = await run_in_threadpool(station.files.upload, line.vehicle, user.name, path, content)
    return Transfer.model_validate(station.files.told(row))


@router.get("/vehicles/{vehicle}/files/{id}", response_class=FileResponse)
def download_file(_user: Viewer, line: Line, station: TheStation, id: Number) -> FileResponse:
    """Return a file that lies whole ashore."""
    row, place = station.files.stored(line.vehicle, id)
    name = PurePosixPath(row.path).name
    return FileResponse(
        place, filename=name, media_type="application/octet-stream", headers={"ETag": f'"{row.sha256}"'}
    )  # fmt: skip


@router.post("/transfers/{id}/pause")
def pause_transfer(_user: Pilot, station: TheStation, id: Number) -> Transfer:
    """Let a transfer rest until somebody resumes it."""
    return _told(station, station.files.pause(id))


@router.post("/transfers/{id}/resume")
def resume_transfer(_user: Pilot, station: TheStation, id: Number) -> Transfer:
    """Let a transfer go on from where it was."""
    return _told(station, station.files.resume(id))


@router.post("/transfers/{id}/cancel")
def cancel_transfer(_user: Pilot, station: TheStation, id: Number) -> Transfer:
    """End a transfer; what has come of it is dropped."""
    return _told(station, station.files.cancel(id))


def _told(station: TheStation, row: Any) -> Transfer:
    return Transfer.model_validate(station.files.told(row))


def _form(kind: str, body: bytes) -> tuple[str, bytes]:
    """Path and file of a form."""
    allowed = "a form (multipart/form-data) with path and file"
    if not kind.lower().startswith("multipart/form-data") or "\n" in kind or "\r" in kind:
        raise refusal(422, "the body is no form", key="body", value=kind[:80], allowed=allowed)
    head = f"Content-Type: {kind}\r\n\r\n".encode("ascii", "replace")
    message = BytesParser(policy=HTTP).parsebytes(head + body)
    parts: dict[str, bytes] = {}
    for part in message.iter_parts() if message.is_multipart() else ():
        name = part.get_param("name", header="content-disposition")
        content = part.get_payload(decode=True)
        if isinstance(name, str) and isinstance(content, bytes):
            parts[name] = content
    if "path" not in parts or "file" not in parts:
        missing = "path" if "path" not in parts else "file"
        raise refusal(422, f"{missing} is missing", key=missing, allowed=allowed)
    path = parts["path"].decode("utf-8", "replace").strip()
    if not 1 <= len(path) <= LONGEST_PATH or not path.isprintable():
        raise refusal(422, "the path is none", key="path", value=path[:80], allowed=f"1 to {LONGEST_PATH} characters")
    return path, parts["file"]
