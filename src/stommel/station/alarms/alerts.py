"""Words to people who are away: alarms go through the policy to every way there is."""

import time
from collections.abc import Callable, Sequence
from pathlib import Path
from threading import Lock
from typing import NamedTuple

from stommel.station.alarms.alarm import Alarm
from stommel.station.alarms.alert_policy import Alert, AlertPolicy
from stommel.station.alarms.alert_settings import AlertSettings
from stommel.station.alarms.alert_words import Sender
from stommel.station.alarms.delivery import WAITS_S, Courier, DeliveryError, Way
from stommel.station.alarms.email_way import EmailWay
from stommel.station.alarms.webhook_way import WebhookWay


class Tried(NamedTuple):
    """What became of a test."""

    way: str
    sent: bool
    reason: str
    """Why not; empty if it went out."""


class Alerts:
    """Every way to people. May be called from any thread; only `test` waits.

    Parameters
    ----------
    settings
        `[alerts]` of station.toml.
    sender
        Who tells.
    report
        Is told the name of a way and why nothing goes out there, or nothing when it does again.
    waits
        Before each further try of a way [s].
    monotonic
        Clock of this machine [s].
    folder
        Where alerts wait over a restart; None: nowhere.
    """

    def __init__(
        self,
        settings: AlertSettings,
        sender: Sender,
        report: Callable[[str, str], None],
        *,
        waits: Sequence[float] = WAITS_S,
        monotonic: Callable[[], float] = time.monotonic,
        folder: Path | None = None,
    ) -> None:
        ways: list[Way] = [EmailWay(settings.email, sender)] if settings.email is not None else []
        ways += [WebhookWay(webhook, sender) for webhook in settings.webhooks]
        self._couriers = [Courier(way, report, waits, folder) for way in ways]
        self._report = report
        self._policy, self._monotonic, self._lock = AlertPolicy(settings), monotonic, Lock()

    @property
    def ways(self) -> list[str]:
        """What people call the ways that there are."""
        return [courier.way.name for courier in self._couriers]

    def start(self) -> None:
        """Begin to bring alerts."""
        for courier in self._couriers:
            courier.start()

    def stop(self) -> None:
        """End soon."""
        for courier in self._couriers:
            courier.stop()

    def take(self, alarm: Alarm) -> None:
        """Take an alarm that was raised or cleared."""
        with self._lock:
            alerts = self._policy.take(alarm, self._monotonic())
        self._put(alerts)

    def look(self) -> None:
        """Tell what was only counted and is due; to be called every second or so."""
        with self._lock:
            alerts = self._policy.look(self._monotonic())
        self._put(alerts)

    def test(self, user: str) -> list[Tried]:
        """Send a word along every way, and say what became of it."""
        words = f"Test of the alerts by {user}; nothing is wrong"
        alert = Alert("test", Alarm(None, None, "test", words, "notice", time.time()))
        tried = []
        for courier in self._couriers:
            try:
                courier.way.send([alert])
                reason = ""
            except DeliveryError as error:
                reason = str(error)
            self._report(courier.way.name, reason)
            tried.append(Tried(courier.way.name, not reason, reason))
        return tried

    def _put(self, alerts: Sequence[Alert]) -> None:
        if alerts:
            for courier in self._couriers:
                courier.put(alerts)
