"""The whole vehicle in its ocean, second by second: plant, nodes, instruments, coordination software.

In each step the plant's sensors speak first, then the nodes tell what they measure, the coordinator decides, and the
motion-control node obeys; all through frames of the bus and bytes of the instruments.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import degrees

import numpy as np

from stommel.control.commands import GOING_ON
from stommel.control.decision import decide
from stommel.messages.database import ACQUISITION, COORDINATOR, MOTION
from stommel.onboard.coordination.coordinator import COMPASS, GNSS, RADIO, Coordinator
from stommel.onboard.coordination.logbook.logbook import Logbook
from stommel.onboard.coordination.situation import OperatorRequests
from stommel.onboard.execution.acquisition_io import AcquisitionOutputs, AcquisitionReadings
from stommel.onboard.execution.acquisition_node import AcquisitionNode
from stommel.onboard.execution.motion_io import DriveOutputs, MotionReadings
from stommel.onboard.execution.motion_node import MotionNode
from stommel.simulation.plant.driven import Drives
from stommel.simulation.scenario.mission import Mission
from stommel.sitl.can_bus import SimulatedBus
from stommel.sitl.ctd_port import CtdPort
from stommel.sitl.equipment import acquisition_settings, coordinator_settings, known_disturbances, motion_settings
from stommel.sitl.instruments import CompassPort, GnssPort, compass_truth
from stommel.sitl.nodes import Acquisition, Bus, Motion
from stommel.sitl.payload import NOTHING, Payload
from stommel.sitl.plant import Felt, Plant

NODES = (COORDINATOR, MOTION, ACQUISITION)
_SWITCHED_OFF = AcquisitionOutputs(0, False, False, b"")


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

    Raises
    ------
    StommelError
        The vehicle cannot fly the dives that the plan asks for.
    """

    def __init__(self, mission: Mission, logbook: Logbook | None = None) -> None:
        self.mission = mission
        self.plant = Plant.of(mission)
        setup = self.plant.setup
        machinery, orders = setup.equipment.plant, setup.orders
        self.ports = Ports()
        self.bus: Bus = SimulatedBus(NODES)
        self.motion: Motion = MotionNode(motion_settings(machinery, orders))
        self.acquisition: Acquisition = AcquisitionNode(acquisition_settings(machinery), ctd=self.ports.ctd)
        scenario = mission.scenario
        settings = coordinator_settings(setup, scenario.sampling.every_s, known_disturbances(setup.equipment.sensors))
        self.coordinator = Coordinator(settings, 0.0, logbook=logbook, decision=decide)
        self.coordinator.adopt(orders)
        self.coordinator.request(OperatorRequests(start=True))
        self.payload = Payload(scenario)
        self.switched = _SWITCHED_OFF

    @property
    def running(self) -> bool:
        """Whether the mission goes on."""
        return self.plant.running

    def step(self) -> None:
        """Let one step pass."""
        plant, bus, t = self.plant, self.bus, self.plant.time
        felt = plant.feel()
        if not plant.running:
            return
        readings = self._motion_readings(felt)
        self._acquire(felt, t)
        frames, _ = self.motion.step(t, bus.receive(MOTION), readings, plant.step)
        bus.send(MOTION, frames)
        frames, to_ports = self.coordinator.step(t, bus.receive(COORDINATOR), self._bytes(felt, t))
        bus.send(COORDINATOR, frames)
        self.ports.to = to_ports
        frames, outputs = self.motion.step(t, bus.receive(MOTION), readings, plant.step)
        bus.send(MOTION, frames)
        plant.move(self._drives(outputs), self._memory())

    def _acquire(self, felt: Felt, t: float) -> None:
        """Let the acquisition node and its CTD have their step."""
        ctd = self.ports.ctd
        latitude, longitude = degrees(self.plant.setup.world["latitude"]), degrees(self.plant.setup.world["longitude"])
        sampling = self.switched.sampling
        truth = self.payload.truth(self.plant, latitude, longitude, self._utc(t)) if sampling else NOTHING
        said = ctd.exchange(self.ports.to_ctd, truth, t)
        frames, self.switched = self.acquisition.step(
            t, self.bus.receive(ACQUISITION), self._acquisition_readings(felt), said
        )
        self.ports.to_ctd = self.switched.ctd_bytes
        self.bus.send(ACQUISITION, frames)

    def _bytes(self, felt: Felt, t: float) -> Mapping[str, bytes]:
        """Bytes of the coordinator's instruments."""
        ports, setup = self.ports, self.plant.setup
        truth = compass_truth(felt, setup.equipment.sensors.declination, float(setup.world["thermistor"]))
        return {
            COMPASS: ports.compass.exchange(ports.to.get(COMPASS, b""), truth, t),
            GNSS: ports.gnss.exchange(ports.to.get(GNSS, b""), felt, self._utc(t), t, on=self.switched.radio),
            RADIO: b"",
        }

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
            leak_loop=True,
            internal_pressure=r.internal_pressure,
            hull_temperature=float(world["air_temperature"]) - 273.15,
            voltage=r.voltage,
            current=r.current,
            battery_temperature=float(world["air_temperature"]) - 273.15,
        )

    def _drives(self, outputs: DriveOutputs) -> Drives:
        switched, view = self.switched, self.coordinator.view
        ended = GOING_ON if view is None else view.commands.ended
        return Drives(*outputs, switched.loads, switched.sampling, switched.radio, ended)

    def _memory(self) -> np.record:
        memory = self.coordinator.pilot.memory
        return self.plant.setup.memory if memory is None else memory
