"""Sends the ranges of files that the other end asks for, in the order in which it asked."""

from collections import deque
from collections.abc import Callable
from typing import NamedTuple

from stommel.link.files.loss import MOST_SEGMENT, SHORT_EVERY
from stommel.link.files.port import FileRefusalError, FtpError
from stommel.link.files.ranges import Range, Ranges
from stommel.link.files.request_words import PROBE, unpacked_ranges
from stommel.link.outbox import Outbox, Priority
from stommel.link.service import Received
from stommel.link.traffic import Traffic
from stommel.link.values import octets, whole

MOST_TRANSFERS = 8
FORGOTTEN = 900.0
"""A transfer of which nothing was heard for so long is over [s]."""
SILENCE = 20.0
"""Who was not heard for so long is not sent to until heard again [s]."""
_MOST_WAITING = 4096
"""Ranges of a transfer that wait; more are not taken, and will be asked for again."""
_REMEMBERED = 128
"""Serials that are not obeyed again; half of all that there are."""
_ROOM = 255

Reader = Callable[[int, int], bytes]
"""Bytes from a place on, so many; may raise FileRefusalError."""
Peer = tuple[int, int]


class Broken(NamedTuple):
    """A transfer that cannot go on."""

    peer: Peer
    transfer: int
    size: int
    error: FileRefusalError


class Transfer:
    """What the other end still waits for of one file.

    Parameters
    ----------
    size
        Bytes that there are.
    read
        Reads them.
    of
        Which file it is of; a transfer of the same one is not begun again.
    """

    def __init__(self, size: int, read: Reader, of: object = None) -> None:
        self.size, self._read, self.of = size, read, of
        self._waiting: deque[tuple[int, Range]] = deque()
        self._obeyed: deque[int] = deque(maxlen=_REMEMBERED)
        self._number = self._echo = 0
        self._epoch: int | None = None
        self._segment, self._probe = MOST_SEGMENT, False
        self.heard = float("-inf")
        self._sent = Ranges()

    def request(self, values: dict[str, int], packed: bytes, t: float) -> None:
        """Take a request at a time [s]; one that comes again is not obeyed again."""
        self.heard = t
        if self._epoch is not None and values["epoch"] == (self._epoch - 1) % 256:
            return  # a late one
        if values["epoch"] != self._epoch:
            self.forget_requests()
            self._epoch = values["epoch"]
        serial = values["serial"]
        if serial in self._obeyed:
            return
        self._segment = min(max(values["segment"], 1), MOST_SEGMENT)
        self._probe = bool(values["flags"] & PROBE)
        self._obeyed.append(serial)
        self._echo = serial
        for first, last in unpacked_ranges(values["base"], values["count"], packed):
            if last <= self.size and len(self._waiting) < _MOST_WAITING:
                self._waiting.append((serial, Range(first, last)))

    def forget_requests(self) -> None:
        """Nothing was asked for."""
        self._epoch = None
        self._waiting.clear()
        self._obeyed.clear()

    def is_ready(self, t: float) -> bool:
        """Whether there is something to send to somebody who listens."""
        return bool(self._waiting) and t - self.heard < SILENCE

    def next(self, transfer: int) -> dict[str, int | bytes]:
        """Return the fields of the next FILE_DATA.

        Raises
        ------
        FileRefusalError
            The file cannot be read, or has become shorter.
        """
        serial, (first, last) = self._waiting.popleft()
        segment = self._segment
        if self._probe and self._number % SHORT_EVERY == 0:
            segment = max(segment // 2, 1)
        end = min(first + segment, last)
        data = self._read(first, end - first)
        if len(data) != end - first:
            raise short_file(self.size, first + len(data))
        if end < last:
            self._waiting.appendleft((serial, Range(end, last)))
        values: dict[str, int | bytes] = {
            "transfer": transfer, "offset": first, "number": self._number, "serial": serial, "echo": self._echo,
            "length": len(data), "data": data,
        }  # fmt: skip
        self._number = (self._number + 1) & 0xFFFF
        return values

    def note_sent(self, values: dict[str, int | bytes], traffic: Traffic) -> None:
        """Count what was sent, and what of it was sent before."""
        first, length = values["offset"], values["length"]
        assert isinstance(first, int)
        assert isinstance(length, int)
        new = self._sent.add(first, first + length)
        traffic.sent(new)
        traffic.sent(length - new, again=True)


class Sender:
    """The transfers of one end, of which each gets its turn.

    Parameters
    ----------
    component
        Who sends; None: the end's own.
    traffic
        Counts of this end; None: nobody asks.
    """

    def __init__(self, component: int | None = None, traffic: Traffic | None = None) -> None:
        self._component = component
        self._traffic = Traffic() if traffic is None else traffic
        self._transfers: dict[tuple[Peer, int], Transfer] = {}
        self.broken: list[Broken] = []
        """Transfers that ended because their file cannot be read; whoever looks takes them out."""

    def begin(self, peer: Peer, number: int, transfer: Transfer, t: float) -> None:
        """Begin a transfer; the one that was silent longest gives way. The same one goes on."""
        there = self._transfers.get((peer, number))
        if there is not None and there.of == transfer.of and there.size == transfer.size:
            there.heard = t
            return
        transfer.heard = t
        self._transfers.pop((peer, number), None)
        while len(self._transfers) >= MOST_TRANSFERS:
            del self._transfers[min(self._transfers, key=lambda key: self._transfers[key].heard)]
        self._transfers[peer, number] = transfer

    def forget_requests(self, peer: Peer, number: int) -> None:
        """Send nothing more of a transfer until it is asked for anew: the other end may have been away."""
        if (peer, number) in self._transfers:
            self._transfers[peer, number].forget_requests()

    def request(self, received: Received, t: float) -> bool:
        """Take FILE_REQUEST at a time [s]; False if there is no such transfer."""
        values = received.values
        key = ((received.system, received.component), whole(received.values, "transfer"))
        transfer = self._transfers.get(key)
        if transfer is None:
            return False
        numbers = {name: int(value) for name, value in values.items() if isinstance(value, int)}
        transfer.request(numbers, octets(received.values, "ranges"), t)
        return True

    def poll(self, t: float, outbox: Outbox) -> None:
        """Send segments while there is room."""
        for key, transfer in tuple(self._transfers.items()):
            if t - transfer.heard > FORGOTTEN:
                del self._transfers[key]
            elif transfer.is_ready(t) and outbox.room(Priority.DATA) >= _ROOM:
                self._send(key, transfer, outbox)

    def _send(self, key: tuple[Peer, int], transfer: Transfer, outbox: Outbox) -> None:
        peer, number = key
        try:
            values = transfer.next(number)
        except FileRefusalError as error:
            del self._transfers[key]
            self.broken.append(Broken(peer, number, transfer.size, error))
            return
        outbox.put(Priority.DATA, "FILE_DATA", values, self._component)
        transfer.note_sent(values, self._traffic)
        self._transfers[key] = self._transfers.pop(key)


def short_file(size: int, end: int) -> FileRefusalError:
    """The refusal of a file that has become shorter."""
    return FileRefusalError(FtpError.END_OF_FILE, f"the file had {size} bytes, and ends at {end} now")
