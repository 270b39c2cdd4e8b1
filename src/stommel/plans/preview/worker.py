"""A process with the simulator in it, as its parent holds it: started when it is first needed, and kept."""

import multiprocessing
import time
from collections.abc import Callable
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from threading import Event
from typing import Any

from stommel.errors import StommelError
from stommel.plans.preview.work import DONE, READY, REFUSED, SHARE, STOPPED, work
from stommel.plans.problems import PlanError, PlanProblem

LONGEST_START = 600.0
"""Until the process can work [s]; the first time on a machine its code is compiled."""
_LOOK = 0.05
"""Between two looks whether somebody wants it to stop [s]."""
_GRACE = 2.0
"""In which a process that is told to stop may do so by itself [s]."""


CANCELLED = "was cancelled"


class SimulatorError(StommelError):
    """The simulator gave no answer."""


class CancelledError(StommelError):
    """Nobody wants the answer any more."""


class Worker:
    """One process; only one thread at a time may use it.

    Parameters
    ----------
    serve
        What the process does with its end of the channel.
    """

    def __init__(self, serve: Callable[[Any], None] = work) -> None:
        self._serve = serve
        self._process: BaseProcess | None = None
        self._channel: Connection[Any, Any] | None = None

    @property
    def pid(self) -> int | None:
        """Of the process; None while there is none."""
        return None if self._process is None else self._process.pid

    def ask(self, kind: str, document: Any, limit: float, stop: Event, told: Callable[[float | None], None]) -> Any:
        """Return the answer to a request.

        Parameters
        ----------
        kind, document
            What is asked for, and the plan.
        limit
            Longest time of the work itself [s].
        stop
            Set by another thread when nobody wants the answer any more.
        told
            Is called with None while the process starts, then with the share that is done.

        Raises
        ------
        PlanError
            What is wrong with the plan.
        CancelledError
            `stop` was set.
        SimulatorError
            The process died, or took too long; the next request starts another one.
        """
        channel = self._started(stop, told)
        told(0.0)
        late = f"the simulator took longer than {limit:g} s and was stopped; a shorter duration_days takes less"
        try:
            channel.send((kind, document))
            return self._heard(_Patience(channel, stop, limit, late), told)
        except (EOFError, OSError):
            self.close()
            raise SimulatorError(
                "the simulator stopped unexpectedly (killed, or out of memory); it starts anew when it is asked again"
            ) from None

    def close(self) -> None:
        """End the process."""
        process, channel = self._process, self._channel
        self._process = self._channel = None
        if channel is not None:
            channel.close()
        if process is not None:
            process.kill()
            process.join()
            process.close()

    def _started(self, stop: Event, told: Callable[[float | None], None]) -> "Connection[Any, Any]":
        if self._process is not None and self._process.is_alive() and self._channel is not None:
            return self._channel
        self.close()
        told(None)
        context = multiprocessing.get_context("spawn")
        ours, theirs = context.Pipe()
        process = context.Process(target=self._serve, args=(theirs,), daemon=True, name="stommel-preview")
        process.start()
        theirs.close()
        self._process, self._channel = process, ours
        try:
            word, _ = self._word(_Patience(ours, stop, LONGEST_START, "the simulator did not start in time"))
        except (EOFError, OSError):
            self.close()
            raise SimulatorError("the simulator could not be started; look at the station's own output") from None
        assert word == READY
        return ours

    def _heard(self, patience: "_Patience", told: Callable[[float | None], None]) -> Any:
        while True:
            word, value = self._word(patience)
            if word == SHARE:
                told(float(value))
            elif word == DONE:
                return value
            elif word == REFUSED:
                raise PlanError(PlanProblem(**row) for row in value)
            elif word == STOPPED:
                raise CancelledError(CANCELLED)

    def _word(self, patience: "_Patience") -> tuple[str, Any]:
        """Next word of the process; one that does not stop when it is told to, or is late, is ended."""
        try:
            while True:
                patience.look()  # also at one that never pauses
                if patience.channel.poll(_LOOK):
                    word: tuple[str, Any] = patience.channel.recv()
                    return word
        except StommelError:
            self.close()
            raise


class _Patience:
    """How long an answer is waited for."""

    def __init__(self, channel: "Connection[Any, Any]", stop: Event, limit: float, late: str) -> None:
        self.channel = channel
        self._stop, self._until, self._late = stop, time.monotonic() + limit, late
        self._leave: float | None = None

    def look(self) -> None:
        """Tell the process once that nobody wants the answer any more; raise when the time is over."""
        now = time.monotonic()
        if self._stop.is_set() and self._leave is None:
            self._leave = now + _GRACE
            self.channel.send((STOPPED, None))
        if self._leave is not None and now > self._leave:
            raise CancelledError(CANCELLED)
        if now > self._until:
            raise SimulatorError(self._late)
