"""The coordination software on real ports: one decision a second, the ports read in between."""

import math
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field

from stommel.errors import one_line
from stommel.messages.database import database, database_hash
from stommel.messages.frames import Frame
from stommel.onboard.coordination.config import Configuration
from stommel.onboard.coordination.coordinator import Coordinator
from stommel.onboard.coordination.logbook.framing import LogIdentity
from stommel.onboard.coordination.logbook.logbook import Logbook
from stommel.onboard.coordination.situation import OperatorRequests
from stommel.onboard.coordination.stores.continuity import ContinuityStore
from stommel.onboard.coordination.stores.missions import MissionStore, MissionStoreError, StoredMission
from stommel.onboard.running.folders import storage_of
from stommel.onboard.running.ports import RealPorts
from stommel.onboard.running.vehicle_links import RADIO, VehicleLinks
from stommel.version import __version__

PERIOD = 1.0
"""Between two steps of the coordinator [s]."""
LAST_WORDS = 3.0
"""Between a restart that the shore asked for and the end, in which the link tells it [s]."""
START_AGAIN = 10.0
"""Between two tries to keep when the mission began, while the disk does not [s]."""
READ_EVERY = 0.05
"""Between two looks at the ports [s]: the system keeps few bytes of a port that nobody reads."""

Say = Callable[[str], None]


@dataclass(frozen=True)
class Clock:
    """Where time comes from."""

    monotonic: Callable[[], float] = time.monotonic
    """[s]"""
    utc: Callable[[], float] = time.time
    """[s since 1970]"""
    sleep: Callable[[float], None] = time.sleep


@dataclass
class Figures:
    """How the software did."""

    decisions: int = 0
    longest_step_ms: float = 0.0
    """Of a decision with all frames of its second."""
    total_step_s: float = 0.0
    exceptions: int = 0
    """Steps that failed; in each the nodes heard nothing."""
    late: int = 0
    """Steps that began more than half a period late."""
    link_failures: int = 0
    """Looks at a link that failed; the dive went on."""
    restart: bool = False
    """Whether it ended because the shore asked that it starts anew."""

    @property
    def mean_step_ms(self) -> float:
        """Mean of a decision with all frames of its second [ms]."""
        return 1e3 * self.total_step_s / self.decisions if self.decisions else 0.0


@dataclass
class _Heard:
    frames: list[Frame] = field(default_factory=list)
    bytes: dict[str, bytes] = field(default_factory=dict)


class VehicleSoftware:
    """Coordinator, log and stores of a vehicle, on ports that are open.

    Parameters
    ----------
    configuration
        From `read_configuration`.
    ports
        From `open_ports`.
    say
        Takes sentences for whoever watches.
    clock
        Of the computer; another one in tests.
    supervised
        Whether somebody starts the software again when it ends, so that the shore may ask for it.

    Raises
    ------
    StommelError
        Log or stores cannot be opened.
    """

    def __init__(
        self,
        configuration: Configuration,
        ports: RealPorts,
        say: Say,
        clock: Clock | None = None,
        *,
        supervised: bool = False,
    ) -> None:
        self.configuration, self.ports, self.clock = configuration, ports, clock or Clock()
        self.figures = Figures()
        self._say, self._words = say, ""
        self._alarms: tuple[str, ...] = ()
        database()  # read now, not in the first decision
        file, t = configuration.file, self.clock.monotonic()
        self.missions = MissionStore(storage_of(configuration, "missions"), file.limits)
        self.kept = ContinuityStore(storage_of(configuration, "parameters"))
        self.logbook = Logbook(
            storage_of(configuration, "log.folder"),
            configuration.log,
            LogIdentity(__version__, database_hash(), file.vehicle, self.clock.utc()),
            t,
            lambda at: self.clock.utc() + at - self.clock.monotonic(),
        )
        self.coordinator = Coordinator(configuration.coordinator, t, logbook=self.logbook, store=self.kept)
        for note in (*self.missions.notes, *self.kept.notes):
            self._tell(t, "store", note)
        self._ends_at, self._start_again = math.inf, t
        self.links = VehicleLinks(
            configuration, self.coordinator, self.missions, lambda _: self.take_mission(self.clock.monotonic()),
            lambda at: self.clock.utc() + at - self.clock.monotonic(), ports.serial[RADIO], ports.bench, t, self._tell,
            self._restart if supervised else None,
        )  # fmt: skip
        self.links.observe(t)

    def take_mission(self, t: float) -> None:
        """Fly the mission that the store holds from now on."""
        mission = self.missions.active
        if mission is None:
            return
        expires = t + self._time_left(mission, t)
        self.coordinator.adopt(mission.orders, expires, mission.number, mission.header.sample_every_s)
        self._say(f"mission {mission.number}: {mission.header.mission}, for {mission.header.vehicle}")

    def _time_left(self, mission: StoredMission, t: float) -> float:
        """Until a mission expires [s]: by UTC, and never more than it was given, however the clock is set."""
        utc, hours = self.clock.utc(), mission.header.expires_hours
        try:
            self.missions.start(utc)
        except MissionStoreError as error:  # better flown than not at all: its time counts from this start
            self._tell(t, "store", str(error))
        if hours is None:
            return math.inf
        expires = self.missions.expires
        return 3600.0 * hours if expires is None else min(expires - utc, 3600.0 * hours)

    def _keep_start(self, t: float) -> None:
        """Try again to keep when the mission began, where the disk did not take it."""
        if not self.missions.start_is_kept and t >= self._start_again:
            self._start_again = t + START_AGAIN
            with suppress(MissionStoreError):
                self.missions.start(self.clock.utc())

    def _restart(self) -> None:
        """End soon, so that the software is started anew."""
        self._ends_at = min(self._ends_at, self.clock.monotonic() + LAST_WORDS)

    def start(self) -> None:
        """Let the mission begin as soon as the start checks have passed, as an operator asks."""
        self.coordinator.request(OperatorRequests(start=True))

    def run(self, seconds: float, stop: Callable[[], bool] = lambda: False) -> Figures:
        """Run for a time [s], or until told to stop; the ports stay open."""
        now = began = self.clock.monotonic()
        due, heard = began, _Heard()
        while not stop() and (now := self.clock.monotonic()) - began < seconds and now < self._ends_at:
            self._listen(heard, now)
            if now >= due:
                self.figures.late += now - due > 0.5 * PERIOD
                due = due + PERIOD if now - due < PERIOD else now + PERIOD
                self._step(heard, now)
                heard = _Heard()
                self.links.observe(now)
            self.links.look(now)
            self.clock.sleep(max(0.0, min(READ_EVERY, due - self.clock.monotonic())))
        self.logbook.sync(self.clock.monotonic())
        self.figures.link_failures, self.figures.restart = self.links.failures, now >= self._ends_at
        return self.figures

    def _listen(self, heard: _Heard, t: float) -> None:
        heard.frames += self.ports.bus.receive()
        for name, port in self.ports.serial.items():
            if name != RADIO:
                heard.bytes[name] = heard.bytes.get(name, b"") + port.read(t)
        for words in self.ports.bus.reports():
            self._tell(t, "can", words)

    def _step(self, heard: _Heard, t: float) -> None:
        try:
            frames, to_ports = self.coordinator.step(t, heard.frames, heard.bytes)
        except Exception as error:  # noqa: BLE001 - without Sync the nodes bring the vehicle up, if this goes on
            self.figures.exceptions += 1
            self._tell(
                t, "exception", f"a step of the coordinator failed: {type(error).__name__}: {one_line(str(error), 200)}"
            )
            return
        for frame in frames:
            self.ports.bus.send(frame)
        for name, data in to_ports.items():
            if name != RADIO:
                self.ports.serial[name].write(data, t)
        self._keep_start(t)
        figures = self.figures
        took = self.clock.monotonic() - t
        figures.decisions += 1
        figures.total_step_s += took
        figures.longest_step_ms = max(figures.longest_step_ms, 1e3 * took)
        self._report()

    def _report(self) -> None:
        """Say what has changed since the last decision."""
        view = self.coordinator.view
        if view is None:
            return
        if view.executive.words != self._words:
            self._words = view.executive.words
            self._say(f"{self._words}: {view.executive.because}")
        alarms = tuple(alarm.name for alarm in view.safety.active)
        if alarms != self._alarms:
            self._alarms = alarms
            self._say(f"alarms: {', '.join(alarms) or 'none'}")

    def _tell(self, t: float, code: str, words: str) -> None:
        self.logbook.event(t, code, words)
        self._say(words)
