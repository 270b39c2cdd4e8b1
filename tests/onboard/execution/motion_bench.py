"""A motion-control node on a bench: a coordinator's frames, and a plant written by hand that does what it is told."""

from dataclasses import dataclass, field, replace
from math import nan

from stommel.messages.codec import Decoder, Encoder, Received
from stommel.messages.database import value_named, word_of
from stommel.messages.frames import Frame
from stommel.onboard.execution.motion_io import AT_REST, DriveOutputs, MotionReadings
from stommel.onboard.execution.motion_node import MotionNode
from stommel.onboard.nodes.motion_settings import MotionSettings

LOW, HIGH = -2.5e-4, 2.5e-4
AFT, FORE = -0.05, 0.55


@dataclass
class MotionPlant:
    """Oil, mass and rudder; the flows are those of the paper's engine at the surface and at 200 m."""

    V_b: float = 0.0
    r_px: float = 0.25
    steering: float = 0.0
    pressure: float = 0.0
    """Of the sea, gauge [Pa]."""
    mass_speed: float = 5.0e-3
    steering_speed: float = 0.349
    pump_works: bool = True
    valve_works: bool = True
    mass_works: bool = True
    steering_works: bool = True
    leak: float = 0.0
    """Oil that creeps in through the valve [m3/s]."""
    overwritten: dict[str, float | bool] = field(default_factory=dict)
    """Readings that say something else."""
    running: DriveOutputs = AT_REST

    def readings(self) -> MotionReadings:
        """What the board's pins say."""
        said = MotionReadings(
            self.V_b,
            self.r_px,
            self.steering,
            self.r_px >= FORE - 1e-6,
            self.r_px <= AFT + 1e-6,
            3.0 if self.running.pump else 0.0,
            1.0 if self.running.mass else 0.0,
            1.0 if self.running.steering else 0.0,
        )
        return said._replace(**self.overwritten)

    def move(self, out: DriveOutputs, seconds: float) -> None:
        """Go on for some time."""
        self.running = out
        depth = min(self.pressure / 2e6, 1.0)
        pump, valve = 8.3e-6 - 2.0e-6 * depth, 3.0e-6 + 4.5e-5 * depth
        flow = self.pump_works * pump * out.pump - self.valve_works * valve * out.valve
        self.V_b = min(HIGH, max(LOW, self.V_b + (flow - self.leak) * seconds))
        self.r_px = min(FORE, max(AFT, self.r_px + self.mass_works * self.mass_speed * out.mass * seconds))
        turn = self.steering_works * (not out.brake) * self.steering_speed * out.steering
        self.steering += turn * seconds


class MotionBench:
    """Node, plant and coordinator; each second the node is stepped before and after the coordinator speaks."""

    def __init__(self, interval: float = 1.0, *, start: bool = True, store=None, **settings) -> None:
        self.node = MotionNode(replace(MotionSettings(), **settings), store=store)
        self.plant = MotionPlant()
        self.interval, self.t, self.steps = interval, 0.0, 0
        self.coordinator, self.operator, self.decoder = Encoder(), Encoder(), Decoder()
        self.heard: list[tuple[float, Received]] = []
        self.outputs: list[DriveOutputs] = []
        self.setpoint: tuple[float, float, float] | None = None
        self.sync = True
        self._sequence = 0
        self._waiting: list[Frame] = []
        self._spoke = -1.0
        if start:
            self.command("Start")

    def say(self, message: str, **values: float) -> None:
        """Let the coordinator say something as it speaks next."""
        self._waiting.append(self.coordinator.frame(message, **values))

    def command(self, word: str, target: int = 2, sequence: int | None = None) -> int:
        """Let the coordinator command something; the number of the command."""
        self._sequence += 1
        sequence = self._sequence if sequence is None else sequence
        number = value_named("CoordinatorCommand", "command", word)
        self.say("CoordinatorCommand", target=target, command=number, sequence=sequence, argument=0)
        return sequence

    def go_to(self, ballast: float = 0.0, moving_mass: float = 0.25, steering: float = 0.0) -> None:
        """Set points from now on, said each second."""
        self.setpoint = (ballast, moving_mass, steering)

    def run(self, seconds: float) -> None:
        """Go on."""
        for _ in range(round(seconds / self.interval)):
            self.step()

    def step(self) -> None:
        """One interval."""
        t, readings = self.t, self.plant.readings()
        said, _ = self.node.step(t, [], readings, self.interval)
        frames = []
        if t >= self._spoke + 1.0 - 1e-6:
            self._spoke = t
            if self.sync:
                frames.append(self.coordinator.frame("Sync", vehicle_time=t))
            frames += self._waiting
            self._waiting = []
            if self.setpoint is not None and self.sync:
                values = dict(zip(("ballast", "moving_mass", "steering"), self.setpoint, strict=True))
                frames.append(self.coordinator.frame("MotionSetpoint", **values))
        more, out = self.node.step(t, frames, readings, self.interval)
        for frame in said + more:
            received = self.decoder.take(frame)
            assert isinstance(received, Received), received
            self.heard.append((t, received))
        self.outputs.append(out)
        self.plant.move(out, self.interval)
        self.steps += 1
        self.t = self.steps * self.interval

    def messages(self, name: str) -> list[Received]:
        """All messages of a name so far."""
        return [received for _, received in self.heard if received.name == name]

    def emergencies(self) -> list[tuple[str, bool]]:
        """Faults told so far: code, and whether it began."""
        told = self.messages("MotionEmergency")
        return [
            (word_of("MotionEmergency", "code", int(one.values["code"])), bool(one.values["active"])) for one in told
        ]

    def results(self) -> list[tuple[str, str]]:
        """Commands that were acknowledged, and what became of them."""
        name = "MotionAcknowledgement"
        return [
            (
                word_of(name, "command", int(one.values["command"])),
                word_of(name, "result", int(one.values["result"])),
            )
            for one in self.messages(name)
        ]

    def state(self) -> str:
        """What the last heartbeat said."""
        return word_of("MotionHeartbeat", "state", int(self.messages("MotionHeartbeat")[-1].values["state"]))


NO_READINGS = MotionReadings(nan, nan, nan, False, False, nan, nan, nan)
