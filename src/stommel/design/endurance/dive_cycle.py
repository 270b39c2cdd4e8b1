"""One dive: surface, descend, turn at depth, climb, surface; its times and the energy of each part of the vehicle.

Everything broadcasts: one flight, or a whole grid of speeds, pitches and depths. Equation numbers are those of
docs/theory/energy.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from stommel.analysis import SteadyFlight
from stommel.analysis.reversal import Inertia, departure, reversal
from stommel.analysis.stratified import DiveBallast
from stommel.machinery.power.actuator_work import Quantity
from stommel.machinery.power.model import EnergyModel

Array = NDArray[np.float64]

INFLATE, ANTENNA, DEFLATE = "buoyancy engine: inflating at depth", "buoyancy engine: raising the antenna", "valve"
PITCH, RUDDER, HEAT = "pitch drive", "rudder drive", "battery: heat of its own resistance"
ACTUATORS = (INFLATE, ANTENNA, DEFLATE, PITCH, RUDDER, HEAT)


@dataclass(frozen=True)
class Glides:
    """The dive and the climb between which a cycle turns; numbers or arrays of one shape, SI units and radians."""

    V: Quantity
    """Speed along the path [m/s]."""
    down: Quantity
    """Sinking speed of the dive [m/s]."""
    up: Quantity
    """Rising speed of the climb [m/s]."""
    over_ground_down: Quantity
    """Horizontal speed of the dive [m/s]."""
    over_ground_up: Quantity
    """Horizontal speed of the climb [m/s]."""
    V_dive: Quantity
    """Ballast volume of the dive, negative [m3]."""
    V_climb: Quantity
    """Ballast volume of the climb [m3]."""
    r_dive: Quantity
    """Position of the moving mass in the dive [m]."""
    r_climb: Quantity
    """Position of the moving mass in the climb [m]."""
    pitch_dive: Quantity
    """[rad]."""
    pitch_climb: Quantity
    """[rad]."""
    drive: Quantity
    """Ballast volume beyond neutral that drives the trimmed dive [m3]."""
    sinking_at_drive: Quantity
    """Sinking speed at this drive [m/s]."""
    neutral_top: Quantity = 0.0
    """Ballast volume at which the vehicle is neutral at the surface [m3]."""
    neutral_bottom: Quantity = 0.0
    """The same at the depth of the dive [m3]."""

    def with_ballast(self, ballast: DiveBallast) -> "Glides":
        """The same flights with the ballast, and at the mean speeds, that stratified water gives."""
        slower_down, slower_up = ballast.speed_down / self.V, ballast.speed_up / self.V
        return replace(
            self,
            down=self.down * slower_down,
            over_ground_down=self.over_ground_down * slower_down,
            up=self.up * slower_up,
            over_ground_up=self.over_ground_up * slower_up,
            V_dive=ballast.down,
            V_climb=ballast.up,
            neutral_top=ballast.neutral_top,
            neutral_bottom=ballast.neutral_bottom,
        )


def glides_of(dive: SteadyFlight, climb: SteadyFlight) -> Glides:
    """Return what a cycle needs to know of two steady flights."""
    return Glides(
        V=dive.V,
        down=dive.sinking_speed,
        up=-climb.sinking_speed,
        over_ground_down=dive.horizontal_speed,
        over_ground_up=climb.horizontal_speed,
        V_dive=dive.V_b,
        V_climb=climb.V_b,
        r_dive=dive.r_px,
        r_climb=climb.r_px,
        pitch_dive=dive.theta,
        pitch_climb=climb.theta,
        drive=abs(dive.V_b),
        sinking_at_drive=dive.sinking_speed,
    )


@dataclass(frozen=True)
class DiveCycle:
    """Times and energies of a dive, the mean over the dives from one surfacing to the next."""

    dive_s: Array
    """Time of the descent [s]."""
    climb_s: Array
    """Time of the climb [s]."""
    turn_s: Array
    """Time of the turns, in which no depth is won [s]: oil out at depth, oil in below or at the surface."""
    surface_s: Array
    """Time at the surface: the session, in which the antenna comes out [s]."""
    moving_s: Array
    """Time in which an actuator moves [s]."""
    distance_m: Array
    """Way over the ground in still water [m]."""
    actuators_j: Mapping[str, Array]
    """Electrical energy from the battery by actuator [J]."""
    consumers_j: Mapping[str, Array]
    """Electrical energy from the battery by consumer [J]."""

    @property
    def energy_j(self) -> Mapping[str, Array]:
        """Electrical energy from the battery by actuator and by consumer [J]."""
        return {**self.actuators_j, **self.consumers_j}

    @property
    def duration_s(self) -> Array:
        """Time from dive to dive [s]."""
        return self.dive_s + self.climb_s + self.turn_s + self.surface_s

    @property
    def total_j(self) -> Array:
        """Electrical energy from the battery [J]."""
        return np.asarray(sum(self.energy_j.values()))


@dataclass(frozen=True)
class _Turns:
    """The turns of a cycle: energies [J] and times [s]."""

    inflate_j: Array
    antenna_j: Array
    deflate_j: Array
    pitch_j: Array
    under_water_s: Array
    """In which no depth is won, from surfacing to surfacing over the number of dives."""
    heat_j: Array
    """Of the battery's own resistance while the pump runs."""
    antenna_s: Array
    """Until the antenna is out."""
    moving_s: Array
    """In which pump, valve or pitch drive work, per dive."""


def dive_cycle(model: EnergyModel, glides: Glides, depth_m: Quantity) -> DiveCycle:
    """Follow one dive to `depth_m` [m] with the dive and climb of `glides`."""
    plan, n = model.plan, model.plan.dives_per_surfacing
    h = depth_m - (1.0 - 1.0 / n) * plan.upper_turn_m  # (eq-e1)
    dive_s, climb_s = np.asarray(h / glides.down), np.asarray(h / glides.up)  # (eq-e2)
    turns = _turns(model, glides, depth_m)
    corrections_j, corrections_s = _corrections(model, glides)
    steering_s = plan.rudder_turns_per_dive * model.works.rudder.turn_s
    cycle = DiveCycle(
        dive_s=dive_s,
        climb_s=climb_s,
        turn_s=turns.under_water_s,
        surface_s=np.maximum(turns.antenna_s, plan.surface_session_s) / n,
        moving_s=turns.moving_s + corrections_s + steering_s,
        distance_m=np.asarray(dive_s * glides.over_ground_down + climb_s * glides.over_ground_up),
        actuators_j={
            INFLATE: turns.inflate_j,
            ANTENNA: turns.antenna_j,
            DEFLATE: turns.deflate_j,
            PITCH: turns.pitch_j + corrections_j,
            RUDDER: plan.rudder_turns_per_dive * model.works.rudder.turn(glides.V),
            HEAT: turns.heat_j,
        },
        consumers_j={},
    )
    return fed(cycle, model)


def _turns(model: EnergyModel, glides: Glides, depth_m: Quantity) -> _Turns:
    """Turn at depth; turn below the surface or surface, in their shares of the dives."""
    pump, drive, n = model.works.pump, model.works.pitch, model.plan.dives_per_surfacing
    stay = 1.0 - 1.0 / n  # share of the dives that do not surface
    swing = np.asarray(glides.V_climb) - glides.V_dive
    inflate_j, inflate_s = pump.inflation(swing, model.pressure(depth_m))  # (eq-e4)
    aft_j, aft_s = drive.move(glides.r_dive, glides.r_climb, glides.pitch_dive, glides.pitch_climb)
    forward_j, forward_s = drive.move(glides.r_climb, glides.r_dive, glides.pitch_climb, glides.pitch_dive)
    shallow_j, shallow_s = pump.deflation(swing, model.pressure(model.plan.upper_turn_m))
    antenna_j, antenna_s = pump.inflation(model.surface_volume_m3 - np.asarray(glides.V_climb), 0.0)  # (eq-e5)
    dump_j, dump_s = pump.deflation(model.surface_volume_m3 - np.asarray(glides.V_dive), 0.0)
    deep, shallow, leaving = _turn_times(model, glides, inflate_s, shallow_s, dump_s)
    return _Turns(
        inflate_j=inflate_j,
        antenna_j=antenna_j / n,
        deflate_j=stay * shallow_j + dump_j / n,
        pitch_j=aft_j + forward_j,
        under_water_s=deep + stay * shallow + leaving / n,  # (eq-e3)
        heat_j=_heat(model, inflate_j, inflate_s) + _heat(model, antenna_j, antenna_s) / n,
        antenna_s=np.maximum(antenna_s, forward_s),
        moving_s=np.maximum(inflate_s, aft_s)
        + stay * np.maximum(shallow_s, forward_s)
        + (np.maximum(antenna_s, forward_s) + dump_s) / n,
    )


def _heat(model: EnergyModel, energy: Array, time: Array) -> Array:
    """Heat of the battery's own resistance while an energy is drawn evenly over a time [J]: R (E / V)2 / t."""
    battery = model.battery
    with np.errstate(invalid="ignore", divide="ignore"):
        heat = battery.internal_resistance_ohm * np.square(energy / battery.voltage_v) / time
    return np.asarray(np.where(np.asarray(time) > 0.0, heat, 0.0))


def _turn_times(
    model: EnergyModel, glides: Glides, inflate_s: Array, shallow_s: Array, dump_s: Array
) -> tuple[Array, Array, Array]:
    """Times that turning at depth, turning below the surface, and leaving the surface cost [s]."""
    inertia = Inertia(model.inertia_kg, model.rho * model.g)
    top, bottom = np.asarray(glides.neutral_top), np.asarray(glides.neutral_bottom)
    down_top, up_top = top - glides.V_dive, np.asarray(glides.V_climb) - top
    down_bottom, up_bottom = bottom - glides.V_dive, np.asarray(glides.V_climb) - bottom

    def sinking(drive: Array) -> Array:
        """The vertical speed goes with the root of the ballast beyond neutral."""
        return np.asarray(glides.sinking_at_drive * np.sqrt(drive / glides.drive))

    deep = reversal(inflate_s, down_bottom, up_bottom, sinking(down_bottom), sinking(up_bottom), inertia)
    shallow = reversal(shallow_s, up_top, down_top, sinking(up_top), sinking(down_top), inertia)
    leaving = departure(dump_s, model.surface_volume_m3 - top, down_top, sinking(down_top), inertia)
    return deep, shallow, leaving


def _corrections(model: EnergyModel, glides: Glides) -> tuple[Array, Array]:
    """Energy [J] and time [s] of holding the pitch in a dive; half of it on the way down."""
    distance, times = model.plan.pitch_correction_mm / 1e3, 0.5 * model.plan.pitch_corrections_per_dive
    down_j, down_s = model.works.pitch.to_and_fro(distance, glides.pitch_dive)
    up_j, up_s = model.works.pitch.to_and_fro(distance, glides.pitch_climb)
    return times * (down_j + up_j), times * (down_s + up_s)


def fed(cycle: DiveCycle, model: EnergyModel) -> DiveCycle:
    """Return the same movements with what the consumers of `model` take meanwhile (eq-e9)."""
    under_water = cycle.dive_s + cycle.climb_s + cycle.turn_s
    times = {
        "always": under_water + cycle.surface_s,
        "underwater": under_water,
        "dive": cycle.dive_s,
        "climb": cycle.climb_s,
        "surface": cycle.surface_s,
        "moving": cycle.moving_s,
    }
    return replace(cycle, consumers_j=_consumers(model, times))


def _consumers(model: EnergyModel, times: Mapping[str, Array]) -> dict[str, Array]:
    """Energy that each consumer takes from the battery in a dive [J]."""
    found = {}
    for consumer in model.consumers:
        if consumer.seconds_per_surfacing is None:
            on = consumer.share_on * times[consumer.on]
        else:
            on = np.asarray(consumer.seconds_per_surfacing / model.plan.dives_per_surfacing)
        energy = consumer.power_w * on + consumer.standby_w * (times["always"] - on)
        efficiency = model.plan.regulator_efficiency if consumer.supply == "regulated" else 1.0
        found[consumer.name] = energy / efficiency
    return found
