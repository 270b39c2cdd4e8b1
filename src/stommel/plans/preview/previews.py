"""Previews that people ask for: a short queue, one at a time, with progress, and cancelled at any time."""

import secrets
import threading
import time
from collections import OrderedDict, deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from stommel.errors import StommelError
from stommel.plans.plan import StationPlan
from stommel.plans.preview.work import CHECK, FLY, OPEN
from stommel.plans.preview.worker import CancelledError, SimulatorError, Worker
from stommel.plans.problems import PlanError, PlanProblem

MOST_WAITING = 8
"""Jobs that wait; more are refused."""
MOST_KEPT = 32
"""Jobs that are over and can still be asked for."""
LONGEST_FLIGHT, LONGEST_CHECK = 120.0, 30.0
"""Of the work itself [s]."""

WAITING, STARTING, RUNNING, DONE, FAILED, CANCELLED = "waiting", "starting", "running", "done", "failed", "cancelled"

_ENDING = "the station is ending"


class TooManyJobsError(StommelError):
    """So many jobs wait that another one would only wait too."""


class UnknownJobError(StommelError):
    """No job has this name, or it was long ago."""

    key = "job"


class NotFlownError(StommelError):
    """A job has no result: it is not over, or has failed."""

    key = "job"


@dataclass
class Job:
    """One request, and what became of it."""

    kind: str
    document: dict[str, Any]
    name: str = field(default_factory=lambda: secrets.token_hex(8))
    state: str = WAITING
    share: float = 0.0
    began: float | None = None
    """When the work itself began [s]."""
    result: Any = None
    error: dict[str, Any] | None = None
    stop: threading.Event = field(default_factory=threading.Event)
    over: threading.Event = field(default_factory=threading.Event)

    def told(self, share: float | None) -> None:
        """Take note of what the worker says."""
        if share is None:
            self.state = STARTING
            return
        if self.began is None:
            self.began = time.monotonic()
        self.state, self.share = RUNNING, share

    def as_row(self) -> dict[str, Any]:
        """The job as JSON has it."""
        left = None
        if self.state == RUNNING and self.began is not None and self.share > 0.0:
            left = (time.monotonic() - self.began) * (1.0 - self.share) / self.share
        return {
            "job": self.name,
            "state": self.state,
            "share": self.share,
            "seconds_left": left,
            "result": self.result,
            "error": self.error,
        }


class Flight(NamedTuple):
    """A plan, and what the simulator told of it."""

    plan: Mapping[str, Any]
    result: Mapping[str, Any]


class _Lane:
    """A worker and those who wait for it."""

    def __init__(self, worker: Worker, limit: float) -> None:
        self._worker, self._limit = worker, limit
        self._waiting: deque[Job] = deque()
        self._changed = threading.Condition()
        self._now: Job | None = None
        self._thread: threading.Thread | None = None
        self._open = True

    def put(self, job: Job) -> None:
        """Let a job wait for its turn."""
        with self._changed:
            if not self._open:
                raise SimulatorError(_ENDING)
            if len(self._waiting) >= MOST_WAITING:
                raise TooManyJobsError(f"{MOST_WAITING} requests to the simulator wait already; try again in a minute")
            self._waiting.append(job)
            if self._thread is None:
                self._thread = threading.Thread(target=self._work, name="previews", daemon=True)
                self._thread.start()
            self._changed.notify()

    def close(self) -> None:
        """Cancel what waits or runs, and end the process."""
        with self._changed:
            self._open = False
            for job in (*self._waiting, *([] if self._now is None else [self._now])):
                job.stop.set()
            self._changed.notify()
        if self._thread is not None:
            self._thread.join()
        self._worker.close()

    def _next(self) -> Job | None:
        with self._changed:
            self._changed.wait_for(lambda: self._waiting or not self._open)
            self._now = self._waiting.popleft() if self._waiting else None
            return self._now

    def _work(self) -> None:
        while (job := self._next()) is not None:
            try:
                self._do(job)
            finally:
                job.over.set()

    def _do(self, job: Job) -> None:
        if job.stop.is_set():
            job.state = CANCELLED
            return
        try:
            job.result = self._worker.ask(job.kind, job.document, self._limit, job.stop, job.told)
            job.state, job.share = DONE, 1.0
        except CancelledError:
            job.state = CANCELLED
        except PlanError as error:
            job.error = {"reason": str(error), "problems": [each.as_row() for each in error.problems]}
            job.state = FAILED
        except StommelError as error:
            job.error = {"reason": str(error), "problems": []}
            job.state = FAILED


class Previews:
    """What the station has of the simulator; thread-safe. Nothing is started before somebody asks.

    Parameters
    ----------
    worker
        Makes a worker; there is one for flights and one for checks, so that a check never waits for a flight.
    """

    def __init__(self, worker: Callable[[], Worker] = Worker) -> None:
        self._lanes = {FLY: _Lane(worker(), LONGEST_FLIGHT), CHECK: _Lane(worker(), LONGEST_CHECK)}
        self._jobs: OrderedDict[str, Job] = OrderedDict()
        self._lock = threading.Lock()

    def start(self, plan: StationPlan) -> str:
        """Let a plan be flown; returns the name of the job.

        Raises
        ------
        TooManyJobsError
            The queue is full.
        """
        job = Job(FLY, _plain(plan))
        self._lanes[FLY].put(job)
        with self._lock:
            self._jobs[job.name] = job
            over = [name for name, each in self._jobs.items() if each.over.is_set()]
            for name in over[: max(0, len(over) - MOST_KEPT)]:
                del self._jobs[name]
        return job.name

    def job(self, name: str) -> dict[str, Any]:
        """State of a job, with its result or error once it is over.

        Raises
        ------
        UnknownJobError
            There is none of this name.
        """
        return self._found(name).as_row()

    def flight(self, name: str) -> Flight:
        """Plan and result of a job that is done.

        Raises
        ------
        UnknownJobError
            There is none of this name.
        NotFlownError
            It is not done.
        """
        job = self._found(name)
        if job.state != DONE:
            raise NotFlownError(f"job {name} has no result: it is {job.state}; ask for one that is done")
        return Flight(job.document, job.result)

    def cancel(self, name: str) -> None:
        """Let a job be, whether it waits or runs; one that is over stays as it is.

        Raises
        ------
        UnknownJobError
            There is none of this name.
        """
        job = self._found(name)
        job.stop.set()
        if job.state == WAITING:
            job.state = CANCELLED

    def check(self, plan: StationPlan, patience: float = LONGEST_CHECK) -> dict[str, Any]:
        """Problems, warnings and orders of a plan; waits for them, but no longer than `patience` [s].

        Raises
        ------
        TooManyJobsError
            The queue is full.
        SimulatorError
            The simulator gave no answer, or not yet.
        """
        try:
            return self._asked(CHECK, _plain(plan), patience)
        except PlanError as error:
            return {"problems": [each.as_row() for each in error.problems], "warnings": [], "orders": None}

    def orders(self, plan: StationPlan) -> str:
        """Text of a plan's orders.

        Raises
        ------
        PlanError
            Everything that is wrong with it.
        TooManyJobsError, SimulatorError
            As `check`.
        """
        found = self.check(plan)
        if found["orders"] is None:
            raise PlanError(PlanProblem(**row) for row in found["problems"])
        return str(found["orders"])

    def opened(self, orders: str, around: dict[str, Any], patience: float = LONGEST_CHECK) -> dict[str, Any]:
        """Plan of orders, and what of them it cannot hold; `around` as `preview.opening.opened` has it.

        Raises
        ------
        PlanError
            The text is no orders file, or is one for another vehicle.
        TooManyJobsError, SimulatorError
            As `check`.
        """
        return self._asked(OPEN, {"orders": orders, "around": around}, patience)

    def _asked(self, kind: str, document: dict[str, Any], patience: float) -> dict[str, Any]:
        """Wait for the answer to a short question."""
        job = Job(kind, document)
        self._lanes[CHECK].put(job)
        if not job.over.wait(patience):
            job.stop.set()
            raise SimulatorError("the simulator is still being made ready; ask again in a minute")
        if job.error is not None and job.error["problems"]:
            raise PlanError(PlanProblem(**row) for row in job.error["problems"])
        if job.error is not None or job.result is None:
            raise SimulatorError(_ENDING if job.error is None else job.error["reason"])
        answer: dict[str, Any] = job.result
        return answer

    def close(self) -> None:
        """Cancel everything and end the processes."""
        for lane in self._lanes.values():
            lane.close()

    def _found(self, name: str) -> Job:
        with self._lock:
            if name not in self._jobs:
                raise UnknownJobError(f"there is no job {name[:40]!r}; the last {MOST_KEPT} that are over are kept")
            return self._jobs[name]


def _plain(plan: StationPlan) -> dict[str, Any]:
    """A plan as its JSON has it; what people left out is left out."""
    return plan.model_dump(mode="json", exclude_none=True, exclude_unset=True)
