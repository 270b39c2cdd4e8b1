"""The edge: frames to and from a CAN adapter, which may fail at any time and is opened again by itself.

python-can lets the error of a driver end the thread that receives, and the program goes on deaf
(hardbyte/python-can#907, #1667). Here one thread owns the adapter and survives every error: it closes the adapter, says
what happened, and tries to open it again twice a second.
"""

import time
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from threading import Event, Lock, Thread
from types import TracebackType
from typing import TYPE_CHECKING, NamedTuple, Self

from stommel.errors import one_line
from stommel.messages.adapters import Adapter, open_adapter
from stommel.messages.frames import Frame

if TYPE_CHECKING:
    from can import BusABC, Message

WAIT = 0.1
"""The longest that one look at the adapter takes [s]."""
RETRY = 0.5
"""Between two tries to open it again [s]."""
HUNG = 0.8
"""Without a sign of the thread, after which the driver is said to hang [s]."""
SEND_WAIT = 0.02
"""The longest that sending waits for room in the adapter [s]."""
MOST = 20_000
"""Frames that wait for `receive`; the oldest go first. Two seconds of a full bus of 1 Mbit/s."""

ECHO = 1.0
"""The longest that a frame of our own takes to come back over multicast [s]."""

_ERROR_CLASSES = {
    0x040: "bus-off",
    0x020: "no acknowledgement: no other node listens",
    0x080: "bus error",
    0x008: "protocol violation",
    0x010: "transceiver fault",
    0x004: "controller problem",
    0x001: "transmission timed out",
}
"""Classes of SocketCAN's error frames (linux/can/error.h), the gravest first."""
_RESTARTED = 0x100


class BusStatus(NamedTuple):
    """How the bus does, and what was counted since it was opened."""

    fault: str
    """What is wrong; empty where nothing is."""
    since: float
    """Since when that is so, by the clock of the bus [s]."""
    received: int
    sent: int
    unsent: int
    """Frames that could not be sent."""
    passed_over: int
    """Frames that are none of ours: extended, remote or FD."""
    dropped: int
    """Frames that nobody fetched in time."""
    faults: int
    reopened: int


class CanBus:
    """A CAN adapter that is opened again whenever it fails.

    Opening it the first time raises a `BusError`; later failures do not raise: `status` and `reports` tell them, within
    a second.
    """

    def __init__(
        self,
        adapter: Adapter,
        opener: Callable[[Adapter], "BusABC"] = open_adapter,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._description, self._opener, self._clock = adapter, opener, clock
        self._port: BusABC | None = opener(adapter)
        self._lock, self._stop = Lock(), Event()
        self._waiting: deque[Frame] = deque(maxlen=MOST)
        self._reports: deque[str] = deque(maxlen=100)
        self._echoes: deque[tuple[Frame, float]] = deque(maxlen=MOST)
        self._echoing = adapter.interface == "udp_multicast"
        self._fault, self._since, self._alive = "", clock(), clock()
        self._counts = dict.fromkeys(("received", "sent", "unsent", "passed_over", "dropped", "faults", "reopened"), 0)
        self._thread = Thread(target=self._run, name=f"CAN {adapter}", daemon=True)
        self._thread.start()

    def send(self, frame: Frame) -> bool:
        """Send a frame; return whether the adapter took it."""
        from can import Message  # noqa: PLC0415 - only programs on real ports need it

        port = self._port
        if port is None:
            self._count("unsent")
            return False
        try:
            message = Message(arbitration_id=frame.identifier, data=frame.data, is_extended_id=False)
            if self._echoing:
                with self._lock:
                    self._echoes.append((frame, self._clock()))
            port.send(message, timeout=SEND_WAIT)
        except Exception as error:  # noqa: BLE001 - drivers' errors come as they are
            self._fail(port, f"sending failed: {_words(error)}")
            self._count("unsent")
            return False
        self._count("sent")
        return True

    def receive(self) -> list[Frame]:
        """Return the frames that came since this was last asked, in order."""
        with self._lock:
            frames = list(self._waiting)
            self._waiting.clear()
        return frames

    def status(self) -> BusStatus:
        """Return how the bus does."""
        with self._lock:
            fault, since, alive = self._fault, self._since, self._alive
            counts = dict(self._counts)
        if not fault and self._clock() - alive > HUNG:
            fault, since = "the driver of the adapter hangs", alive
        return BusStatus(fault, since, **counts)

    def reports(self) -> list[str]:
        """Return sentences about what failed and what works again, since this was last asked."""
        with self._lock:
            reports = list(self._reports)
            self._reports.clear()
        return reports

    def close(self) -> None:
        """Close the adapter."""
        self._stop.set()
        self._thread.join(2.0)
        port, self._port = self._port, None
        _shut(port)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _count(self, what: str) -> None:
        with self._lock:
            self._counts[what] += 1

    def _run(self) -> None:
        while not self._stop.is_set():
            with self._lock:
                self._alive = self._clock()
            port = self._port
            if port is None:
                self._reopen()
                continue
            try:
                message = port.recv(WAIT)
                if message is not None:
                    self._hear(message)
                if port.state.name == "ERROR":
                    self._fail(port, "bus-off")
            except Exception as error:  # noqa: BLE001 - this thread survives every error
                self._fail(port, f"receiving failed: {_words(error)}")

    def _reopen(self) -> None:
        if self._stop.wait(RETRY):
            return
        try:
            port = self._opener(self._description)
        except Exception as error:  # noqa: BLE001 - as above
            self._tell(_words(error))
            return
        self._port = port
        self._count("reopened")
        self._mend()

    def _hear(self, message: "Message") -> None:
        if message.is_error_frame:
            self._hear_error(message.arbitration_id)
        elif message.is_extended_id or message.is_remote_frame or message.is_fd:
            self._count("passed_over")
        else:
            self._mend()
            frame = Frame(message.arbitration_id, bytes(message.data))
            with self._lock:
                if self._echoing and self._is_echo(frame):
                    return
                self._counts["received"] += 1
                self._counts["dropped"] += len(self._waiting) == MOST
                self._waiting.append(frame)

    def _is_echo(self, frame: Frame) -> bool:
        """Whether it is our own, which multicast gives back and a CAN bus does not."""
        oldest = self._clock() - ECHO
        while self._echoes and self._echoes[0][1] < oldest:
            self._echoes.popleft()
        for sent in self._echoes:
            if sent[0] == frame:
                self._echoes.remove(sent)
                return True
        return False

    def _hear_error(self, bits: int) -> None:
        """An error frame of SocketCAN; the controller stays open, and the kernel restarts it where it is told to."""
        if bits & _RESTARTED:
            self._mend()
        for bit, words in _ERROR_CLASSES.items():
            if bits & bit:
                self._tell(words)
                return

    def _fail(self, port: "BusABC", words: str) -> None:
        """Give an adapter up, once, whichever thread found it failing."""
        with self._lock:
            if self._port is not port:
                return
            self._port = None
        self._tell(words)
        _shut(port)

    def _tell(self, words: str) -> None:
        with self._lock:
            if words == self._fault:
                return
            if not self._fault:
                self._counts["faults"] += 1
                self._since = self._clock()
            self._fault = words
            self._reports.append(f"CAN bus {self._description}: {words}")

    def _mend(self) -> None:
        with self._lock:
            if not self._fault:
                return
            now = self._clock()
            self._reports.append(f"CAN bus {self._description}: works again after {now - self._since:.1f} s")
            self._fault, self._since = "", now


def _shut(port: "BusABC | None") -> None:
    if port is not None:
        with suppress(Exception):  # what is broken may not be closed either
            port.shutdown()


def _words(error: Exception) -> str:
    return one_line(str(error) or type(error).__name__, 200)
