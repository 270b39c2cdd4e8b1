"""The audit log of every route that changes something, without the route's doing."""

import json
import logging
from typing import Any

from starlette.concurrency import run_in_threadpool
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from stommel.errors import StommelError
from stommel.station.people.audit import Audit
from stommel.station.people.roles import User
from stommel.station.web.guards.origins import HARMLESS

SECRET = frozenset({"password", "token", "secret", "key"})
"""Words of a key, as of `new_password`, whose value is never written down."""
_LARGEST = 4096
"""Bytes of a body that the log repeats."""


class Trail:
    """Writes who did what before the answer leaves; what was refused is not in it."""

    def __init__(self, app: ASGIApp, audit: Audit) -> None:
        self._app, self._audit = app, audit

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass everything on, and note what changed something."""
        if scope["type"] != "http" or scope["method"] in HARMLESS:
            await self._app(scope, receive, send)
            return

        async def noted(message: Message) -> None:
            if message["type"] == "http.response.start" and message["status"] < 400:
                await run_in_threadpool(self._note, scope, message["status"])
            await send(message)

        await self._app(scope, receive, noted)

    def _note(self, scope: Scope, status: int) -> None:
        state = scope["state"]
        user: User | None = state.get("user")
        if user is None:
            return
        address = scope["client"][0] if scope.get("client") else None
        vehicle = state.get("vehicle")
        detail: dict[str, Any] = {"path": scope["path"], "status": status, "by": user.via}
        if state.get("body"):
            detail["body"] = _shown(state["body"])
        try:
            action = state.get("action") or scope["method"].lower()
            self._audit.record(action, user=user.name, address=address, vehicle=vehicle, detail=detail)
        except StommelError:
            logging.getLogger("stommel.station").exception("not in the audit log: %s %s", user.name, detail)


def _shown(body: bytes) -> Any:
    """A body without its secrets."""
    if len(body) > _LARGEST:
        return f"{len(body)} bytes"
    try:
        content = json.loads(body)
    except (ValueError, RecursionError):
        return f"{len(body)} bytes"
    if isinstance(content, dict):
        return {key: "***" if SECRET & set(key.casefold().split("_")) else value for key, value in content.items()}
    return content
