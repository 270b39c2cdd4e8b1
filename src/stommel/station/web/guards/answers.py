"""Answers of what stands before the routes."""

from starlette.responses import JSONResponse
from starlette.types import Receive, Scope, Send

from stommel.station.web.errors import detail_of


async def refuse(scope: Scope, receive: Receive, send: Send, status: int, reason: str) -> None:
    """Answer with a sentence; a socket is not opened."""
    if scope["type"] == "websocket":
        await receive()
        await send({"type": "websocket.close", "code": 1008, "reason": reason[:120]})
        return
    await JSONResponse(detail_of(reason), status)(scope, receive, send)
