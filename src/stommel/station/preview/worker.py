"""A process with the simulator in it, as its parent holds it: started when it is first needed, and kept."""

import multiprocessing
import time
from collections.abc import Callable
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from threading import Event
from typing import Any

from stommel.errors import StommelError
from stommel.station.planner.problems import PlanError, PlanProblem
from stommel.station.preview.work import DONE, READY, REFUSED, SHARE, STOPPED, work

LONGEST_START = 600.0
"""Until the process can work [s]; the first time on a machine its code is compiled."""
_LOOK = 0.05
"""Between two looks whether somebody wants it to stop [s]."""
_GRACE = 2.0
"""In which a process that is told to stop may do so by itself [s]."""


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
        try:
            channel.send((kind, document))
            return self._heard(channel, time.monotonic() + limit, limit, stop, told)
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
            self._wait(ours, time.monotonic() + LONGEST_START, stop, "the simulator did not start in time")
            word, _ = ours.recv()
        except (EOFError, OSError):
            self.close()
            raise SimulatorError("the simulator could not be started; look at the station's own output") from None
        assert word == READY
        return ours

    def _heard(
        self,
        channel: "Connection[Any, Any]",
        until: float,
        limit: float,
        stop: Event,
        told: Callable[[float | None], None],
    ) -> Any:
        late = f"the simulator took longer than {limit:g} s and was stopped; a shorter duration_days takes less"
        while True:
            self._wait(channel, until, stop, late)
            word, value = channel.recv()
            if word == SHARE:
                told(float(value))
            elif word == DONE:
                return value
            elif word == REFUSED:
                raise PlanError(PlanProblem(**row) for row in value)
            elif word == STOPPED:
                raise CancelledError("was cancelled")

    def _wait(self, channel: "Connection[Any, Any]", until: float, stop: Event, late: str) -> None:
        """Wait for a word of the process; one that does not stop when it is told to, or is late, is ended."""
        leave = None
        while not channel.poll(_LOOK):
            now = time.monotonic()
            if stop.is_set() and leave is None:
                leave = now + _GRACE
                channel.send((STOPPED, None))
            if leave is not None and now > leave:
                self.close()
                raise CancelledError("was cancelled")
            if now > until:
                self.close()
                raise SimulatorError(late)
