"""What is written down of who came, for which nobody who only looks shall wait."""

from collections.abc import Callable
from threading import Lock, Thread

Later = Callable[[str, Callable[[], None]], None]
"""Takes what is to be written, under a name; of the same name the last alone counts."""


def at_once(_name: str, doing: Callable[[], None]) -> None:
    """Write it now, where nobody waits, as in a command."""
    doing()


class Afterwards:
    """Writes in a thread that lives as long as there is something to write."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._waiting: dict[str, Callable[[], None]] = {}
        self._thread: Thread | None = None

    def __call__(self, name: str, doing: Callable[[], None]) -> None:
        """Take what is to be written; never waits."""
        with self._lock:
            self._waiting[name] = doing
            if self._thread is None:
                self._thread = Thread(target=self._run, name="people", daemon=True)
                self._thread.start()

    def stop(self) -> None:
        """Return when all is written, or the archive has had its time."""
        thread = self._thread
        if thread is not None:
            thread.join(5.0)

    def _run(self) -> None:
        while True:
            with self._lock:
                if not self._waiting:
                    self._thread = None
                    return
                doing = self._waiting.pop(next(iter(self._waiting)))
            doing()
