"""A vehicle that says what a test wants, over TCP, and keeps what it hears."""

import socket
from collections.abc import Iterator
from contextlib import contextmanager

from stommel.link.frames import FrameSplitter, RawFrame, frame_bytes
from stommel.messages.mavlink import Fields, message_named
from tests.support.waiting import WITHIN, until

__all__ = ["Speaker", "speaker", "until"]

_ESTABLISHED = 1
"""State of a TCP connection of which both ends are open, as Linux numbers it."""


class Speaker:
    """Waits for the station to connect, and speaks."""

    def __init__(self, system: int = 1) -> None:
        self.system, self.sequence = system, 0
        self._listening = socket.create_server(("127.0.0.1", 0))
        self._place: tuple[str, int] = self._listening.getsockname()
        self._socket: socket.socket | None = None
        self._splitter = FrameSplitter()
        self.heard: list[RawFrame] = []
        self.sent: list[bytes] = []

    @property
    def address(self) -> str:
        """As the station wants it."""
        return f"tcp:127.0.0.1:{self._listening.getsockname()[1]}"

    def connect(self) -> None:
        """Wait for the station; what a station that was killed has left behind in the queue is no connection."""
        self._listening.settimeout(WITHIN)
        while True:
            accepted, _ = self._listening.accept()
            if accepted.getsockopt(socket.IPPROTO_TCP, socket.TCP_INFO, 1)[0] == _ESTABLISHED:
                break
            accepted.close()
        self._socket = accepted
        self._socket.setblocking(False)

    def hang_up(self) -> None:
        """Lose the connection."""
        if self._socket is not None:
            self._socket.close()
            self._socket = None

    def leave(self) -> None:
        """Lose the connection, and let nobody connect."""
        self.hang_up()
        self._listening.close()

    def come_back(self) -> None:
        """Let the station connect again, where it did before."""
        self._listening = socket.create_server(self._place)
        self.connect()

    def frame(self, name: str, values: Fields, component: int = 1) -> bytes:
        """The next frame."""
        kind = message_named(name)
        frame = frame_bytes(kind, kind.pack(values), self.system, component, self.sequence % 256)
        self.sequence += 1
        return frame

    def say(self, name: str, **values: object) -> None:
        """Say a message."""
        frame = self.frame(name, values)  # type: ignore[arg-type]
        self.sent.append(frame)
        self.send(frame)

    def send(self, data: bytes) -> None:
        """Send bytes."""
        assert self._socket is not None
        self._socket.setblocking(True)
        self._socket.sendall(data)
        self._socket.setblocking(False)

    def listen(self) -> list[RawFrame]:
        """Everything that was heard until now."""
        assert self._socket is not None
        try:
            while data := self._socket.recv(65_536):
                self.heard += self._splitter.take(data)
        except BlockingIOError:
            pass
        return self.heard

    def names(self) -> list[str]:
        """Names of what was heard."""
        return [frame.message.name for frame in self.listen()]

    def close(self) -> None:
        """Go."""
        self.hang_up()
        self._listening.close()


@contextmanager
def speaker(system: int = 1) -> Iterator[Speaker]:
    """A vehicle until the block ends."""
    found = Speaker(system)
    try:
        yield found
    finally:
        found.close()
