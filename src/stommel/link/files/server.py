"""Files of the vehicle: given, taken, and deleted when they are whole ashore."""

from collections import deque

from stommel.link.files.digests import Digests
from stommel.link.files.ftp_server import FtpServer
from stommel.link.files.paths import file_path, shown
from stommel.link.files.port import FilePort, FileRefusalError, FileResult, FtpError, Path
from stommel.link.files.receiving import Receiving
from stommel.link.files.sending import Peer, Sender, Transfer
from stommel.link.outbox import Outbox, Priority
from stommel.link.service import Received, is_for
from stommel.link.traffic import Traffic
from stommel.link.values import octets, text, whole
from stommel.link.words import fitted
from stommel.messages.mavlink import FieldValue

MOST_REASON = 100
_MOST_SIZE = 0xFFFFFFFF
_MOST_WAITING = 32
_ROOM = 255


class FileServer:
    """The service aboard: MAVLink FTP, and our own messages FILE_*.

    Parameters
    ----------
    system, component
        Who answers.
    port
        The files.
    traffic
        Counts of this end; None: nobody asks.
    """

    def __init__(self, system: int, component: int, port: FilePort, traffic: Traffic | None = None) -> None:
        self._system, self._component, self._port = system, component, port
        self._ftp = FtpServer(system, component, port)
        self._sender, self._receiving, self._digests = (
            Sender(component, traffic),
            Receiving(port, traffic),
            Digests(port),
        )
        self._answers: deque[tuple[str, dict[str, FieldValue]]] = deque(maxlen=_MOST_WAITING)
        self._take = {
            "FILE_OPEN": self._open,
            "FILE_REQUEST": self._request,
            "FILE_DATA": self._receiving.data,
            "FILE_OFFER": self._receiving.offer,
            "FILE_RELEASE": self._release,
        }

    def take(self, received: Received, t: float) -> None:
        """Take a message at a time [s]."""
        self._ftp.take(received, t)
        take = self._take.get(received.name)
        if take is not None and is_for(received, self._system, self._component):
            take(received, t)

    def poll(self, t: float, outbox: Outbox) -> None:
        """Say what is due, and send as there is room."""
        self._ftp.poll(t, outbox)
        self._digests.work()
        self._receiving.poll(t, outbox)
        for (peer, transfer), (result, reason) in self._receiving.outcomes:
            self._answer_outcome(peer, transfer, result, reason)
        self._receiving.outcomes.clear()
        self._sender.poll(t, outbox)
        for peer, transfer, size, error in self._sender.broken:
            self._answer_identity(peer, transfer, error.result, size, reason=str(error))
        self._sender.broken.clear()
        while self._answers and outbox.room(Priority.COMMAND) >= _ROOM:
            outbox.put(Priority.COMMAND, *self._answers.popleft(), self._component)

    # the shore fetches

    def _open(self, received: Received, t: float) -> None:
        peer, number = _who(received)
        length = whole(received.values, "length")
        self._sender.forget_requests(peer, number)
        if (peer, number) in self._digests:
            return  # asked again while it is being summed
        try:
            path = file_path(text(received.values, "path"))
            there = min(self._port.size(path), _MOST_SIZE - 1)
            if length != _MOST_SIZE and length > there:
                reason = f"{shown(path)}: has {there} bytes, {length} were asked for"
                raise FileRefusalError(FtpError.END_OF_FILE, reason)  # noqa: TRY301
            size = min(length, there)
            self._digests.begin(
                (peer, number), path, size, lambda found: self._opened(peer, number, path, size, found, t)
            )
        except FileRefusalError as error:
            self._answer_identity(peer, number, error.result, 0, reason=str(error))

    def _opened(
        self, peer: Peer, number: int, path: Path, size: int, found: bytes | FileRefusalError, t: float
    ) -> None:
        if isinstance(found, FileRefusalError):
            self._answer_identity(peer, number, found.result, 0, reason=str(found))
            return
        transfer = Transfer(size, lambda offset, length: self._port.read(path, offset, length), path)
        self._sender.begin(peer, number, transfer, t)
        self._answer_identity(peer, number, FileResult.OK, size, sha256=found)

    def _request(self, received: Received, t: float) -> None:
        if not self._sender.request(received, t):
            peer, number = _who(received)
            self._answer_identity(peer, number, FileResult.UNKNOWN, 0, reason="open it again")

    def _answer_identity(
        self, peer: Peer, transfer: int, result: FileResult, size: int, *, sha256: bytes = b"", reason: str = ""
    ) -> None:
        self._answer("FILE_IDENTITY", peer, transfer, {"result": result, "size": size, "sha256": sha256}, reason)

    def _answer_outcome(self, peer: Peer, transfer: int, result: FileResult, reason: str = "") -> None:
        self._answer("FILE_OUTCOME", peer, transfer, {"result": result}, reason)

    def _answer(self, name: str, peer: Peer, transfer: int, values: dict[str, FieldValue], reason: str) -> None:
        system, component = peer
        address: dict[str, FieldValue] = {
            "target_system": system, "target_component": component, "transfer": transfer,
            "reason": fitted(reason, MOST_REASON),
        }  # fmt: skip
        self._answers.append((name, address | values))

    # the shore has it whole

    def _release(self, received: Received, _t: float) -> None:
        peer, number = _who(received)
        sha256, size = octets(received.values, "sha256"), whole(received.values, "size")
        key = (peer, number, "release")
        if key in self._digests:
            return
        try:
            path = file_path(text(received.values, "path"))
            there = self._port.size(path)
            if there != size:
                self._answer_outcome(peer, number, FileResult.CHANGED, f"has {there} bytes, not {size}: not deleted")
                return
            self._digests.begin(key, path, size, lambda found: self._release_if_same(peer, number, path, sha256, found))
        except FileRefusalError as error:
            self._answer_outcome(peer, number, error.result, str(error))

    def _release_if_same(
        self, peer: Peer, number: int, path: Path, sha256: bytes, found: bytes | FileRefusalError
    ) -> None:
        try:
            if isinstance(found, FileRefusalError):
                raise found
            if found != sha256:
                self._answer_outcome(peer, number, FileResult.CHANGED, f"{shown(path)}: another SHA-256: not deleted")
                return
            self._port.release(path)
        except FileRefusalError as error:
            self._answer_outcome(peer, number, error.result, str(error))
            return
        self._answer_outcome(peer, number, FileResult.OK)


def _who(received: Received) -> tuple[Peer, int]:
    return (received.system, received.component), whole(received.values, "transfer")
