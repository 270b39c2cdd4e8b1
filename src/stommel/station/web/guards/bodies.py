"""JSON bodies that every route can take: bounded, UTF-8, no NaN, no half characters, no control characters."""

import json
from typing import Any, NoReturn

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from stommel.station.web.guards.answers import refuse

LARGEST = 1 << 20
"""Bytes of a JSON body."""
_SUSPECT = (b"\\u00", b"\\ud", b"\\uD", b"NaN", b"Infinity", b"\x00")
"""Without any of these a body needs no second look; raw control characters are no JSON anyway."""
_PLAIN = "\t\n\r"


class SoundBodies:
    """Reads a JSON body whole, looks at it once and hands it on; the audit log reads it again."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Look at the body, then pass the request on."""
        headers = Headers(scope=scope) if scope["type"] == "http" else None
        kind = "" if headers is None else headers.get("content-type", "").partition(";")[0].strip().lower()
        if not (kind == "application/json" or kind.endswith("+json")):
            await self._app(scope, receive, send)
            return
        body = await _whole(receive)
        if body is None:
            words = f"the body is too large; at most {LARGEST // 1024} kB are taken here"
            await refuse(scope, receive, send, 413, words)
            return
        objection = unsound(body)
        if objection:
            await refuse(scope, receive, send, 422, objection)
            return
        scope["state"]["body"] = body
        await self._app(scope, _again(body, receive), send)


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


async def _whole(receive: Receive) -> bytes | None:
    """The body; None if it is too large."""
    parts, size = list[bytes](), 0
    while True:
        message = await receive()
        if message["type"] != "http.request":
            return b"".join(parts)
        parts.append(message.get("body", b""))
        size += len(parts[-1])
        if size > LARGEST:
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
