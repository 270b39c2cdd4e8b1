"""Where a reader in an event loop waits for what other threads bring; nobody who brings ever waits."""

import asyncio
from threading import Lock
from types import TracebackType
from typing import Any, Self

Message = dict[str, Any]


class Mailbox:
    """Messages for one reader; what it holds is bounded by whoever derives from it.

    Parameters
    ----------
    pause
        Shortest time between two messages [s].
    """

    def __init__(self, pause: float = 0.0) -> None:
        self._lock = Lock()
        self._pause, self._next_at = pause, 0.0
        self._loop: asyncio.AbstractEventLoop | None = None
        self._rung: asyncio.Event | None = None
        self._has_rung = False
        self._is_closed = False

    def collect(self) -> Message | None:
        """Take the next message out; None if there is none. Called in the reader's loop."""
        raise NotImplementedError

    def ring(self) -> None:
        """Wake the reader; from any thread."""
        with self._lock:
            if self._has_rung:
                return
            self._has_rung = True
            loop, rung = self._loop, self._rung
        if loop is not None and rung is not None:
            try:
                loop.call_soon_threadsafe(rung.set)
            except RuntimeError:  # the loop has ended, and its reader with it
                self._is_closed = True

    def close(self) -> None:
        """No more of them."""
        self._is_closed = True
        with self._lock:
            self._has_rung = False
        self.ring()

    @property
    def is_closed(self) -> bool:
        """Whether nobody reads any more."""
        return self._is_closed

    def __aiter__(self) -> Self:
        return self

    async def __anext__(self) -> Message:
        loop = asyncio.get_running_loop()
        with self._lock:
            if self._loop is None:
                self._loop, self._rung = loop, asyncio.Event()
        assert self._rung is not None
        while not self._is_closed:
            wait = self._next_at - loop.time()
            if wait > 0.0:
                await asyncio.sleep(wait)
            self._rung.clear()
            with self._lock:
                self._has_rung = False
            message = self.collect()
            if message is not None:
                self._next_at = loop.time() + self._pause
                return message
            await self._rung.wait()
        raise StopAsyncIteration

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()
