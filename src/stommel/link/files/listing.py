"""Lists a folder of the other end, by MAVLink FTP."""

import zlib

from stommel.link.files import ftp_words
from stommel.link.files.asking import PATIENCE, Asking
from stommel.link.files.ftp_words import Opcode, Words
from stommel.link.files.paths import plain_path
from stommel.link.files.port import Entry, FileRefusalError, FtpError
from stommel.link.files.progress import State
from stommel.link.outbox import Outbox, Priority
from stommel.link.service import Received, is_for
from stommel.link.timing import RetransmissionTimer

MOST_ENTRIES = 100_000
_ROOM = 255


class Listing:
    """Lists one folder; a service of the shore's session.

    Parameters
    ----------
    own, peer
        System and component of this end, and of the one that has the folder.
    folder
        Its path.
    """

    def __init__(
        self,
        own: tuple[int, int],
        peer: tuple[int, int],
        folder: str,
        *,
        patience: float | None = PATIENCE,
        timer: RetransmissionTimer | None = None,
    ) -> None:
        self._own, self._peer, self.folder = own, peer, folder
        self._asking = Asking(timer, patience)
        self._sequence: int | None = None
        """Of the question; begins elsewhere in each listing, so that no answer to another one counts."""
        self._seen = 0
        self.entries: list[Entry] = []
        """What was listed; all of it once the state is WHOLE."""
        self.state, self.reason = State.IDENTIFYING, ""
        try:
            plain_path(folder)
        except FileRefusalError as error:  # a part of the path would be another folder
            self.state, self.reason = State.REFUSED, str(error)

    def take(self, received: Received, t: float) -> None:
        """Take a message at a time [s]."""
        if received.system != self._peer[0] or self.state.is_over:
            return
        self._asking.heard(t)
        if received.name != ftp_words.MESSAGE or not is_for(received, *self._own):
            return
        payload = received.values["payload"]
        answer = ftp_words.unpacked(payload) if isinstance(payload, bytes) else None
        if self._sequence is None or answer is None:
            return
        if answer.asked != Opcode.LIST_DIRECTORY or answer.sequence != self._sequence + 1:
            return
        self._asking.answered(t)
        if answer.opcode == Opcode.NAK:
            self._refused(answer)
            return
        lines = [line for line in answer.data.split(b"\0") if line]
        self._seen += len(lines)
        self.entries += [entry for line in lines if (entry := _entry(line.decode("utf-8", "replace"))) is not None]
        self._sequence = (self._sequence + 1) % 0xFFFF
        if not lines or self._seen > MOST_ENTRIES:
            self.state, self.reason = State.FAILED, f"{self.folder}: the list does not end"

    def _refused(self, answer: Words) -> None:
        code = answer.data[0] if answer.data else FtpError.FAIL
        if code == FtpError.END_OF_FILE:
            self.state = State.WHOLE
        else:
            name = FtpError(code).name.lower().replace("_", " ") if code in set(FtpError) else f"error {code}"
            self.state, self.reason = State.REFUSED, f"{self.folder}: {name}"

    def poll(self, t: float, outbox: Outbox) -> None:
        """Say what is due at a time [s]."""
        if self.state.is_over:
            return
        if self._asking.is_hopeless(t):
            self.state, self.reason = State.FAILED, f"{self.folder}: no answer for {self._asking.patience:.0f} s"
        elif self._asking.is_due(t) and outbox.room(Priority.COMMAND) >= _ROOM:
            data = self.folder.encode()
            if self._sequence is None:
                self._sequence = (int(t * 997.0) + zlib.crc32(data)) % 0xFFFF
            words = Words(self._sequence, 0, Opcode.LIST_DIRECTORY, len(data), offset=self._seen, data=data)
            system, component = self._peer
            outbox.put(
                Priority.COMMAND,
                ftp_words.MESSAGE,
                {"target_system": system, "target_component": component, "payload": ftp_words.packed(words)},
            )
            self._asking.asked(t)


def _entry(line: str) -> Entry | None:
    if line.startswith("D"):
        return Entry(line[1:], 0, True)
    name, tab, size = line[1:].rpartition("\t")
    return Entry(name, int(size), False) if line.startswith("F") and tab and size.isdecimal() else None
