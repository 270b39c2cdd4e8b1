"""What an energy balance needs from a vehicle file, gathered and checked once."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from stommel.errors import FileError, Problem
from stommel.machinery.power.actuator_models import ACTUATORS, PLAN_KEYS, ActuatorModels, ActuatorWorks
from stommel.machinery.power.actuator_work import Quantity
from stommel.machinery.power.stored_energy import StoredEnergy, stored_energy
from stommel.vehicle import Vehicle, VehicleFile
from stommel.vehicle.schema import Battery, Consumer, EnergyPlan

DEEPEST_M = 1000.0
"""Depth that the cost of the pump is tabulated to where the hull has no rating [m]."""


@dataclass(frozen=True)
class EnergyModel:
    """Battery, plan, consumers and actuators of one vehicle in one water."""

    battery: Battery
    plan: EnergyPlan
    consumers: tuple[Consumer, ...]
    works: ActuatorWorks
    actuators: ActuatorModels
    """Computes the costs of the actuators anew for another plan."""
    rho: float
    """Density of the water [kg/m3]."""
    g: float
    """Gravity [m/s2]."""
    temperature_c: float
    """Temperature of the water, and so of the battery [deg C]."""
    surface_volume_m3: float
    """Ballast volume that raises the antenna [m3]."""
    inertia_kg: float
    """Mass of the vehicle with the added mass along its axis [kg]."""
    deepest_m: float
    """Depth that the hull is rated for [m]."""

    def pressure(self, depth_m: Quantity) -> Quantity:
        """Gauge pressure at a depth [Pa]: rho g z."""
        return self.rho * self.g * depth_m

    @property
    def stored(self) -> StoredEnergy:
        """What the battery gives."""
        return stored_energy(self.battery, self.temperature_c)

    def changed(self, key: str, value: float) -> "EnergyModel":
        """Return the model with one number changed, by its dotted key in the vehicle file; unvalidated.

        The keys `works.pump`, `works.pitch` and `works.rudder` multiply an actuator's energy.
        """
        table, _, name = key.partition(".")
        for actuator in ACTUATORS:
            if key == f"works.{actuator}":
                return replace(self, works=self.works.scaled(actuator, value))
        if table == "battery":
            return replace(self, battery=self.battery.model_copy(update={name: value}))
        if table == "water":
            return replace(self, temperature_c=value)
        if table == "energy":
            plan = self.plan.model_copy(update={name: value})
            works = self._works_under(plan, name)
            surface = value / 1e6 if name == "surface_ballast_ml" else self.surface_volume_m3
            return replace(self, plan=plan, works=works, surface_volume_m3=surface)
        index, _, name = name.partition(".")
        consumers = list(self.consumers)
        consumers[int(index)] = consumers[int(index)].model_copy(update={name: value})
        return replace(self, consumers=tuple(consumers))

    def _works_under(self, plan: EnergyPlan, changed: str) -> ActuatorWorks:
        """Costs of the actuators after one key of the plan has changed."""
        if changed in PLAN_KEYS["pump"]:
            return replace(self.works, pump=self.actuators.pump(plan))
        if changed in PLAN_KEYS["pitch"]:
            return replace(self.works, pitch=self.actuators.pitch(plan))
        if changed in PLAN_KEYS["rudder"] | {"rudder_turn_deg", "rudder_hold_s"}:
            return replace(self.works, rudder=self.actuators.rudder(plan))
        return self.works


def energy_model(vehicle: Vehicle, *, temperature_c: float | None = None) -> EnergyModel:
    """Gather what the energy balance of a vehicle needs.

    Parameters
    ----------
    temperature_c
        Temperature of the water [deg C]; the reference water's if left out.

    Raises
    ------
    FileError
        The vehicle file lacks what this needs; the error names every key.
    """
    d = vehicle.description
    deepest = d.hull.depth_rating_m if d.hull and d.hull.depth_rating_m else DEEPEST_M
    actuators = ActuatorModels(vehicle, vehicle.neutral_density_kg_m3 * d.water.gravity_m_s2 * deepest)
    lacking = [*_lacking(d), *actuators.lacking()]
    if lacking:
        raise FileError([Problem(vehicle.origin, key, f"{key} is missing: {why}") for key, why in lacking])
    battery, plan, engine = d.battery, d.energy, d.actuators.buoyancy
    assert battery is not None
    assert plan is not None
    assert engine is not None
    _check_consumers(vehicle.origin, plan, d.consumers)
    surface = plan.surface_ballast_ml if plan.surface_ballast_ml is not None else engine.range_ml[1]
    return EnergyModel(
        battery=battery,
        plan=plan,
        consumers=d.consumers,
        works=actuators.works(plan),
        actuators=actuators,
        rho=vehicle.neutral_density_kg_m3,
        g=d.water.gravity_m_s2,
        temperature_c=d.water.temperature_c if temperature_c is None else temperature_c,
        surface_volume_m3=surface / 1e6,
        inertia_kg=d.mass_kg + d.added_inertia.surge_kg,
        deepest_m=deepest,
    )


def _lacking(d: VehicleFile) -> Iterator[tuple[str, str]]:
    """Yield (key, what to do) of everything that the energy balance needs and the file does not say."""
    if d.battery is None:
        yield "[battery]", "endurance needs it, with capacity_ah, voltage_v, chemistry and usable_fraction"
    elif d.battery.usable_fraction is None:
        yield "battery.usable_fraction", "endurance needs the part of the energy that may be taken, 0 to 1"
    if d.battery is not None and d.battery.self_discharge_per_month is None:
        yield "battery.self_discharge_per_month", "endurance needs the part lost in 30 days, 0 to 1"
    if d.energy is None:
        yield "[energy]", "endurance needs it, with regulator_efficiency, surface_session_s and slowest_speed_m_s"
    if not d.consumers:
        yield "[[consumers]]", "endurance needs at least one, with name, part and power_w"


def _check_consumers(origin: str, plan: EnergyPlan, consumers: tuple[Consumer, ...]) -> None:
    """Refuse a consumer that is on for longer than the vehicle stays at the surface, and a name that is used twice."""
    wrong = [
        Problem(
            origin,
            f"consumers.{i}.seconds_per_surfacing",
            f"consumers.{i}.seconds_per_surfacing = {consumer.seconds_per_surfacing:g} ({consumer.name}): must be at "
            f"most energy.surface_session_s = {plan.surface_session_s:g}",
        )
        for i, consumer in enumerate(consumers)
        if consumer.seconds_per_surfacing is not None and consumer.seconds_per_surfacing > plan.surface_session_s
    ]
    names = [consumer.name for consumer in consumers]
    wrong += [
        Problem(origin, f"consumers.{i}.name", f"consumers.{i}.name = {name!r}: two consumers have this name")
        for i, name in enumerate(names)
        if name in names[:i]
    ]
    if wrong:
        raise FileError(wrong)
