"""One shape of every error: a sentence for people, and the key, the value and what is allowed where there is one."""

import logging
from collections.abc import Sequence
from math import isfinite
from typing import Any

from fastapi import FastAPI, HTTPException, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from sqlalchemy.exc import IntegrityError
from starlette.exceptions import HTTPException as AnyHTTPException

from stommel.archive.errors import ArchiveError, ArchiveRequestError
from stommel.errors import FileError, StommelError, one_line
from stommel.files.sentences import dotted, value_sentence
from stommel.plans.preview.previews import NotFlownError, TooManyJobsError, UnknownJobError
from stommel.plans.preview.worker import SimulatorError
from stommel.plans.problems import PlanError
from stommel.station.people.errors import (
    HeldError,
    PeopleError,
    TooManyTriesError,
    UnknownPersonError,
    WrongLoginError,
)
from stommel.station.vehicles.opening import LateError, MissingError, VehicleError

MOST_PROBLEMS = 20
_LONGEST = 600
_PLACES = ("body", "query", "path", "header", "cookie")
_WORDS = {
    404: "there is nothing at this address",
    405: "this address does not do that",
    413: "this is too large",
    400: "the request cannot be understood",
}
STATUS: tuple[tuple[type[StommelError], int], ...] = (
    (TooManyTriesError, 429),
    (WrongLoginError, 401),
    (UnknownPersonError, 404),
    (HeldError, 409),
    (PeopleError, 422),
    (MissingError, 404),
    (VehicleError, 409),
    (LateError, 503),
    (TooManyJobsError, 429),
    (UnknownJobError, 404),
    (NotFlownError, 409),
    (SimulatorError, 503),
    (ArchiveRequestError, 422),
    (ArchiveError, 503),
    (StommelError, 422),
)
"""Status of each kind of error that a person can mend, the special ones first."""


def detail_of(
    reason: str, key: str | None = None, value: Any = None, allowed: str | None = None
) -> dict[str, dict[str, Any]]:
    """Body of an error."""
    words = one_line(_encodable(reason), _LONGEST)
    return {"detail": {"reason": words, "key": key, "value": _plain(value), "allowed": allowed}}


def refusal(
    status: int,
    reason: str,
    *,
    key: str | None = None,
    value: Any = None,
    allowed: str | None = None,
    headers: dict[str, str] | None = None,
) -> HTTPException:
    """Error to raise from a route.

    Parameters
    ----------
    status
        HTTP status, 400 to 499; 503 where the station cannot for the moment.
    reason
        Sentence for people: what happened and what to do.
    key, value, allowed
        The field that is to be mended, what it was, and what may stand there.
    """  # fmt: skip
    return HTTPException(status, detail_of(reason, key, value, allowed)["detail"], headers)


def add_handlers(app: FastAPI) -> None:
    """Give every error of the application the one shape."""
    app.add_exception_handler(AnyHTTPException, _http)
    app.add_exception_handler(RequestValidationError, _invalid)
    app.add_exception_handler(StommelError, _mendable)
    app.add_exception_handler(IntegrityError, _conflict)


def status_of(error: StommelError) -> int:
    """HTTP status of an error that a person can mend."""
    return next(status for kind, status in STATUS if isinstance(error, kind))


async def _http(_request: Request, error: Exception) -> JSONResponse:
    if not isinstance(error, AnyHTTPException):
        raise error
    told: Any = error.detail
    if isinstance(told, dict) and "reason" in told:
        body = {"detail": told}
    else:
        body = detail_of(_WORDS.get(error.status_code, str(told)))
    return JSONResponse(body, error.status_code, headers=error.headers)


async def _invalid(_request: Request, error: Exception) -> JSONResponse:
    if not isinstance(error, RequestValidationError):
        raise error
    found = [_problem(detail) for detail in error.errors()[:MOST_PROBLEMS]]
    return JSONResponse({"detail": found[0] | {"problems": found}}, 422)


async def _mendable(_request: Request, error: Exception) -> JSONResponse:
    if not isinstance(error, StommelError):
        raise error
    status = status_of(error)
    headers = {"Retry-After": "2"} if status == 503 else None
    if isinstance(error, TooManyTriesError):
        headers = {"Retry-After": str(int(error.wait) + 1)}
    if isinstance(error, FileError):
        found = [detail_of(line.message, line.key)["detail"] for line in error.problems[:MOST_PROBLEMS]]
        return JSONResponse({"detail": found[0] | {"problems": found}}, status)
    if isinstance(error, PlanError):
        rows = [detail_of(each.reason, each.key, each.value, each.allowed)["detail"] for each in error.problems]
        return JSONResponse({"detail": rows[0] | {"problems": rows[:MOST_PROBLEMS]}}, status)
    about = [getattr(error, name, None) for name in ("key", "value", "allowed")]
    return JSONResponse(detail_of(str(error), *about), status, headers=headers)


async def _conflict(_request: Request, error: Exception) -> JSONResponse:
    logging.getLogger("stommel.station").warning("refused by the archive: %s", error)
    return JSONResponse(detail_of("this does not fit what the archive holds; load the page again and see"), 409)


def _problem(detail: dict[str, Any]) -> dict[str, Any]:
    """What is wrong with one value of a request."""
    kind, place = detail["type"], detail["loc"]
    if kind == "json_invalid":
        return detail_of("the body is no JSON", allowed="JSON")["detail"]
    key = dotted(place[1:] if place and place[0] in _PLACES else place) or None
    if isinstance(detail["input"], bytes):
        return detail_of("the body is not marked as JSON", "content-type", None, "content-type: application/json")[
            "detail"
        ]
    if kind in ("model_attributes_type", "model_type", "dict_type"):
        return detail_of(f"{key or 'the body'} must be an object", key, _short(detail["input"]), "{...}")["detail"]
    if kind == "missing":
        what = f"{key} is missing" if key else "the body is missing"
        return detail_of(what, key, None, "a value")["detail"]
    if kind == "extra_forbidden":
        return detail_of(f"{key} is not known here", key, _short(detail["input"]))["detail"]
    _, _, allowed = value_sentence(detail).rpartition(": ")  # type: ignore[arg-type]
    return detail_of(
        f"{key or 'the body'} = {_short(detail['input'])!r}: {allowed}", key, _short(detail["input"]), allowed
    )["detail"]


def _short(value: Any) -> Any:
    """A value as the answer repeats it: whole if it is small."""
    plain = _plain(value)
    if isinstance(plain, str) and len(plain) > 100:
        return f"{plain[:100]}..."
    return plain


def _plain(value: Any) -> Any:
    """A value that JSON can hold."""
    if value is None or isinstance(value, (bool, int)):
        return value if value is None or isinstance(value, bool) or abs(value) < 1 << 53 else str(value)[:100]
    if isinstance(value, float):
        return value if isfinite(value) else str(value)
    if isinstance(value, bytes):
        return f"{len(value)} bytes"
    if isinstance(value, (dict, Sequence)) and not isinstance(value, str):
        return one_line(_encodable(repr(value)), 100)
    return _encodable(str(value))


def _encodable(text: str) -> str:
    """The text without halves of characters, which UTF-8 cannot hold."""
    return text.encode("utf-8", "replace").decode("utf-8")
