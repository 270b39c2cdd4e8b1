"""The shore station: archive, vehicles and everybody who watches them, wired."""

import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack, suppress
from dataclasses import asdict
from functools import partial
from threading import Thread
from typing import Any

from stommel.archive import Archive, ArchiveError, Batch
from stommel.files.folder_lock import FolderInUseError, locked
from stommel.link.transports.address import read_address
from stommel.plans.preview.previews import Previews
from stommel.station.live.events import Happening
from stommel.station.live.hub import Hub
from stommel.station.logbook.doings import Doings
from stommel.station.people.afterwards import Afterwards
from stommel.station.people.holders import Hold, taking
from stommel.station.people.people import People
from stommel.station.replay.replays import Replays
from stommel.station.settings import StationSettings, VehicleSettings
from stommel.station.sole import hold_archive
from stommel.station.vehicles.attached import VehicleNews
from stommel.station.vehicles.commands import Commands
from stommel.station.vehicles.files import Files
from stommel.station.vehicles.line import VehicleLine
from stommel.station.vehicles.logs import VehicleLogs
from stommel.station.vehicles.missions import Missions
from stommel.station.vehicles.opening import VehicleError
from stommel.station.vehicles.parameters import Parameters
from stommel.station.vehicles.waiting import NOTHING, WaitingThings
from stommel.station.watching import alarms_of, open_alarms, watch

Watcher = Callable[[int, Batch, float], None]
"""Vehicle, what was stored, and the time of the vehicle [s since 1970]; called in the line's thread."""
Completer = Callable[[int, dict[str, Any]], None]
"""Vehicle, and its summary, to which something is added."""


class Station:
    """A whole station; nothing runs before `start`.

    Parameters
    ----------
    settings
        What it was told.

    Raises
    ------
    StommelError
        Its folder, archive, or a vehicle cannot be used.
    """

    def __init__(self, settings: StationSettings) -> None:
        self.settings = settings
        self.hub = Hub()
        self.vehicles: dict[int, VehicleLine] = {}
        self.news: dict[int, VehicleNews] = {}
        self.watchers: list[Watcher] = []
        """Are told of everything that was stored."""
        self.completers: list[Completer] = []
        """Add to summaries."""
        self._holders: dict[int, Hold | None] = {}
        self._waiting: dict[int, WaitingThings] = {}
        self._held = ExitStack()
        self._is_started = False
        try:
            self._lock_folder()
            self.archive = Archive.open(settings.database_url)
            self._held.callback(self.archive.close)
            hold_archive(self.archive, self._held)
            self.previews = Previews()
            self._held.callback(self.previews.close)
            afterwards = Afterwards()
            self._held.callback(afterwards.stop)
            self.people = People(self.archive, told=self._holder_changed, later=afterwards)
            self.replays = Replays(self.archive, self.hub, self.vehicles)
            self._held.callback(self.replays.stop)
            self.doings = Doings(self.archive, self.now)
            self.alarms = alarms_of(settings, self.archive, self.hub, self.doings, self._title)
            self.commands = Commands(self.archive, self.hub, self.vehicles)
            self.parameters = Parameters(self.archive, self.hub, self.vehicles)
            self.missions = Missions(self.archive, self.hub, self.vehicles)
            self.files = Files(self.archive, self.hub, self.vehicles, settings.folder)
            self.logs = VehicleLogs(self.archive, self.hub, settings.folder)
            self.files.arrivals.append(self.logs.came)
            for vehicle in settings.vehicles:
                self._attach(vehicle)
        except BaseException:
            self._close()
            raise

    def start(self) -> None:
        """Begin to listen to all vehicles."""
        self._is_started = True
        self.alarms.start()
        self.logs.start()
        for line in self.vehicles.values():
            line.start()

    def stop(self) -> None:
        """End: everything that came is stored, and given back."""
        self._close()

    def attach(self, settings: VehicleSettings) -> VehicleLine:
        """Take in another vehicle while the station runs.

        Raises
        ------
        StommelError
            Its number or its line is taken, or it cannot be used.
        """
        if settings.vehicle in self.vehicles:
            raise VehicleError(f"vehicle {settings.vehicle}: this station has it already")
        for line in self.vehicles.values():
            if line.settings.link == settings.link and read_address(settings.link).number:
                raise VehicleError(
                    f"link = {settings.link}: leads to vehicle {line.vehicle} already; each vehicle needs its own line"
                )
        line = self._attach(settings)
        if self._is_started:
            line.start()
        return line

    def summary(self, vehicle: int) -> dict[str, Any]:
        """How a vehicle is, as `GET /vehicles` tells it."""
        return self.news[vehicle].summary(self.vehicles[vehicle])

    def now(self, vehicle: int | None = None) -> float:
        """Time of a vehicle, or of the station [s since 1970]."""
        return time.time() if vehicle is None else self.vehicles[vehicle].clock.now()

    def _attach(self, settings: VehicleSettings) -> VehicleLine:
        number = settings.vehicle
        self.archive.know(number, settings.title, settings.model)
        news = VehicleNews(settings, self.archive, self.hub, self._complete)
        line = VehicleLine(settings, self.settings.folder, self.archive, self._committed)
        self.hub.open(number, line.clock.now, self.archive.latest(number), line.ingest.periods.of_key)
        self.commands.follow(line)
        self.parameters.follow(line)
        self.missions.follow(line)
        self.files.follow(line)
        services = (self.parameters, self.missions, self.files)
        waiting = self._waiting[number] = WaitingThings(*(partial(each.open, number) for each in services))
        line.tellers += [waiting, news]
        self.vehicles[number], self.news[number] = line, news
        self._holders[number] = self.people.holders.of(number)
        watch(self.alarms, line, lambda: self.summary(number))
        return line

    def _committed(self, line: VehicleLine, batch: Batch) -> None:
        self.news[line.vehicle].committed(line, batch)
        if batch.samples:
            self.alarms.take(line.vehicle, batch.samples)
        for watcher in self.watchers:
            watcher(line.vehicle, batch, line.clock.now())

    def _complete(self, vehicle: int, summary: dict[str, Any]) -> None:
        hold = self._holders.get(vehicle)
        summary["holder"] = None if hold is None else hold.user
        waiting = self._waiting.get(vehicle)
        summary["waiting"] = NOTHING if waiting is None else waiting.told
        summary["alarms"] = open_alarms(self.alarms, vehicle)
        for completer in self.completers:
            completer(vehicle, summary)

    def _holder_changed(self, vehicle: int, hold: Hold | None) -> None:
        before, self._holders[vehicle] = self._holders.get(vehicle), hold
        if hold is not None:
            self.doings.add(vehicle, "hold", hold.user, taking(hold))
        elif before is not None:
            self.doings.add(vehicle, "hold", before.user, "Gave up command")
        told = {"vehicle": vehicle, "user": None} if hold is None else asdict(hold)
        self.hub.publish(Happening("holder", vehicle, told))

    def _title(self, vehicle: int) -> str:
        line = self.vehicles.get(vehicle)
        return f"vehicle {vehicle}" if line is None else line.settings.title

    def _lock_folder(self) -> None:
        folder = self.settings.folder
        try:
            folder.mkdir(parents=True, exist_ok=True)
            self._held.enter_context(locked(folder))
        except FolderInUseError:
            raise VehicleError(
                f"folder = {folder}: another station uses it; end that one, or give another folder"
            ) from None
        except OSError as error:
            raise VehicleError(f"folder = {folder}: cannot be used: {error.strerror or error}") from None

    def _close(self) -> None:
        lines: Sequence[VehicleLine] = list(self.vehicles.values())
        for line in lines:
            line.end_soon()  # all at once
        for line in lines:
            line.stop()
        if self._is_started:
            self.logs.stop()
            self.alarms.stop()
            with suppress(ArchiveError):
                self.people.audit.write_late()
        if any(line.is_running for line in lines):
            Thread(target=self._give_back, args=(lines,), name="station ends", daemon=True).start()
        else:
            self._held.close()

    def _give_back(self, lines: Sequence[VehicleLine]) -> None:
        """Keep folder and archive from another station until no line writes there any more."""
        for line in lines:
            line.wait()
        self._held.close()
