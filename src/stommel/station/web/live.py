"""The live socket: what changes aboard, as it comes."""

import time

from fastapi import APIRouter, WebSocket

router = APIRouter(prefix="/api")


@router.websocket("/live")
async def live(socket: WebSocket) -> None:
    """Serve one browser until it goes."""
    await socket.accept()
    await socket.send_json({"type": "hello", "now": time.time(), "vehicles": []})
    await socket.close()
