"""A file to the other end: offered, sent as it is asked for, whole when the other end says so."""

import hashlib

from stommel.link.files.asking import PATIENCE, Asking
from stommel.link.files.paths import file_path
from stommel.link.files.port import FileRefusalError, FileResult
from stommel.link.files.progress import Progress, State
from stommel.link.files.ranges import Ranges
from stommel.link.files.request_words import transfer_number
from stommel.link.files.sending import Sender, Transfer
from stommel.link.outbox import Outbox, Priority
from stommel.link.service import Received, is_for
from stommel.link.timing import RetransmissionTimer
from stommel.link.traffic import Traffic
from stommel.link.values import text, whole

_ROOM = 255
_QUIET = 3.0
"""While segments are asked for, the offer is not repeated; silence after which it is [s]."""


class Upload:
    """Offers one file; a service of the shore's session.

    The other end keeps what has come, so that an upload that is begun again, also by another program, goes on.

    Parameters
    ----------
    own, peer
        System and component of this end, and of the one that shall have the file.
    content
        The file.
    path
        Where it shall stand at the other end.
    patience
        Time without an answer after which it has failed [s], not counting pauses; None: never.
    timer
        What is known of the round trip already.
    traffic
        Counts of this end; None: nobody asks.
    """

    def __init__(
        self,
        own: tuple[int, int],
        peer: tuple[int, int],
        content: bytes,
        path: str,
        *,
        patience: float | None = PATIENCE,
        timer: RetransmissionTimer | None = None,
        traffic: Traffic | None = None,
    ) -> None:
        self._own, self._peer, self.path = own, peer, path
        self._content, self._sha256 = content, hashlib.sha256(content).digest()
        self.transfer = transfer_number("upload", own, path)
        self._asking = Asking(timer, patience)
        self._sender = Sender(traffic=traffic)
        self._sent = Ranges()
        self._heard = float("-inf")
        self._begun = False
        self.state, self.reason = State.OFFERING, ""
        self.is_paused = False
        try:
            file_path(path)
        except FileRefusalError as error:  # what no message can name need not be offered
            self.state, self.reason = State.REFUSED, str(error)

    @property
    def progress(self) -> Progress:
        """How far it is; what was sent may yet be lost, so that it goes to 1 only when the other end says so."""
        done = len(self._content) if self.state is State.WHOLE else self._sent.bytes
        return Progress(self.state, self.is_paused, self.reason, done, len(self._content), 0.0, None, 0, 0.0)

    def pause(self) -> None:
        """Say nothing more until `resume`."""
        self.is_paused = True

    def resume(self, t: float) -> None:
        """Go on: the next poll offers."""
        self.is_paused = False
        self._heard = float("-inf")
        self._asking.start(t)

    def take(self, received: Received, t: float) -> None:
        """Take a message at a time [s]."""
        if received.system != self._peer[0] or self.state.is_over or self.is_paused:
            return
        self._asking.heard(t)
        if received.values.get("transfer") != self.transfer or not is_for(received, *self._own):
            return
        if received.name == "FILE_REQUEST":
            self._request(received, t)
        elif received.name == "FILE_OUTCOME":
            self._end_or_offer(FileResult(whole(received.values, "result")), text(received.values, "reason"), t)

    def _end_or_offer(self, result: FileResult, reason: str, t: float) -> None:
        if result is FileResult.UNKNOWN:
            if self._heard > float("-inf"):
                self.resume(t)
                self._sender.forget_requests(self._peer, self.transfer)
        elif result is FileResult.OK:
            self.state, self.reason = State.WHOLE, ""
        elif result is not FileResult.NO_ROOM:  # room may come
            self.state, self.reason = State.REFUSED, reason or result.name

    def _request(self, received: Received, t: float) -> None:
        if self._heard == float("-inf"):
            self._asking.answered(t)
        self._heard = t
        self._asking.goes_on(t)
        if not self._sender.request(received, t):
            transfer = Transfer(len(self._content), self._read, self.path)
            self._sender.begin((received.system, received.component), self.transfer, transfer, t)
            self._sender.request(received, t)

    def _read(self, offset: int, length: int) -> bytes:
        self._sent.add(offset, offset + length)
        return self._content[offset : offset + length]

    def poll(self, t: float, outbox: Outbox) -> None:
        """Say what is due at a time [s]."""
        if self.state.is_over or self.is_paused:
            return
        if self._asking.is_hopeless(t):
            self.state = State.FAILED
            self.reason = f"{self.path}: no answer for {self._asking.patience:.0f} s"
            return
        self._sender.poll(t, outbox)
        quiet = t - self._heard > max(_QUIET, 2.0 * self._asking.timer.time_out)
        if quiet and self._asking.is_due(t) and outbox.room(Priority.COMMAND) >= _ROOM:
            system, component = self._peer
            outbox.put(
                Priority.COMMAND,
                "FILE_OFFER",
                {
                    "target_system": system, "target_component": component, "transfer": self.transfer,
                    "size": len(self._content), "sha256": self._sha256, "path": self.path,
                },
            )  # fmt: skip
            self._asking.asked(t)
