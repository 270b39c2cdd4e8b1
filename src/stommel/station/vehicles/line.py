"""The line to one vehicle: a thread that hears, keeps, and only then answers."""

import time
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from contextlib import ExitStack
from pathlib import Path
from queue import Empty, Full, Queue
from threading import Event, Thread
from typing import Protocol, TypeVar

from stommel.archive import Archive, ArchiveError, ArchiveRequestError, Batch
from stommel.link.shore.shore_end import ShoreEnd
from stommel.link.transports.opening import open_transport
from stommel.link.transports.transport import READ_AT_ONCE, Transport, TransportError
from stommel.station.settings import VehicleSettings
from stommel.station.vehicles.abort_only import AbortOnly
from stommel.station.vehicles.ingest import Ingest
from stommel.station.vehicles.line_status import LineStatus, complaint, status_of
from stommel.station.vehicles.opening import VehicleError, open_end

BUSY, QUIET = 0.01, 0.05
"""Between two looks at a line on which something goes on, and at one that is silent [s]."""
GOES_ON = 2.0
"""After something came, or was asked for, a line is looked at often [s]."""
AGAIN = 1.0
"""Between two tries of what has failed: transport, archive, a look [s]."""
OWN_EVERY = 1.0
"""What only the station has said is kept as late [s]."""
CLOCK_EVERY = 30.0
STATUS_EVERY = 0.25
AHEAD = 65_536
"""Bytes that may wait in the transport."""
MOST_REQUESTS = 1000
MOST_READS = 4
"""Of one look: a disk that is slow for a moment shall not make a line slow."""

T = TypeVar("T")


class Follower(Protocol):
    """Something that goes on over many looks; everything of it happens in the line's thread."""

    def look(self, line: "VehicleLine", t: float) -> None:
        """Look what has become of it at a time of the link [s]; ArchiveError is borne and tried again."""


class VehicleLine:
    """Speaks to one vehicle. Everything about its `end` happens in its own thread; others `ask`.

    Parameters
    ----------
    settings
        Which vehicle, and where it is.
    folder
        Of the station; the vehicle has one of its own there.
    archive
        Keeps everything that comes, before it is answered.
    committed
        Called with what was stored, in the line's thread; must not wait.

    Raises
    ------
    StommelError
        Folder, key or address cannot be used.
    """

    def __init__(
        self,
        settings: VehicleSettings,
        folder: Path,
        archive: Archive,
        committed: Callable[["VehicleLine", Batch], None],
    ) -> None:
        self.settings, self.vehicle, self.folder = settings, settings.vehicle, folder
        self._held = ExitStack()
        try:
            self.end, self._storage, self.clock = open_end(settings, folder, self._held)
        except BaseException:
            self._held.close()
            raise
        self.ingest = Ingest(self.vehicle, self.clock, self.end.heard)
        self.followers: list[Follower] = []
        """Looked at when all that came is kept."""
        self.tellers: list[Follower] = []
        """Looked at while the archive fails too: people shall know of it then."""
        self.ended: Callable[[], str] = lambda: ""
        """Tells why the vehicle will never be heard again, in words; empty while nobody knows of anything."""
        self.archive_reason = ""
        """Why what comes is not kept, in words."""
        self.failures = 0
        """Looks that went wrong."""
        self.failure = ""
        """The last of them, in words."""
        self.left_out = 0
        """Rows of what came that no archive takes; their frames are kept."""
        self.clock_failure = ""
        """Why the clock of its world is not kept now, in words."""
        self._archive, self._committed = archive, committed
        self._services = self.end.session.services
        self._transport: Transport | None = None
        self._transport_reason, self._open_at = "not tried yet", 0.0
        self._store_at = self._clock_at = self._status_at = 0.0
        self._lively = 0.0
        self._requests: Queue[tuple[Callable[[ShoreEnd, float], object], Future[object]]] = Queue(MOST_REQUESTS)
        self._wake, self._ends = Event(), Event()
        self._status = self._seen(self.clock.link_now())
        self._thread = Thread(target=self._run, name=f"vehicle-{self.vehicle}", daemon=True)

    # from other threads

    def start(self) -> None:
        """Begin to listen."""
        self._thread.start()

    def end_soon(self) -> None:
        """Begin to end; `stop` waits for it."""
        self._ends.set()
        self._wake.set()

    def stop(self, within: float = 5.0) -> None:
        """End, with all that came stored if the archive takes it.

        A thread that takes longer, as one that waits for a slow disk, keeps the vehicle's folder until it has ended.
        """
        self.end_soon()
        if self._thread.ident is None:
            self._held.close()
        else:
            self._thread.join(within)

    def wait(self) -> None:
        """Return when the line has ended, however long that takes."""
        if self._thread.ident is not None:
            self._thread.join()

    def ask(self, function: Callable[[ShoreEnd, float], T]) -> "Future[T]":
        """Let the line's thread call a function with the end and the time of the link, at its next look.

        Raises
        ------
        VehicleError
            Too many wait already, or the line has ended.
        """
        future: Future[T] = Future()
        if self._ends.is_set():
            raise VehicleError(f"vehicle {self.vehicle}: the station ends")
        try:
            self._requests.put_nowait((function, future))  # type: ignore[arg-type]
        except Full:
            raise VehicleError(f"vehicle {self.vehicle}: {MOST_REQUESTS} requests wait; try again later") from None
        self._wake.set()
        return future

    def status(self) -> LineStatus:
        """How the line was when its thread looked last."""
        return self._status

    def _seen(self, t: float) -> LineStatus:
        reason = self.ended() or complaint(self.end, self._transport, self._transport_reason, self.ingest.came, t)
        return status_of(
            self.end, self.clock, self.ingest, self._transport, reason, self.settings.link, self.archive_reason,
            self.failure or self.clock_failure, t,
        )  # fmt: skip

    @property
    def is_running(self) -> bool:
        """Whether its thread lives."""
        return self._thread.is_alive()

    # the thread

    def _run(self) -> None:
        while not self._ends.is_set():
            try:
                self._look()
            except Exception as error:  # noqa: BLE001 - one bad look shall not end the line
                self._failed("a look at the line", error)
                self._ends.wait(AGAIN)
            self._wake.wait(BUSY if time.monotonic() < self._lively else QUIET)
            self._wake.clear()
        try:
            self._finish()
        finally:
            self._held.close()

    def _look(self) -> None:
        real, t = time.monotonic(), self.clock.link_now()
        transport = self._opened(real)
        data = b"" if transport is None or self.ingest.is_full else _read(transport, real)
        if data:
            self._lively = real + GOES_ON
        self.ingest.hear(data, self.end.session.take(data, t), t)
        self._serve(t)
        if self.end.is_heard(t):
            self.ingest.look_at_link(self.end.link(t), t)
        kept = self._keep(real) and not self.ingest.is_early
        if kept:
            self._follow(t, self.followers)
        if kept or self.archive_reason:
            self._follow(t, self.tellers)
        if transport is not None:
            self._speak(transport, real, t, kept=kept and not self.archive_reason)
        self._keep_clock(real)
        if real - self._status_at >= STATUS_EVERY:
            self._status_at, self._status = real, self._seen(t)

    def _failed(self, what: str, error: Exception) -> None:
        """Keep what went wrong here, for whoever looks after the station."""
        self.failures += 1
        self.failure = f"{what} failed: {type(error).__name__}: {error}"[:300]

    def _opened(self, real: float) -> Transport | None:
        if self._transport is None and real >= self._open_at:
            self._open_at = real + AGAIN
            try:
                self._transport = open_transport(self.settings.link, f"vehicles.{self.vehicle}.link")
            except TransportError as error:
                self._transport_reason = str(error)
        return self._transport

    def _serve(self, t: float) -> None:
        """Do what others have asked for."""
        for _ in range(MOST_REQUESTS):
            try:
                function, future = self._requests.get_nowait()
            except Empty:
                return
            self._lively = time.monotonic() + GOES_ON
            if not future.set_running_or_notify_cancel():
                continue
            try:
                future.set_result(function(self.end, t))
            except Exception as error:  # noqa: BLE001 - told to whoever asked
                future.set_exception(error)

    def _keep(self, real: float) -> bool:
        """Store what came; whether everything that came is on the disk. An archive that has failed is tried again."""
        ingest = self.ingest
        is_due = ingest.has_news or (ingest.frames and real - self._store_at >= OWN_EVERY)
        if not is_due and not self.archive_reason:
            return True
        if self.archive_reason and real - self._store_at < AGAIN:
            return False
        self._store_at = real
        batch = ingest.batch()
        try:
            kept = self._archive.store_sound(self.vehicle, batch)
        except ArchiveError as error:
            self.archive_reason = str(error)
            return False
        except Exception as error:  # noqa: BLE001 - a defect; an abort goes out all the same
            self._failed("keeping what came", error)
            self.archive_reason = self.failure
            return False
        ingest.stored()
        self.archive_reason = ""
        self._leave_out(kept.left_out)
        self._committed(self, kept.batch)
        return True

    def _leave_out(self, rows: Sequence[str]) -> None:
        """Tell of rows that no archive takes; the frames that brought them are kept."""
        if rows:
            self.left_out += len(rows)
            self.failure = f"{self.left_out} values were left out, their frames are kept; the last: {rows[-1]}"[:500]

    def _follow(self, t: float, followers: list[Follower]) -> None:
        for follower in list(followers):
            try:
                follower.look(self, t)
            except ArchiveRequestError as error:  # no later try would help
                self._failed(type(follower).__name__, error)
            except ArchiveError as error:
                self.archive_reason = str(error)
            except Exception as error:  # noqa: BLE001 - one of them shall not silence the others, nor the line
                self._failed(type(follower).__name__, error)

    def _speak(self, transport: Transport, real: float, t: float, *, kept: bool) -> None:
        """Say what is due; while the archive takes nothing, aborts alone, and what makes both ends believe each other.

        A question or an answer of that kind acknowledges nothing. Without it an abort might not be believed, nor the
        vehicle, whose clock is waited for in silence else.
        """
        room = min(transport.room(real), AHEAD - transport.waiting(real))
        session = self.end.session
        if kept:
            out = self.end.poll(t, room)
        else:
            services, session.services = session.services, [AbortOnly(self.end.commands), self.end.challenge]
            try:
                out = session.poll(t, room)
            finally:
                session.services = services
        if out and transport.write(out, real):
            self.ingest.say(out, t)

    def _keep_clock(self, real: float) -> None:
        if real - self._clock_at >= CLOCK_EVERY:
            self._clock_at = real
            self._write_clock()

    def _write_clock(self) -> None:
        try:
            self.clock.keep(self._storage)
            self.clock_failure = ""
        except OSError as error:
            self.clock_failure = f"clock: cannot be kept: {error.strerror or error}"

    def _finish(self) -> None:
        """Store the rest, and give all back."""
        if self.ingest.frames or self.ingest.samples:
            self._store_at = 0.0
            self.archive_reason = ""
            self._keep(time.monotonic())
        self._write_clock()
        if self._transport is not None:
            self._transport.close()
        while not self._requests.empty():
            self._requests.get_nowait()[1].cancel()


def _read(transport: Transport, real: float) -> bytes:
    """What has come, as far as one look takes it."""
    found = transport.read(real)
    if len(found) < READ_AT_ONCE:
        return found
    parts = [found]
    while len(parts) < MOST_READS and len(parts[-1]) == READ_AT_ONCE:
        parts.append(transport.read(real))
    return b"".join(parts)
