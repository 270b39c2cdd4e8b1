"""How alerts go out: what can go wrong, secrets from files, and a courier that tries again."""

import time
from collections import deque
from collections.abc import Callable, Sequence
from pathlib import Path
from threading import Event, Lock, Thread
from typing import Protocol

from stommel.errors import StommelError, one_line
from stommel.station.alarms.alert_policy import Alert
from stommel.station.alarms.waiting_alerts import WaitingAlerts

MOST_WAITING = 1000
"""Alerts that wait for a way that fails; beyond it the oldest is dropped."""
OLDEST_S = 86_400.0
"""What has waited for longer is not sent any more."""
MOST_TOGETHER = 50
"""Alerts in one message."""
PATIENCE_S = 20.0
"""For the other end to answer."""
WAITS_S = (5.0, 10.0, 20.0, 40.0, 80.0, 160.0, 300.0)
"""Before each further try; the last one for ever."""
_LARGEST_SECRET = 4096


class DeliveryError(StommelError):
    """An alert did not go out; the message says why."""


class PartlyDeliveredError(DeliveryError):
    """An alert went out, but not to all; it is not sent again, as those who were told would be told for ever."""


class Way(Protocol):
    """A way to people: an e-mail server, a webhook."""

    @property
    def name(self) -> str:
        """What people call it."""

    @property
    def file(self) -> str:
        """Name of the file of what waits for it; the same after a restart, and another for each way."""

    def send(self, alerts: Sequence[Alert]) -> None:
        """Send one message with all of them.

        Raises
        ------
        DeliveryError
            It did not go out.
        """


def secret_of(path: Path) -> str:
    """Return the secret that a file holds, without the line's end.

    Raises
    ------
    DeliveryError
        It cannot be read, or holds none.
    """
    try:
        with path.open("rb") as file:
            content = file.read(_LARGEST_SECRET + 1)
        secret = content.decode().strip()
    except (OSError, UnicodeDecodeError) as error:
        raise DeliveryError(f"{path}: the secret cannot be read: {reason_of(error)}") from error
    if not secret or len(content) > _LARGEST_SECRET:
        raise DeliveryError(f"{path}: must hold a secret of 1 to {_LARGEST_SECRET} bytes")
    return secret


def reason_of(error: BaseException) -> str:
    """What an error says, on one short line."""
    told = getattr(error, "strerror", None) or str(error) or type(error).__name__
    return one_line(str(told), 200)


class Courier:
    """Brings alerts along one way, in a thread of its own; what does not go out is tried again, ever more slowly.

    Parameters
    ----------
    way
        Where they go.
    report
        Is told why nothing goes out, or nothing when it does again.
    waits
        Before each further try [s].
    folder
        Where alerts wait over a restart; None: nowhere.
    """

    def __init__(
        self,
        way: Way,
        report: Callable[[str, str], None],
        waits: Sequence[float] = WAITS_S,
        folder: Path | None = None,
    ) -> None:
        self.way = way
        self._kept = WaitingAlerts(folder, way.file)
        self._report, self._waits = report, waits
        self._lock, self._keeping = Lock(), Lock()
        self._waiting: deque[Alert] = deque(self._kept.read())
        self._on_disk = list(self._waiting)
        self._woken, self._stopped = Event(), Event()
        self._thread = Thread(target=self._run, name=f"alerts by {way.name}", daemon=True)
        self.dropped = 0

    def start(self) -> None:
        """Begin to bring."""
        self._thread.start()

    def stop(self) -> None:
        """End soon; what is just going out may still do so."""
        self._stopped.set()
        self._woken.set()
        if self._thread.is_alive():
            self._thread.join(1.0)
        self._keep()

    def put(self, alerts: Sequence[Alert]) -> None:
        """Take alerts; never waits."""
        with self._lock:
            self._waiting.extend(alert._replace(since=time.time()) for alert in alerts)
            while len(self._waiting) > MOST_WAITING:
                self._waiting.popleft()
                self.dropped += 1
        self._woken.set()

    def _run(self) -> None:
        tries = 0
        while not self._stopped.is_set():
            self._drop_old()
            self._keep()
            if not self._waiting:
                self._woken.wait()
                self._woken.clear()
                continue
            if self._is_brought():
                tries = 0
                continue
            self._stopped.wait(self._waits[min(tries, len(self._waits) - 1)])
            tries += 1

    def _is_brought(self) -> bool:
        """Try to bring what waits longest."""
        with self._lock:
            together = [self._waiting[place] for place in range(min(len(self._waiting), MOST_TOGETHER))]
        reason = ""
        try:
            self.way.send(together)
        except PartlyDeliveredError as error:
            reason = str(error)
        except DeliveryError as error:
            self._report(self.way.name, str(error))
            return False
        except Exception as error:  # noqa: BLE001 - a defect must not end the only word to people who are away
            self._report(self.way.name, f"{self.way.name}: {type(error).__name__}: {reason_of(error)}")
            return False
        with self._lock:
            for alert in together:
                if self._waiting and self._waiting[0] is alert:
                    self._waiting.popleft()
        self._keep()
        self._report(self.way.name, reason)
        return True

    def _drop_old(self) -> None:
        """Forget what nobody wants to be told any more."""
        with self._lock:
            while self._waiting and time.time() - self._waiting[0].since > OLDEST_S:
                self._waiting.popleft()
                self.dropped += 1

    def _keep(self) -> None:
        """Bring what waits to the disk, before it is tried and after it has gone out."""
        with self._keeping:
            with self._lock:
                waiting = list(self._waiting)
            if waiting != self._on_disk:
                self._kept.write(waiting)
                self._on_disk = waiting
