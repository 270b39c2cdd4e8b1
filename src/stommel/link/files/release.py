"""Tells the vehicle that a file is whole ashore and may be deleted aboard."""

from stommel.link.files.asking import PATIENCE, Asking
from stommel.link.files.port import FileResult
from stommel.link.files.progress import State
from stommel.link.files.received_file import Identity
from stommel.link.files.request_words import transfer_number
from stommel.link.outbox import Outbox, Priority
from stommel.link.service import Received, is_for
from stommel.link.timing import RetransmissionTimer
from stommel.link.values import text, whole

_ROOM = 255


class Release:
    """Releases one file; a service of the shore's session. The vehicle deletes it only if size and SHA-256 are its own.

    Parameters
    ----------
    own, peer
        System and component of this end, and of the one that has the file.
    identity
        What was received whole.
    """

    def __init__(
        self,
        own: tuple[int, int],
        peer: tuple[int, int],
        identity: Identity,
        *,
        patience: float | None = PATIENCE,
        timer: RetransmissionTimer | None = None,
    ) -> None:
        self._own, self._peer, self._identity = own, peer, identity
        self.transfer = transfer_number("release", own, identity.path)
        self._asking = Asking(timer, patience)
        self.state, self.reason = State.OFFERING, ""
        self._said = 0

    def take(self, received: Received, t: float) -> None:
        """Take a message at a time [s]."""
        if received.system != self._peer[0] or self.state.is_over:
            return
        self._asking.heard(t)
        values = received.values
        if received.name != "FILE_OUTCOME" or values["transfer"] != self.transfer or not is_for(received, *self._own):
            return
        result = FileResult(whole(received.values, "result"))
        # It was deleted before, and the answer was lost.
        is_gone = result is FileResult.NOT_FOUND and self._said > 1
        self.state = State.WHOLE if result is FileResult.OK or is_gone else State.REFUSED
        self.reason = "" if self.state is State.WHOLE else text(received.values, "reason") or result.name

    def poll(self, t: float, outbox: Outbox) -> None:
        """Say what is due at a time [s]."""
        if self.state.is_over:
            return
        if self._asking.is_hopeless(t):
            self.state = State.FAILED
            self.reason = f"{self._identity.path}: no answer for {self._asking.patience:.0f} s; it may still be aboard"
        elif self._asking.is_due(t) and outbox.room(Priority.COMMAND) >= _ROOM:
            system, component = self._peer
            outbox.put(
                Priority.COMMAND,
                "FILE_RELEASE",
                {
                    "target_system": system, "target_component": component, "transfer": self.transfer,
                    "size": self._identity.size, "sha256": bytes.fromhex(self._identity.sha256),
                    "path": self._identity.path,
                },
            )  # fmt: skip
            self._asking.asked(t)
            self._said += 1
