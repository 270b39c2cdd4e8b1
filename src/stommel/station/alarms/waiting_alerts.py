"""Alerts that have not gone out, on the disk of the station, so that a restart forgets none."""

import logging
from collections.abc import Sequence
from pathlib import Path
from typing import Any, get_args

from stommel.files.folder_storage import FolderStorage
from stommel.link.keeping import DamagedError, keep, kept
from stommel.station.alarms.alarm import Alarm
from stommel.station.alarms.alert_policy import Alert, AlertKind
from stommel.station.alarms.severity import RANK

_log = logging.getLogger(__name__)


class WaitingAlerts:
    """The file of one way; a disk that fails is told in the log, and alerts wait in memory alone.

    Parameters
    ----------
    folder
        Where it lies; None: nothing is kept.
    name
        Of the file.
    """

    def __init__(self, folder: Path | None, name: str) -> None:
        self._folder, self._name = folder, name

    def read(self) -> list[Alert]:
        """What waited when the station stopped, the oldest first."""
        if self._folder is None:
            return []
        try:
            return [_alert(row) for row in kept(FolderStorage(self._folder), self._name) or ()]
        except (DamagedError, OSError, ValueError, KeyError, TypeError) as error:
            _log.warning("alerts that waited are lost: %s: %s", self._folder / self._name, error)
            return []

    def write(self, alerts: Sequence[Alert]) -> None:
        """Keep what waits."""
        if self._folder is None:
            return
        try:
            keep(FolderStorage(self._folder), self._name, [alert.as_row() for alert in alerts])
        except (OSError, ValueError) as error:
            _log.warning("alerts wait in memory alone: %s: %s", self._folder / self._name, error)


def _alert(row: dict[str, Any]) -> Alert:
    alarm = Alarm(**row["alarm"])
    if row["kind"] not in get_args(AlertKind) or alarm.severity not in RANK:
        raise ValueError(f"{row['kind']}: is no alert")
    return Alert(row["kind"], alarm, int(row["times"]), float(row["since"]))
