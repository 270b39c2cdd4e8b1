"""A file from the other end: identified, fetched over as many surfacings as it takes, whole only with its SHA-256."""

from stommel.link.files.asking import PATIENCE, Asking
from stommel.link.files.disk import Disk
from stommel.link.files.fetching import Fetch, FetchCounts
from stommel.link.files.paths import file_path
from stommel.link.files.port import FileRefusalError, FileResult
from stommel.link.files.progress import Progress, State
from stommel.link.files.received_file import (
    DiskFailedError,
    Identity,
    ReceivedFile,
    ReceivedFileError,
    WrongSumError,
    identity_on_disk,
)
from stommel.link.files.request_words import transfer_number
from stommel.link.outbox import Outbox, Priority
from stommel.link.service import Received, is_for
from stommel.link.timing import RetransmissionTimer
from stommel.link.traffic import Traffic
from stommel.link.values import octets, text, whole

ALL = 0xFFFFFFFF
_MOST_STARTS = 2
"""A file that comes whole and wrong, or changes aboard, is begun again once."""
_ROOM = 255


class Download:
    """Fetches one file; a service of the shore's session.

    Parameters
    ----------
    own, peer
        System and component of this end, and of the one that has the file.
    path
        Of the file at the other end.
    disk, name
        Where it comes to stand. What an earlier download has left there goes on.
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
        path: str,
        disk: Disk,
        name: str,
        *,
        patience: float | None = PATIENCE,
        timer: RetransmissionTimer | None = None,
        traffic: Traffic | None = None,
    ) -> None:
        self._own, self._peer, self.path, self._disk, self._name = own, peer, path, disk, name
        self.transfer = transfer_number("download", own, path)
        self._asking, self._traffic = Asking(timer, patience), traffic
        self._fetch: Fetch | None = None
        self.file: ReceivedFile | None = None
        self.state, self.reason = State.IDENTIFYING, ""
        self.is_paused = False
        self.has_disk_failed = False
        """Whether it has failed since the disk here did; another download of the file goes on from what has come."""
        self._starts = 0
        self._to_stop = False
        self._wanted: Identity | None = None
        try:
            file_path(path)
            self._wanted = identity_on_disk(disk, name)
            if self._wanted is not None and self._wanted.path == path:
                self._open(self._wanted)
            else:
                self._wanted = None
        except ReceivedFileError as error:
            self._failed(error)
        except FileRefusalError as error:  # what no message can name need not be asked for
            self._end(State.REFUSED, str(error))

    def _open(self, identity: Identity) -> None:
        """Go on with what is on the disk if it is of this file, or begin; segments may still be on their way."""
        self.file = ReceivedFile(self._disk, self._name, identity)
        timer = self._asking.timer
        self._fetch = Fetch(self._peer, self.transfer, self.file.missing, self.file, timer, self._fetch, self._traffic)

    # what others ask

    @property
    def counts(self) -> FetchCounts:
        """What it has seen."""
        return FetchCounts() if self._fetch is None else self._fetch.counts

    @property
    def progress(self) -> Progress:
        """How far it is."""
        size = self.file.identity.size if self.file is not None else None
        done = self.file.received.bytes if self.file is not None else 0
        rate = self._fetch.pace.rate if self._fetch is not None and self.state is State.FETCHING else 0.0
        left = (size - done) / rate if size is not None and rate > 0.0 else None
        loss = self._fetch.loss.share if self._fetch is not None else 0.0
        return Progress(self.state, self.is_paused, self.reason, done, size, rate, left, self.counts.duplicate, loss)

    def pause(self) -> None:
        """Ask for nothing more until `resume`; the other end is told to stop."""
        self._to_stop = not self.state.is_over
        self.is_paused = True

    def resume(self, t: float) -> None:
        """Go on: from every state with something missing, the next poll asks."""
        self.is_paused = self._to_stop = False
        if self.state.is_over:
            return
        self._asking.start(t)
        self._forget_asked()

    # messages

    def take(self, received: Received, t: float) -> None:
        """Take a message at a time [s]."""
        if received.system != self._peer[0] or self.state.is_over:
            return
        self._asking.heard(t)
        if self._fetch is not None:
            self._fetch.wake(t)
        if received.values.get("transfer") != self.transfer or not is_for(received, *self._own):
            return
        try:
            if received.name == "FILE_IDENTITY" and not self.is_paused:
                self._identified(received, t)
            elif received.name == "FILE_DATA" and self._fetch is not None and self.file is not None:
                self._asking.goes_on(t)
                self._fetch.take(received, t)
        except ReceivedFileError as error:
            self._failed(error)

    def _identified(self, received: Received, t: float) -> None:
        result, size = FileResult(whole(received.values, "result")), whole(received.values, "size")
        if result is FileResult.UNKNOWN:
            self._identify_again(t)
        elif result is FileResult.OK and self.state is State.IDENTIFYING:
            self._asking.answered(t)
            self._begin(Identity(self.path, size, octets(received.values, "sha256").hex()), t)
        elif result is FileResult.CHANGED:
            self._changed(text(received.values, "reason"), t)
        elif result not in (FileResult.OK, FileResult.NO_ROOM):  # room may come
            self._end(State.REFUSED, text(received.values, "reason") or result.name)

    def _identify_again(self, t: float) -> None:
        """The other end does not know this transfer, any more or yet."""
        if self.state is State.FETCHING:
            self._forget_asked()
            self.state = State.IDENTIFYING
            self._asking.start(t)

    def _forget_asked(self) -> None:
        if self._fetch is not None:
            self._fetch.begin_again()

    def _begin(self, identity: Identity, t: float) -> None:
        """Go on with what is on the disk if it is the same file, or begin."""
        if self._wanted is not None and self._wanted != identity:
            self._changed("the file aboard is not the one that was begun", t)
            return
        if self.file is None:
            self._open(identity)
        self._wanted = identity
        self.state = State.FETCHING

    def _changed(self, reason: str, t: float) -> None:
        """The file aboard is another one now: begin again with that one, once."""
        self._starts += 1
        if self._starts >= _MOST_STARTS or self._wanted is None:
            self._end(State.FAILED, f"{self.path}: changes while it is read: {reason}")
            return
        self._begin_anew(reason, t)

    def _begin_anew(self, reason: str, t: float) -> None:
        self.file = self._wanted = None
        self.reason = f"begun again: {reason}"
        self.state = State.IDENTIFYING
        self._asking.start(t)

    def poll(self, t: float, outbox: Outbox) -> None:
        """Ask for what is due at a time [s]."""
        try:
            if self.file is not None and not self.state.is_over:
                self.file.rest(t)
            if self.is_paused or self.state.is_over:
                self._say_stop(t, outbox)
            elif self._fetch is not None and self.state is State.FETCHING and self._fetch.is_whole:
                self._finish(t)
            elif self._asking.is_hopeless(t):
                self._end(State.FAILED, f"{self.path}: no answer for {self._asking.patience:.0f} s; {self._kept}")
            elif self.state is State.FETCHING and self._fetch is not None:
                self._fetch.poll(t, outbox)
            elif self._asking.is_due(t) and outbox.room(Priority.COMMAND) >= _ROOM:
                self._ask_which(t, outbox)
        except ReceivedFileError as error:
            self._failed(error)

    def _ask_which(self, t: float, outbox: Outbox) -> None:
        system, component = self._peer
        length = ALL if self._wanted is None else self._wanted.size
        values = {"target_system": system, "target_component": component, "transfer": self.transfer, "length": length}
        outbox.put(Priority.COMMAND, "FILE_OPEN", values | {"path": self.path})
        self._asking.asked(t)

    def _say_stop(self, t: float, outbox: Outbox) -> None:
        if self._to_stop and self._fetch is not None and outbox.room(Priority.COMMAND) >= _ROOM:
            self._fetch.stop(t, outbox)
        self._to_stop = False

    def _finish(self, t: float) -> None:
        assert self.file is not None
        try:
            kept_as = self.file.finish()
        except WrongSumError as error:
            self._starts += 1
            if self._starts >= _MOST_STARTS:
                raise
            self._begin_anew(str(error), t)
            return
        self.state = State.WHOLE
        if kept_as != self._name:
            self.reason = f"kept as {kept_as}: another file has the name {self._name}"

    @property
    def _kept(self) -> str:
        return "nothing has come" if self.file is None else f"{self.file.received.bytes} bytes are kept"

    def _failed(self, error: ReceivedFileError) -> None:
        self.has_disk_failed = isinstance(error, DiskFailedError)
        self._end(State.FAILED, str(error))

    def _end(self, state: State, reason: str) -> None:
        self.state, self.reason = state, reason
        self._to_stop = self._fetch is not None
        if self.file is not None:
            try:
                self.file.close()
            except ReceivedFileError as error:
                self.reason = reason if reason == str(error) else f"{reason}; {error}"
