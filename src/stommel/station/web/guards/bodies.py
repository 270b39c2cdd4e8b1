"""JSON bodies that every route can take: bounded, UTF-8, no NaN, no half characters, no control characters."""

import json
from collections.abc import Callable
from typing import Any, NoReturn

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from stommel.station.web.errors import refusal
from stommel.station.web.guards.answers import refuse

LARGEST = 1 << 20
"""Bytes of a body, where the route says nothing else."""
_SUSPECT = (b"\\u00", b"\\ud", b"\\uD", b"NaN", b"Infinity", b"\x00")
"""Without any of these a body needs no second look; raw control characters are no JSON anyway."""
_PLAIN = "\t\n\r"
_WITHOUT_BODY = frozenset({"GET", "HEAD", "OPTIONS"})


class SoundBodies:
    """Bounds every body; reads a JSON body whole, looks at it once and hands it on. The audit log reads it again.

    Parameters
    ----------
    largest
        Bytes that a route takes where it says so itself; others take `LARGEST`.
    """

    def __init__(self, app: ASGIApp, largest: Callable[[Scope], int]) -> None:
        self._app, self._largest = app, largest

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Look at the body, then pass the request on."""
        if scope["type"] != "http" or scope["method"] in _WITHOUT_BODY:
            await self._app(scope, receive, send)
            return
        headers = Headers(scope=scope)
        bound = self._largest(scope) or LARGEST
        if _said_length(headers) > bound:
            await refuse(scope, receive, send, 413, _too_large(bound))
            return
        kind = headers.get("content-type", "").partition(";")[0].strip().lower()
        if not (kind == "application/json" or kind.endswith("+json")):
            await self._app(scope, _bounded(receive, bound), send)
            return
        body = await _whole(receive, bound)
        objection = _too_large(bound) if body is None else unsound(body)
        if objection:
            await refuse(scope, receive, send, 413 if body is None else 422, objection)
            return
        scope["state"]["body"] = body
        await self._app(scope, _again(body or b"", receive), send)


def unsound(body: bytes) -> str | None:
    """What is wrong with a JSON body; a body that is no JSON at all is left to the route."""
    try:
        body.decode("utf-8")
    except UnicodeDecodeError:
        return "the body is not UTF-8"
    if not any(part in body for part in _SUSPECT):
        return None
    try:
        content = json.loads(body, parse_constant=_no_number)
    except _NoNumberError as error:
        return f"{error} is no number; a missing one is null"
    except (ValueError, RecursionError):
        return None
    if not _printable(content):
        return "a text holds a control character, or half a character"
    return None


class _NoNumberError(Exception):
    """NaN or an infinite number, which are not JSON."""


def _no_number(word: str) -> NoReturn:
    raise _NoNumberError(word)


def _printable(content: Any) -> bool:
    """Whether every text in it can be stored and shown."""
    todo = [content]
    while todo:
        part = todo.pop()
        if isinstance(part, dict):
            todo += [*part.keys(), *part.values()]
        elif isinstance(part, list):
            todo += part
        elif isinstance(part, str) and any(
            "\ud800" <= sign <= "\udfff" or (sign < " " and sign not in _PLAIN) for sign in part
        ):
            return False
    return True


def _said_length(headers: Headers) -> int:
    """Length that a request says of its body; 0 if it says none that can be read."""
    said = headers.get("content-length", "")
    return int(said) if said.isdecimal() and len(said) < 20 else 0


def _too_large(bound: int) -> str:
    return f"the body is too large; at most {bound // 1024} kB are taken here"


def _bounded(receive: Receive, bound: int) -> Receive:
    """What hands on a body as it comes, and no more of it than the bound."""
    left = bound

    async def handed_on() -> Message:
        nonlocal left
        message = await receive()
        left -= len(message.get("body", b""))
        if left < 0:
            raise refusal(413, _too_large(bound))
        return message

    return handed_on


async def _whole(receive: Receive, bound: int) -> bytes | None:
    """The body; None if it is too large."""
    parts, size = list[bytes](), 0
    while True:
        message = await receive()
        if message["type"] != "http.request":
            return b"".join(parts)
        parts.append(message.get("body", b""))
        size += len(parts[-1])
        if size > bound:
            return None
        if not message.get("more_body", False):
            return b"".join(parts)


def _again(body: bytes, receive: Receive) -> Receive:
    """What hands on a body that was read."""
    told = False

    async def handed_on() -> Message:
        nonlocal told
        if told:
            return await receive()
        told = True
        return {"type": "http.request", "body": body, "more_body": False}

    return handed_on
