"""The whole vehicle in its ocean, second by second: plant, nodes, instruments, coordination software.

In each step the plant's sensors speak first, then the nodes tell what they measure, the coordinator decides, and the
motion-control node obeys; all through frames of the bus and bytes of the instruments.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import degrees, inf
from pathlib import Path

import numpy as np

from stommel import __version__
from stommel.control.commands import GOING_ON
from stommel.control.decision import decide
from stommel.link.channel.settings import ChannelSettings
from stommel.link.signing.guard import Guard
from stommel.messages.database import ACQUISITION, COORDINATOR, MOTION, database_hash
from stommel.messages.frames import Frame
from stommel.onboard.coordination.coordinator import Coordinator
from stommel.onboard.coordination.logbook.framing import LogIdentity
from stommel.onboard.coordination.logbook.logbook import Logbook
from stommel.onboard.coordination.own_instruments import COMPASS, GNSS, RADIO
from stommel.onboard.coordination.situation import OperatorRequests
from stommel.onboard.coordination.stores.continuity import ContinuityStore
from stommel.onboard.execution.acquisition_io import AcquisitionOutputs, AcquisitionReadings
from stommel.onboard.execution.acquisition_node import AcquisitionNode
from stommel.onboard.execution.motion_io import AT_REST, DriveOutputs, MotionReadings
from stommel.onboard.execution.motion_node import MotionNode
from stommel.onboard.execution.node_states import Mode
from stommel.simulation.plant.driven import Drives
from stommel.simulation.scenario.mission import Mission
from stommel.sitl.can_bus import SimulatedBus
from stommel.sitl.ctd_port import CtdPort
from stommel.sitl.equipment import acquisition_settings, coordinator_settings, known_disturbances, motion_settings
from stommel.sitl.faults.disk import MemoryDisk
from stommel.sitl.faults.injector import Injector
from stommel.sitl.instruments import CompassPort, GnssPort, compass_truth
from stommel.sitl.nodes import FILES, Acquisition, Bus, Motion, store_of
from stommel.sitl.payload import NOTHING, Payload
from stommel.sitl.plant import Felt, Plant
from stommel.sitl.radio.air import Air, End
from stommel.sitl.radio.station import SYSTEM, Station

NODES = (COORDINATOR, MOTION, ACQUISITION)
_SWITCHED_OFF = AcquisitionOutputs(0, False, inf, False, b"")


@dataclass
class Ports:
    """Instruments at their serial ports, and the bytes that are on their way to them."""

    compass: CompassPort = field(default_factory=CompassPort)
    gnss: GnssPort = field(default_factory=GnssPort)
    ctd: CtdPort = field(default_factory=CtdPort)
    to: dict[str, bytes] = field(default_factory=dict)
    to_ctd: bytes = b""


class System:
    """Plant and software of a mission, on virtual time.

    Parameters
    ----------
    mission
        From `stommel.load_mission`.
    logbook
        Where the coordinator's records go; None keeps none.
    inject
        Faults; none if left out. If it has a disk, logbooks are kept there, a new one at each start of the coordinator.
    expires
        Time of the mission at which its time is over for the software [s].
    parameters
        Folder in which the nodes keep their parameters; None: they keep them for this flight.
    radio
        What the air is like; as on a calm day if left out.
    shore
        Whoever is at the other end of the radio; nobody if left out.
    guard
        Whom the vehicle believes; everybody if left out.

    Raises
    ------
    StommelError
        The vehicle cannot fly the dives that the plan asks for.
    """

    def __init__(
        self,
        mission: Mission,
        logbook: Logbook | None = None,
        inject: Injector | None = None,
        expires: float = inf,
        radio: ChannelSettings | None = None,
        shore: End | None = None,
        guard: Guard | None = None,
        parameters: Path | None = None,
    ) -> None:
        self.mission = mission
        self.inject = Injector() if inject is None else inject
        self.plant = Plant.of(mission)
        setup = self.plant.setup
        machinery, orders = setup.equipment.plant, setup.orders
        self.ports = Ports()
        self.bus: Bus = SimulatedBus(NODES)
        self.parameters = parameters
        self._stores = {node: store_of(node, parameters) for node in FILES}
        self.motion: Motion = MotionNode(motion_settings(machinery, orders), store=self._stores[MOTION])
        self.acquisition: Acquisition = AcquisitionNode(
            acquisition_settings(machinery), store=self._stores[ACQUISITION], ctd=self.ports.ctd
        )
        self.expires = expires
        self.payload = Payload(mission.scenario)
        self.switched = _SWITCHED_OFF
        self.outputs = AT_REST
        """What the motion node told the power stages last."""
        self.restarts = dict.fromkeys(NODES, 0)
        """How often each computer has started anew."""
        self._kept = MemoryDisk() if self.inject.disk is None else self.inject.disk
        channel = ChannelSettings() if radio is None else radio
        self.air = Air(self.plant, channel, shore)
        self._station = Station(mission, setup, self._kept, channel, Guard.unsigned(SYSTEM) if guard is None else guard)
        self.coordinator = self._started_coordinator(0.0, logbook)
        self.link = self._station.link(self.coordinator, expires)
        self.coordinator.request(OperatorRequests(start=True))

    @property
    def running(self) -> bool:
        """Whether the mission goes on."""
        return self.plant.running

    @property
    def motion_mode(self) -> Mode | None:
        """What the motion-control node is about; None if it is in a process of its own."""
        return self.motion.link.modes.mode if isinstance(self.motion, MotionNode) else None

    @property
    def notes(self) -> list[str]:
        """What was wrong with the parameters that the nodes of this process have kept, in words."""
        nodes = ((MOTION, self.motion), (ACQUISITION, self.acquisition))
        return [
            f"{FILES[number]} node: {note}"
            for number, node in nodes
            if isinstance(node, MotionNode | AcquisitionNode)
            for note in node.link.notes
        ]

    def step(self) -> None:
        """Let one step pass."""
        plant, t, inject = self.plant, self.plant.time, self.inject
        if isinstance(self.bus, SimulatedBus):  # faults reach no other
            for node in inject.begin(plant, self.bus):
                self._restart(node, t)
        felt = inject.felt(plant.feel())
        if not plant.running:
            return
        readings = self._motion_readings(felt)
        self._acquire(felt, t)
        self._move(t, readings)
        self._coordinate(felt, t)
        outputs = self._move(t, readings)
        self._call(t)
        plant.move(self._drives(outputs), self._memory())

    def _say(self, node: int, frames: list[Frame]) -> None:
        self.bus.send(node, self.inject.sent(node, frames))

    def _move(self, t: float, readings: MotionReadings) -> DriveOutputs:
        """Let the motion-control node have its step; without power nothing moves."""
        heard = self.bus.receive(MOTION)
        if not self.inject.runs(MOTION):
            self.outputs = AT_REST
            return self.outputs
        frames, self.outputs = self.motion.step(t, heard, readings, self.plant.step)
        self._say(MOTION, frames)
        if self.inject.falls(MOTION):
            self.outputs = AT_REST
        return self.outputs

    def _coordinate(self, felt: Felt, t: float) -> None:
        """Let the coordinator have its step, by its own clock."""
        inject, heard, said = self.inject, self.bus.receive(COORDINATOR), self._bytes(felt, t)
        if not inject.runs(COORDINATOR):
            self.ports.to = {}
            return
        if inject.expired():
            self.coordinator.expires = -inf
        frames, self.ports.to = self.coordinator.step(inject.clock(t), heard, said)
        self._say(COORDINATOR, frames)
        if inject.falls(COORDINATOR):
            inject.lose_power()

    def _call(self, t: float) -> None:
        """Let vehicle and shore speak to each other by radio for a step."""
        inject = self.inject
        runs, clock = inject.runs(COORDINATOR), inject.clock(t)
        fed = self.switched.radio or self.air.tethered
        if runs:
            self.link.observe(clock)
            if not fed:
                self.link.rest(clock)
        self.air.worsen(inject.radio_loss())
        on = fed and inject.radio_works()
        self.air.pass_time(self.link if runs else None, t, self.plant.step, clock - t, on=on)

    def _started_coordinator(self, t: float, logbook: Logbook | None) -> Coordinator:
        """Switch the coordinator on, with what its disk keeps of the time before."""
        setup, inject = self.plant.setup, self.inject
        every, sensors = self.mission.scenario.sampling.every_s, setup.equipment.sensors
        if inject.disk is not None:
            identity = LogIdentity(__version__, database_hash(), self.mission.vehicle.name)
            logbook = inject.new_logbook(inject.disk, identity, t)
        coordinator = Coordinator(
            coordinator_settings(setup, every, known_disturbances(sensors)), inject.clock(t), logbook=logbook,
            store=ContinuityStore(self._kept), decision=inject.decision() or decide,
        )  # fmt: skip
        coordinator.adopt(setup.orders, self.expires, mission=1)
        return coordinator

    def _restart(self, node: int, t: float) -> None:
        """Let a computer start anew after a loss of power, with what its store keeps."""
        self.restarts[node] += 1
        self.bus.receive(node)
        restarts, store = self.restarts[node], self._stores.get(node)
        machinery, orders = self.plant.setup.equipment.plant, self.plant.setup.orders
        if node == MOTION:
            self.motion = MotionNode(motion_settings(machinery, orders), restarts, store)
        elif node == ACQUISITION:
            settings = acquisition_settings(machinery)
            self.acquisition = AcquisitionNode(settings, restarts, store, ctd=self.ports.ctd)
        else:
            self.coordinator = self._started_coordinator(t, self.coordinator.recorder.logbook)
            self.link = self._station.link(self.coordinator, self.expires)

    def _acquire(self, felt: Felt, t: float) -> None:
        """Let the acquisition node and its CTD have their step."""
        ctd, heard = self.ports.ctd, self.bus.receive(ACQUISITION)
        if not self.inject.runs(ACQUISITION):
            self.switched, self.ports.to_ctd = _SWITCHED_OFF, b""
            return
        latitude, longitude = degrees(self.plant.setup.world["latitude"]), degrees(self.plant.setup.world["longitude"])
        sampling = self.switched.sampling
        every = self.switched.sample_interval
        truth = self.payload.truth(self.plant, latitude, longitude, self._utc(t), every) if sampling else NOTHING
        said = self.inject.heard("ctd", ctd.exchange(self.ports.to_ctd, self.inject.ctd(truth), t))
        frames, self.switched = self.acquisition.step(t, heard, self._acquisition_readings(felt), said)
        self.ports.to_ctd = self.switched.ctd_bytes
        self._say(ACQUISITION, frames)

    def _bytes(self, felt: Felt, t: float) -> Mapping[str, bytes]:
        """Bytes of the coordinator's instruments."""
        ports, setup = self.ports, self.plant.setup
        truth = compass_truth(felt, setup.equipment.sensors.declination, float(setup.world["thermistor"]))
        compass = ports.compass.exchange(ports.to.get(COMPASS, b""), truth, t)
        gnss = ports.gnss.exchange(ports.to.get(GNSS, b""), felt, self._utc(t), t, on=self.switched.radio)
        heard = self.inject.heard
        return {COMPASS: heard("compass", compass), GNSS: heard("gps", gnss), RADIO: b""}

    def _utc(self, t: float) -> float:
        return self.plant.setup.loop.start + t

    def _motion_readings(self, felt: Felt) -> MotionReadings:
        r, currents = felt.readings, felt.currents
        return MotionReadings(
            r.V_b, r.r_px, r.steering, felt.limit_fore, felt.limit_aft, currents.pump, currents.mass, currents.steering
        )

    def _acquisition_readings(self, felt: Felt) -> AcquisitionReadings:
        r, world = felt.readings, self.plant.setup.world
        return AcquisitionReadings(
            depth=r.depth,
            altitude=r.altitude,
            leak_fore=r.leak,
            leak_aft=False,
            leak_loop=self.inject.leak_loop(),
            internal_pressure=r.internal_pressure,
            hull_temperature=float(world["air_temperature"]) - 273.15,
            voltage=r.voltage,
            current=r.current,
            battery_temperature=float(world["air_temperature"]) - 273.15,
        )

    def _drives(self, outputs: DriveOutputs) -> Drives:
        switched, view = self.switched, self.coordinator.view
        ended = GOING_ON if view is None or not self.inject.runs(COORDINATOR) else view.commands.ended
        return Drives(*outputs, switched.loads, switched.sampling, switched.radio, ended)

    def _memory(self) -> np.record:
        memory = self.coordinator.pilot.memory
        return self.plant.setup.memory if memory is None else memory
