"""The process behind previews: it starts when it is needed, stays, is cancelled, and may die."""

import os
import signal
import threading
from collections.abc import Iterator

import pytest

from stommel.plans.preview.worker import CancelledError, SimulatorError, Worker
from stommel.plans.problems import PlanError
from tests.plans.preview.serving import serve, serve_nothing

SOON = 120.0
LONG = 10_000.0


@pytest.fixture
def worker() -> Iterator[Worker]:
    found = Worker(serve)
    yield found
    found.close()


def ask(
    worker: Worker, kind: str, document: object, limit: float = SOON, stop: threading.Event | None = None
) -> object:
    told: list[float | None] = []
    answer = worker.ask(kind, document, limit, threading.Event() if stop is None else stop, told.append)
    assert 0.0 in told
    return answer


def test_nothing_is_started_before_it_is_asked_and_one_process_answers_all(worker: Worker) -> None:
    assert worker.pid is None
    assert ask(worker, "echo", {"a": 1}) == {"echo": {"a": 1}}
    first = worker.pid
    assert first is not None
    assert ask(worker, "echo", 2) == {"echo": 2}
    assert worker.pid == first


def test_progress_is_told(worker: Worker) -> None:
    told: list[float | None] = []
    worker.ask("fly", 10, SOON, threading.Event(), told.append)
    assert told[0] is None, "it has to start first"
    shares = [share for share in told[1:] if share is not None]
    assert shares == sorted(shares)
    assert len(shares) > 5


def test_what_is_wrong_with_a_plan_comes_back(worker: Worker) -> None:
    with pytest.raises(PlanError) as raised:
        ask(worker, "refuse", 500)
    (problem,) = raised.value.problems
    assert (problem.key, problem.value, problem.allowed) == ("dives.depth_m", "500", "at most 200 m")
    assert ask(worker, "echo", 1) == {"echo": 1}, "it goes on"


def test_one_that_dies_is_told_of_and_replaced(worker: Worker) -> None:
    with pytest.raises(SimulatorError, match="stopped unexpectedly"):
        ask(worker, "die", 1)
    assert ask(worker, "echo", 1) == {"echo": 1}


def test_one_that_is_killed_between_requests_is_replaced(worker: Worker) -> None:
    ask(worker, "echo", 1)
    first = worker.pid
    assert first is not None
    os.kill(first, signal.SIGKILL)
    os.waitid(os.P_PID, first, os.WEXITED | os.WNOWAIT)  # it is dead, and still to be found so
    assert ask(worker, "echo", 2) == {"echo": 2}
    assert worker.pid != first


def test_one_that_takes_too_long_is_ended(worker: Worker) -> None:
    ask(worker, "echo", 1)
    with pytest.raises(SimulatorError, match=r"longer than 0\.3 s"):
        ask(worker, "deaf", LONG, limit=0.3)
    assert worker.pid is None


def test_one_that_listens_is_cancelled_and_stays(worker: Worker) -> None:
    ask(worker, "echo", 1)
    first, stop = worker.pid, threading.Event()
    threading.Timer(0.2, stop.set).start()
    with pytest.raises(CancelledError):
        ask(worker, "fly", 3000, stop=stop)
    assert worker.pid == first
    assert ask(worker, "echo", 2) == {"echo": 2}, "the word to stop was not left for the next request"


def test_one_that_speaks_without_a_pause_is_cancelled_too(worker: Worker) -> None:
    """It was not: the wish was looked at only while nothing came."""
    ask(worker, "echo", 1)
    stop = threading.Event()
    threading.Timer(0.2, stop.set).start()
    with pytest.raises(CancelledError):
        ask(worker, "babble", LONG, limit=LONG, stop=stop)


def test_one_that_does_not_listen_is_ended(worker: Worker) -> None:
    ask(worker, "echo", 1)
    stop = threading.Event()
    stop.set()
    with pytest.raises(CancelledError):
        ask(worker, "deaf", LONG, limit=LONG, stop=stop)
    assert ask(worker, "echo", 2) == {"echo": 2}


def test_one_that_never_starts_is_told_of() -> None:
    worker = Worker(serve_nothing)
    with pytest.raises(SimulatorError, match="could not be started"):
        ask(worker, "echo", 1)
    assert worker.pid is None
