"""The hydraulic circuit of a buoyancy engine: its parts, how their ports connect, and what each phase switches.

Parts are lists of tables, one list a kind; a port is written `part.port`. Ports that share a connection form one node:
one pressure, one shaft or one rod. docs/theory/engine has the equations.
"""

from collections.abc import Iterator, Mapping
from math import pi
from types import MappingProxyType
from typing import Annotated, ClassVar, Literal, Self

from pydantic import Field, model_validator

from stommel.files.fields import Name, Table, ordered
from stommel.files.ranges import (
    Current,
    Efficiency,
    NoLoadCurrent,
    Power,
    RotorInertia,
    TorqueConstant,
    Turns,
    Voltage,
    between,
)

Force = Annotated[float, between(0, 5000)]
"""Of friction [N]."""
Resistance = Annotated[float, between(1e-5, 0.4)]
"""Pressure per flow: a bore of a centimetre to one of half a millimetre [MPa s/ml]."""
Loss = Annotated[float, between(0, 0.04)]
"""Pressure per square of the flow: down to a bore of half a millimetre [MPa s2/ml2]."""
Domain = Literal["shaft", "rod", "oil"]


class CircuitPart(Table):
    """A part of the circuit with ports."""

    PORTS: ClassVar[Mapping[str, Domain]] = MappingProxyType({})

    name: Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_-]*$", max_length=40)]
    """Name of the part in `connections`."""


class Motor(CircuitPart):
    """Direct-current motor, brushed or brushless, with a driver that holds its speed."""

    PORTS: ClassVar[Mapping[str, Domain]] = MappingProxyType({"shaft": "shaft"})

    supply_voltage_v: Voltage
    """Voltage of the supply."""
    torque_constant_mn_m_a: TorqueConstant
    """Torque per current; the back-EMF constant is the same number."""
    resistance_ohm: Annotated[float, between(0.001, 200)]
    """Terminal resistance."""
    no_load_current_a: NoLoadCurrent
    """Current that the motor's own friction takes."""
    rotor_inertia_g_cm2: RotorInertia
    """Moment of inertia of the rotor, with that of the gears reduced to it."""
    current_limit_a: Current
    """Greatest current that the driver gives the windings."""
    driver_efficiency: Efficiency = 1.0
    """Share of the supply's power that reaches the windings."""
    ramp_s: Annotated[float, between(0.005, 60)]
    """Time in which the driver brings the motor from rest to its speed, and back to rest."""


class Gearbox(CircuitPart):
    """Reduction between motor and load."""

    PORTS: ClassVar[Mapping[str, Domain]] = MappingProxyType({"input": "shaft", "output": "shaft"})

    ratio: Annotated[float, between(0.05, 3000)]
    """Revolutions of the input per revolution of the output."""
    efficiency: Efficiency
    """Share of the work that passes."""


class Screw(CircuitPart):
    """Screw and nut: turns a shaft's rotation into a rod's travel; forward rotation pushes the piston inwards."""

    PORTS: ClassVar[Mapping[str, Domain]] = MappingProxyType({"shaft": "shaft", "rod": "rod"})

    lead_mm: Annotated[float, between(0.05, 200)]
    """Travel per revolution."""
    efficiency: Efficiency
    """Share of the work that passes."""


class Pump(CircuitPart):
    """Reciprocating pump, seen as its mean flow."""

    PORTS: ClassVar[Mapping[str, Domain]] = MappingProxyType({"shaft": "shaft", "inlet": "oil", "outlet": "oil"})

    displacement_ml_r: Annotated[float, between(0.002, 100)]
    """Oil per revolution without leakage."""
    leakage_ml_s_mpa: Annotated[float, between(0, 20)] = 0.0
    """Leakage from outlet to inlet per pressure difference."""
    friction_n_m: Annotated[float, between(0, 20)] = 0.0
    """Constant friction torque."""
    friction_share: Annotated[float, between(0, 5)] = 0.0
    """Friction torque proportional to pressure, as a share of the ideal torque."""
    damping_n_m_s: Annotated[float, between(0, 0.2)] = 0.0
    """Friction torque proportional to speed."""


class Piston(CircuitPart):
    """What a cylinder with a free piston and one with a driven piston share."""

    bore_mm: Annotated[float, between(2, 500)]
    """Diameter of the piston."""
    stroke_mm: Annotated[float, between(2, 3000)]
    """Travel between the mechanical end stops; at zero the chamber is empty."""
    working_range_mm: tuple[Annotated[float, between(0, 3000)], Annotated[float, between(0, 3000)]]
    """Positions between which the controller moves the piston; bladder inflated first."""
    coulomb_n: Force = 0.0
    """Coulomb friction."""
    stribeck_n: Force = 0.0
    """Friction at rest above the Coulomb friction."""
    stribeck_mm_s: Annotated[float, between(0.01, 1000)] = 0.5
    """Velocity at which 1/e of that remains."""
    viscous_n_s_m: Annotated[float, between(0, 2e5)] = 0.0
    """Friction per velocity."""
    gas_pressure_mpa: Annotated[float, between(-0.1013, 1)] = 0.0
    """Gauge pressure behind the piston; negative in an evacuated hull."""

    @property
    def area_m2(self) -> float:
        """Cross-section S [m2]."""
        return pi / 4 * (self.bore_mm / 1e3) ** 2

    @property
    def working_volume_ml(self) -> float:
        """Oil that the working range moves [ml]."""
        return self.area_m2 * (self.working_range_mm[1] - self.working_range_mm[0]) * 1e3

    @model_validator(mode="after")
    def _range_lies_within_the_stroke(self) -> Self:
        ordered("working_range_mm", self.working_range_mm)
        if self.working_range_mm[0] < 0.0 or self.working_range_mm[1] > self.stroke_mm:
            raise ValueError(
                f"working_range_mm = {list(self.working_range_mm)}: must lie within the stroke, 0 to {self.stroke_mm:g}"
            )
        return self


class Reservoir(Piston):
    """Oil reservoir inside the hull: a cylinder with a free piston."""

    PORTS: ClassVar[Mapping[str, Domain]] = MappingProxyType({"oil": "oil"})

    piston_mass_kg: Annotated[float, between(0.001, 100)]
    """Mass that moves with the piston."""


class Cylinder(Piston):
    """Cylinder whose piston is driven by its rod: a single-stroke pump."""

    PORTS: ClassVar[Mapping[str, Domain]] = MappingProxyType({"rod": "rod", "oil": "oil"})


class Line(CircuitPart):
    """Hose, pipe or bore: a pressure loss between its ends."""

    PORTS: ClassVar[Mapping[str, Domain]] = MappingProxyType({"a": "oil", "b": "oil"})

    resistance_mpa_s_ml: Resistance
    """Laminar loss per flow."""
    loss_mpa_s2_ml2: Loss = 0.0
    """Turbulent loss per flow squared."""


class CheckValve(CircuitPart):
    """Valve that lets oil pass from its inlet to its outlet only."""

    PORTS: ClassVar[Mapping[str, Domain]] = MappingProxyType({"inlet": "oil", "outlet": "oil"})

    cracking_pressure_mpa: Annotated[float, between(0, 5)]
    """Pressure difference at which it opens."""
    resistance_mpa_s_ml: Resistance
    """Loss per flow above the cracking pressure."""


class SolenoidValve(CircuitPart):
    """Valve that a phase opens; closed without current."""

    PORTS: ClassVar[Mapping[str, Domain]] = MappingProxyType({"a": "oil", "b": "oil"})

    resistance_mpa_s_ml: Resistance
    """Laminar loss per flow when open."""
    loss_mpa_s2_ml2: Loss = 0.0
    """Turbulent loss per flow squared when open."""
    power_w: Power = 0.0
    """Power of the coil while it is open."""


class Accumulator(CircuitPart):
    """Gas-loaded oil store."""

    PORTS: ClassVar[Mapping[str, Domain]] = MappingProxyType({"oil": "oil"})

    gas_volume_ml: Annotated[float, between(0.5, 20000)]
    """Volume of the gas when there is no oil in it."""
    precharge_mpa: Annotated[float, between(0.01, 120)]
    """Gauge pressure of the gas when there is no oil in it."""
    polytropic_exponent: Annotated[float, between(1, 1.7)] = 1.2
    """1 for slow, 1.4 for fast changes."""


class Bladder(CircuitPart):
    """Volume on which the sea presses: an external bladder, or the sea itself before a single-stroke pump."""

    PORTS: ClassVar[Mapping[str, Domain]] = MappingProxyType({"oil": "oil"})

    stiffness_mpa_ml: Annotated[float, between(0, 1)] = 0.0
    """Rise of the pressure inside above the sea's, per volume."""


class DisplacementSensor(Table):
    """Sensor that measures a piston's position and tells the controller when to stop."""

    measures: Name
    """Name of the reservoir or cylinder."""
    resolution_mm: Annotated[float, between(0.0001, 10)]
    """Least step of its reading."""


class Oil(Table):
    """The fluid, and what of it stands in every node of the circuit."""

    bulk_modulus_mpa: Annotated[float, between(50, 5000)]
    """Pressure per relative compression, with dissolved gas and hoses."""
    node_volume_ml: Annotated[float, between(0.1, 2000)]
    """Oil in bores and fittings of one node."""


class EnginePhase(Table):
    """What the controller switches on to inflate or to deflate."""

    motor_speed_rpm: Annotated[float, between(-50000, 50000)] = 0.0
    """Speed of the motor; negative turns backwards; zero leaves it locked."""
    open_valves: tuple[Name, ...] = ()
    """Solenoid valves that are open."""


class Engine(Table):
    """Hydraulic circuit of the buoyancy engine."""

    connections: tuple[tuple[Name, ...], ...]
    """Ports that share a node: `["pump.outlet", "check.inlet"]`."""
    oil: Oil
    sensor: DisplacementSensor
    inflate: EnginePhase
    deflate: EnginePhase
    motors: tuple[Motor, ...] = ()
    gearboxes: tuple[Gearbox, ...] = ()
    screws: tuple[Screw, ...] = ()
    pumps: tuple[Pump, ...] = ()
    reservoirs: tuple[Reservoir, ...] = ()
    cylinders: tuple[Cylinder, ...] = ()
    lines: tuple[Line, ...] = ()
    check_valves: tuple[CheckValve, ...] = ()
    solenoid_valves: tuple[SolenoidValve, ...] = ()
    accumulators: tuple[Accumulator, ...] = ()
    bladders: tuple[Bladder, ...] = ()
    ideal_pump_speed_rpm: Turns | None = None
    """Speed of the pump or screw in the case without losses; that of the inflating motor if left out."""

    def parts(self) -> Iterator[CircuitPart]:
        """All parts, kind by kind."""
        for kind in (
            self.motors, self.gearboxes, self.screws, self.pumps, self.reservoirs, self.cylinders, self.lines,
            self.check_valves, self.solenoid_valves, self.accumulators, self.bladders,
        ):  # fmt: skip
            yield from kind

    @property
    def measured_piston(self) -> Piston:
        """The reservoir or cylinder that the sensor measures."""
        return next(piston for piston in (*self.reservoirs, *self.cylinders) if piston.name == self.sensor.measures)

    @model_validator(mode="after")
    def _circuit_is_possible(self) -> Self:
        wrong = list(_circuit_problems(self))
        if wrong:
            raise ValueError("\n".join(wrong))
        return self


def _circuit_problems(engine: Engine) -> Iterator[str]:
    """Say what makes a circuit impossible to build."""
    parts: dict[str, CircuitPart] = {}
    for part in engine.parts():
        if part.name in parts:
            yield f"two parts have the name {part.name!r}; names must differ"
        parts[part.name] = part
    yield from _port_problems(engine, parts)
    yield from _signal_problems(engine)


def _port_problems(engine: Engine, parts: Mapping[str, CircuitPart]) -> Iterator[str]:
    used: dict[str, int] = {}
    for k, ports in enumerate(engine.connections):
        if len(ports) < 2:
            yield f"connections.{k} = {list(ports)}: must join at least two ports"
        domains: dict[str, Domain] = {}
        for port in ports:
            owner, _, name = port.partition(".")
            if owner not in parts:
                yield f"connections.{k}: unknown component {owner!r} in {port!r}; there are: {', '.join(parts)}"
                continue
            known = parts[owner].PORTS
            if name not in known:
                yield f"connections.{k}: {owner!r} has no port {name!r}; its ports are: {', '.join(known)}"
                continue
            if port in used:
                yield f"connections.{k}: port {port!r} is already in connections.{used[port]}"
            used[port] = k
            domains[port] = known[name]
        if len(set(domains.values())) > 1:
            kinds = ", ".join(f"{port} ({domain})" for port, domain in domains.items())
            yield f"connections.{k}: joins ports of different kinds: {kinds}"
    loose = [f"{p.name}.{port}" for p in parts.values() for port in p.PORTS if f"{p.name}.{port}" not in used]
    if loose:
        yield f"unconnected port{'s' if len(loose) > 1 else ''}: {', '.join(loose)}"


def _signal_problems(engine: Engine) -> Iterator[str]:
    pistons = [piston.name for piston in (*engine.reservoirs, *engine.cylinders)]
    if engine.sensor.measures not in pistons:
        yield f"sensor.measures = {engine.sensor.measures!r}: must be a reservoir or cylinder: {', '.join(pistons)}"
    valves = [valve.name for valve in engine.solenoid_valves]
    for phase, settings in (("inflate", engine.inflate), ("deflate", engine.deflate)):
        for name in settings.open_valves:
            if name not in valves:
                yield f"{phase}.open_valves: unknown solenoid valve {name!r}; there are: {', '.join(valves) or 'none'}"
        if settings.motor_speed_rpm == 0.0 and not settings.open_valves:
            yield f"{phase}: neither turns the motor nor opens a valve"
    for kind, count in (("motors", len(engine.motors)), ("bladders", len(engine.bladders))):
        if count != 1:
            yield f"{kind}: exactly one is needed, there are {count}"
