"""Who flies the runs: processes of this machine, or a Dask cluster. Both give the same records."""

import atexit
import logging
import multiprocessing
import os
import pickle
import re
import signal
import threading
import zlib
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from itertools import islice
from multiprocessing import connection
from queue import Empty, SimpleQueue
from typing import Any

from stommel.errors import StommelError
from stommel.studies.errors import StudyError
from stommel.studies.flight import Record, fly_run
from stommel.studies.study_file import Value

Task = tuple[int, tuple[Value, ...]]
"""Number of a run, and its values."""

_AHEAD = 4
"""Tasks handed out beforehand for each worker: enough that none waits, few enough to stop soon."""

_LOOK_S = 0.5
"""How often to look whether the study was interrupted [s]."""

_ONE_THREAD = dict.fromkeys(("NUMBA_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
"""Runs are the parallelism; threads of the libraries would only get into each other's way."""

_ADDRESS = re.compile(r"(tcp|tls|wss?)://(\[[0-9a-fA-F:.]+\]|[^\s/:\[\]]+):\d{1,5}")

Fly = Callable[[Any, int, Sequence[Any]], Record]
"""What a worker does with its kit, the number of a run and its values."""

_work: tuple[Fly, Any] | None = None


def cores() -> int:
    """Cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def fly_here(
    kit: Any, tasks: Sequence[Task], workers: int, stop: threading.Event, fly: Fly = fly_run
) -> Generator[Record, None, None]:
    """Fly runs on processes of this machine; records come as they are finished.

    Once `stop` is set, runs under way are finished and come too, and no others.

    Parameters
    ----------
    kit
        What a worker needs; a `RunKit` for `fly_run`.
    tasks
        Numbers of the runs and their values.
    workers
        Processes.
    stop
        Set to end early.
    fly
        What a worker does with each task, a function of a module.

    Raises
    ------
    StudyError
        A process died.
    """
    context = multiprocessing.get_context("spawn")
    with _environment(_ONE_THREAD):
        pool = ProcessPoolExecutor(min(workers, len(tasks)), context, _prepare, (_packed((fly, kit)),))
        waiting: set[Future[Record]] = set()
        todo = iter(tasks)
        try:
            while True:
                if stop.is_set():
                    waiting = {future for future in waiting if not future.cancel()}
                else:
                    waiting |= {pool.submit(_fly, *task) for task in islice(todo, _AHEAD * workers - len(waiting))}
                if not waiting:
                    return
                done, waiting = wait(waiting, timeout=_LOOK_S, return_when=FIRST_COMPLETED)
                for future in done:
                    yield future.result()
        except BrokenProcessPool:
            raise StudyError(
                "a worker process died (killed, or out of memory); finished runs are kept, the same command goes on"
            ) from None
        finally:
            pool.shutdown(wait=True, cancel_futures=True)


@contextmanager
def _environment(values: dict[str, str]) -> Iterator[None]:
    """Environment of the processes that are started meanwhile."""
    before = {name: os.environ.get(name) for name in values}
    os.environ.update(values)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value


def _packed(work: tuple[Fly, Any]) -> bytes:
    """Pack it so that a pipe takes it whole; else each worker would begin only once the one before has read it."""
    return zlib.compress(pickle.dumps(work))


def _prepare(packed: bytes) -> None:
    """Begin a worker: it leaves Ctrl-C to its parent, and ends with it."""
    global _work  # noqa: PLW0603 - one kit for the life of the process
    _work = pickle.loads(zlib.decompress(packed))
    atexit.register(os._exit, 0)  # there is nothing to save, and taking the interpreter down takes half a second
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """Without this, workers of a killed study would wait for work for ever."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        connection.wait([parent.sentinel])
        os._exit(1)


def _fly(run: int, values: tuple[Value, ...]) -> Record:
    assert _work is not None
    fly, kit = _work
    return fly(kit, run, values)


def fly_on_cluster(
    kit: Any,
    tasks: Sequence[Task],
    address: str,
    stop: threading.Event,
    *,
    patience_s: float = 20.0,
    fly: Fly = fly_run,
) -> Generator[Record, None, None]:
    """Fly runs on a Dask cluster; the runs of a worker that goes away are flown by the others.

    Parameters
    ----------
    address
        Of the scheduler, such as tcp://127.0.0.1:8786.
    stop
        Once it is set, no more records come.
    patience_s
        How long to wait for the scheduler, and for its first worker [s].
    fly
        What a worker does with each task.

    Raises
    ------
    StudyError
        Dask is not installed, the scheduler cannot be reached or has no workers, or it goes away.
    """
    if not _ADDRESS.fullmatch(address):
        raise StudyError(f"--scheduler {address}: must look like tcp://host:8786")
    try:
        import distributed  # noqa: PLC0415 - an extra, and slow to load
    except ImportError:
        raise StudyError("--scheduler needs Dask: pip install 'stommel[cluster]'") from None
    client = _connected(distributed, address, patience_s)
    with client:
        try:
            client.wait_for_workers(1, timeout=patience_s)
        except TimeoutError:
            raise StudyError(f"--scheduler {address}: has no workers; start some: dask worker {address}") from None
        yield from _on_cluster(client, kit, tasks, address, stop, fly)


def _connected(distributed: Any, address: str, patience_s: float) -> Any:
    """Client of a scheduler; what Dask and its event loop would write of their troubles is kept off the screen."""
    for name in ("distributed", "tornado", "asyncio"):
        logging.getLogger(name).setLevel(logging.CRITICAL + 1)

    class Client(distributed.Client):  # type: ignore[misc]
        def __del__(self) -> None:
            """One that never connected waits for that, and ends in a traceback; the others are closed where used."""

    try:
        return Client(address, timeout=patience_s, set_as_default=False)
    except Exception as error:  # noqa: BLE001 - what answers there may be no scheduler at all, and say anything
        raise StudyError(f"--scheduler {address}: cannot be reached: {_line(error)}") from None


def _on_cluster(
    client: Any, kit: Any, tasks: Sequence[Task], address: str, stop: threading.Event, fly: Fly
) -> Generator[Record, None, None]:
    # a task rather than scattered data: the scheduler makes it again if its worker goes away
    shared = client.submit(_same, kit, pure=False)
    futures = [client.submit(fly, shared, run, values, pure=False) for run, values in tasks]
    done: SimpleQueue[Any] = SimpleQueue()
    for future in futures:
        future.add_done_callback(done.put)
    try:
        left = len(futures)
        while left and not stop.is_set():
            try:
                future = done.get(timeout=_LOOK_S)
            except Empty:
                if client.status != "running":
                    raise StudyError(_failed(address, f"the client is {client.status}")) from None
                continue
            left -= 1
            yield future.result()
            future.release()
    except StommelError:
        raise
    except Exception as error:  # noqa: BLE001 - whatever a cluster can do wrong, it is not a defect of stommel
        raise StudyError(_failed(address, _line(error))) from None
    finally:
        if client.status == "running":
            client.cancel(futures)


def _failed(address: str, reason: str) -> str:
    return f"--scheduler {address}: the cluster failed: {reason}; finished runs are kept, the same command goes on"


def _same(kit: Any) -> Any:
    return kit


def _line(error: Exception) -> str:
    return " ".join(f"{type(error).__name__}: {error}".split()).rstrip(": ")
