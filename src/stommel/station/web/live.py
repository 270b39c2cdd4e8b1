"""The live socket: what changes aboard, as it comes. A browser that is slow skips; one bad subscription ends alone."""

import asyncio
import json
import logging
import time
from collections.abc import Callable, Coroutine, Mapping
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from fastapi import APIRouter, HTTPException, WebSocket, WebSocketDisconnect
from starlette.concurrency import run_in_threadpool

from stommel.errors import StommelError
from stommel.station.web.access import Viewer, somebody
from stommel.station.web.finite import finite
from stommel.station.web.live_messages import LONGEST_ID, LiveRequest, Subscribe, Unsubscribe

if TYPE_CHECKING:
    from stommel.station.live.hub import Hub
    from stommel.station.live.subscription import Subscription

router = APIRouter(prefix="/api")
"""Of one subscription."""
PING_EVERY = 15.0
"""Seconds; as often it is looked whether the person may still look."""
MOST_SUBSCRIPTIONS = 100
"""Of one socket."""
SLOWEST = 60.0
"""Seconds that a browser may take for one message before the socket is closed."""
_LARGEST = 65_536


@router.websocket("/live")
async def live(socket: WebSocket, _user: Viewer) -> None:
    """Serve one browser until it goes."""
    await socket.accept()
    reader = _Reader(socket)
    try:
        await reader.serve()
    except (WebSocketDisconnect, OSError, TimeoutError):
        pass
    finally:
        reader.close()


class _Reader:
    """One browser and what it has asked for."""

    def __init__(self, socket: WebSocket) -> None:
        self._socket = socket
        self._station = socket.app.state.station
        self._hub: Hub = self._station.hub
        self._sending = asyncio.Lock()
        self._open: dict[str, tuple[Subscription, asyncio.Task[None]]] = {}
        self._tasks: set[asyncio.Task[None]] = set()

    async def serve(self) -> None:
        """Greet, then hand on news and answer what is asked."""
        news = self._hub.watch()
        try:
            await self._send(
                {"type": "hello", "now": time.time(), "vehicles": await run_in_threadpool(self._summaries)}
            )
            self._start(lambda: self._hand_on(None, news))
            self._start(self._ping)
            while True:
                message = await self._socket.receive()
                if message["type"] == "websocket.disconnect":
                    return
                await self._answer(message.get("text") or message.get("bytes") or "")
        finally:
            news.close()

    def _summaries(self) -> list[Mapping[str, Any]]:
        return [self._station.summary(vehicle) for vehicle in list(self._station.vehicles)]

    def close(self) -> None:
        """Let go of everything."""
        for subscription, _ in self._open.values():
            subscription.close()
        for task in self._tasks:
            task.cancel()

    async def _answer(self, text: str | bytes) -> None:
        identity = ""
        if len(text) > _LARGEST:
            await self._object(identity, f"a message has at most {_LARGEST} bytes")
            return
        try:
            document = json.loads(text)
            identity = str(document.get("id", ""))[:LONGEST_ID] if isinstance(document, dict) else ""
            self._do(LiveRequest.model_validate(document).root)
        except (ValueError, RecursionError):
            await self._object(identity, "this message is neither subscribe nor unsubscribe as the guide shows them")
        except StommelError as error:
            await self._object(identity, str(error))

    def _do(self, asked: Subscribe | Unsubscribe) -> None:
        known = self._open.pop(asked.id, None)
        if known is not None:
            known[0].close()
            known[1].cancel()
        if isinstance(asked, Unsubscribe):
            return
        if len(self._open) >= MOST_SUBSCRIPTIONS:
            raise StommelError(f"a page has at most {MOST_SUBSCRIPTIONS} subscriptions")
        subscription = self._hub.subscribe(asked.id, asked.vehicle, asked.channels, asked.every)
        self._open[asked.id] = subscription, self._start(lambda: self._hand_on(asked.id, subscription))

    async def _hand_on(self, identity: str | None, subscription: "Subscription") -> None:
        """Hand on what comes; whatever fails ends this subscription only."""
        try:
            async for message in subscription:
                await self._send(message)
            reason = f"there is nothing more of vehicle {getattr(subscription, 'vehicle', '')}"
        except (WebSocketDisconnect, OSError, TimeoutError):
            return
        except Exception:
            logging.getLogger("stommel.station").exception("a subscription failed")
            reason = "this subscription failed; the station's log says more. The others go on"
        subscription.close()
        if identity is None:
            await self._socket.close(1011)
        elif self._open.get(identity, (None,))[0] is subscription:
            del self._open[identity]
            await self._object(identity, reason)

    async def _ping(self) -> None:
        """Show that the line stands, and look whether the person may still look."""
        while True:
            await asyncio.sleep(PING_EVERY)
            try:
                user = await run_in_threadpool(somebody, self._socket)
            except StommelError:  # an archive that is busy throws nobody out
                continue
            except HTTPException:
                user = None
            if user is None:
                await self._socket.close(4401, "log in again")
                return
            await self._send({"type": "ping"})

    async def _object(self, identity: str, reason: str) -> None:
        await self._send({"type": "error", "id": identity, "reason": reason})

    async def _send(self, message: Mapping[str, Any]) -> None:
        text = json.dumps(finite(message), allow_nan=False, separators=(",", ":"))
        async with self._sending:
            try:
                await asyncio.wait_for(self._socket.send_text(text), SLOWEST)
            except (RuntimeError, TimeoutError) as error:  # closed meanwhile, or nobody reads
                with suppress(RuntimeError):
                    await self._socket.close(1013)
                raise WebSocketDisconnect from error

    def _start(self, work: Callable[[], Coroutine[Any, Any, None]]) -> asyncio.Task[None]:
        task: asyncio.Task[None] = asyncio.create_task(_quietly(work))
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
        return task


async def _quietly(work: Callable[[], Coroutine[Any, Any, None]]) -> None:
    """A browser that has gone is no news; one that goes at once leaves nothing begun."""
    with suppress(WebSocketDisconnect, OSError, TimeoutError, RuntimeError):
        await work()
