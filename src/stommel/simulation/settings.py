"""A mission's plan as the numbers that the mission loop is told, SI units and radians."""

from math import ceil, exp, inf, nan, radians

import numpy as np
from numpy.typing import NDArray

from stommel.analysis.flight_table import fastest_mode
from stommel.control.dive_cycle import PHASES, DivePlan
from stommel.control.flight_table import FlightTable, look_up
from stommel.control.laws import DriftLaw, HeadingLaw, PitchLaw
from stommel.planning.ballasting import ballast_volumes, drives, mass_position_at_rest, neutral_volumes
from stommel.planning.mission import Mission
from stommel.simulation.mission_loop import GUIDANCE_PERIOD, Orders
from stommel.simulation.plant.hull_air import KELVIN
from stommel.simulation.plant.parameters import Loop, Plant
from stommel.simulation.plant.sensors import Alarms, Hull, Sensors
from stommel.simulation.scenario.mission_file import MissionFile
from stommel.simulation.software import Laws
from stommel.vehicle import PHYSICS

Array = NDArray[np.float64]


def column_step(plan: MissionFile) -> float:
    """Distance of the column's depths [m]: fine in a pool, 2 m at sea."""
    return min(2.0, plan.dives.depth_m / 20.0)


FASTEST_STEADY, FASTEST_MOVING = 2.5, 1.3
"""Integration step times the fastest eigenvalue: stable without actuators in motion, and exact to 1e-4 with them."""


def loop_of(mission: Mission, vehicle: np.record, dives: DivePlan) -> Loop:
    """How time goes for a packed vehicle: integration steps at least as fine as its fastest mode needs."""
    plan, physics = mission.plan, PHYSICS[mission.plan.physics]
    fastest = max(
        fastest_mode(mission.vehicle, sign * dives.theta, sign * drive, physics=physics)
        for sign, drive in zip((-1.0, 1.0), drives(mission), strict=True)
    )
    cut = plan.integration
    return Loop(
        start=plan.start_seconds,
        control_step=cut.control_step_s,
        steady_steps=max(cut.steady_steps, ceil(cut.control_step_s * fastest / FASTEST_STEADY)),
        moving_steps=max(cut.moving_steps, ceil(cut.control_step_s * fastest / FASTEST_MOVING)),
        damping=_rotational_damping(vehicle),
        settle_time=cut.settle_s,
        column_period=cut.ocean_s,
        record_every=round(plan.output_every_s / cut.control_step_s),
    )


_SLOW = 0.3
"""Speed at which the part of the damping that grows with V is taken along with that of V^2 [m/s]."""


def _rotational_damping(vehicle: np.record) -> float:
    """Fastest damping of roll, pitch and yaw over the square of the speed [s/m2]; added masses are in the inertia."""
    inertia = np.array(vehicle.J_0)[:3]
    damping = np.abs(vehicle.D_omega) + np.abs(vehicle.D_omega_V) / _SLOW
    return float(np.max(damping / inertia))


def sensors_of(plan: MissionFile) -> Sensors:
    """Sensor errors of a plan, SI units and radians."""
    s, ctd, step = plan.sensors, plan.ctd, plan.integration.control_step_s
    dip = radians(s.magnetic_inclination_deg)
    rows = s.soft_iron
    return Sensors(
        attitude_noise=radians(s.attitude_noise_deg),
        heading_noise=radians(s.heading_noise_deg),
        pressure_noise=s.pressure_noise_m,
        pressure_bias=s.pressure_bias_m,
        attitude_lag=round(s.attitude_latency_s / step),
        pressure_lag=round(s.pressure_latency_s / step),
        altimeter_noise=s.altimeter_noise_m,
        position_noise=s.gps_noise_m,
        first_fix_time=s.first_fix_s,
        altimeter_range=s.altimeter_range_m,
        field=(float(np.cos(dip)), 0.0, float(np.sin(dip))),
        hard_iron=s.hard_iron,
        soft_iron=(*rows[0], *rows[1], *rows[2]),
        pump_field=s.pump_field,
        valve_field=s.valve_field,
        mass_field=s.pitch_drive_field,
        steering_field=s.steering_field,
        shielding=s.shielding,
        voltage_bias=s.voltage_bias_v,
        voltage_noise=s.voltage_noise_v,
        current_bias=s.current_bias_a,
        current_noise=s.current_noise_a,
        internal_pressure_bias=s.internal_pressure_bias_pa,
        internal_pressure_noise=s.internal_pressure_noise_pa,
        leak_volume=s.leak_ml / 1e6,
        thermistor_decay=1.0 - _weight(step, ctd.temperature_lag_s),
        # the answers to a temperature that changes evenly through the step
        thermistor_gain=ctd.temperature_lag_s / step * _weight(step, ctd.temperature_lag_s),
        cell_decay=1.0 - _weight(step, ctd.cell_lag_s),
        cell_gain=ctd.cell_share * ctd.cell_lag_s / step * _weight(step, ctd.cell_lag_s),
        sample_every=round(plan.sampling.every_s / step),
        sampled=np.array([float(phase in plan.sampling.phases) for phase in PHASES]),
    )


def _weight(step: float, time_constant: float) -> float:
    """Share of a difference that a first-order lag follows in a step."""
    return 1.0 - exp(-step / time_constant) if time_constant > 0.0 else 1.0


def hull_of(mission: Mission) -> Hull:
    """Air and leak of the hull, and how deep it may sink: as many times its rating as its safety factor says."""
    air, leak, hull = mission.plan.hull_air, mission.plan.leak, mission.vehicle.description.hull
    deepest = inf
    if hull is not None and hull.depth_rating_m is not None:
        deepest = hull.circumferential_safety_factor * hull.depth_rating_m
    return Hull(
        air_pressure=air.pressure_kpa * 1e3,
        air_temperature=air.temperature_c + KELVIN,
        air_volume=air.volume_l / 1e3,
        temperature_weight=_weight(GUIDANCE_PERIOD, air.settle_minutes * 60.0),
        leak_starts=leak.after_hours * 3600.0 if leak.rate_ml_min > 0.0 else inf,
        leak_rate=leak.rate_ml_min / 1e6 / 60.0,
        deepest=deepest,
    )


def orders_of(mission: Mission, plant: Plant, dives: DivePlan, table: FlightTable) -> Orders:
    """Everything that the vehicle's software is told."""
    plan = mission.plan
    abort, drift = plan.abort, plan.drift_control
    limit = abort.internal_pressure_kpa
    return Orders(
        dives=dives,
        laws=Laws(
            _pitch_law(plan, dives, table),
            _heading_law(plan),
            DriftLaw(
                gain=drift.gain_ml_s_m / 1e6,
                return_time=drift.return_minutes * 60.0,
                fastest=drift.fastest_m_s,
                dead_band=drift.dead_band_m,
                period=drift.period_s,
            ),
        ),
        table=table,
        waypoints=_waypoints(plan),
        radius=plan.guidance.acceptance_radius_m,
        lookahead=plan.guidance.lookahead_m,
        alarms=Alarms(
            energy=(1.0 - abort.battery_share) * plant.battery_energy,
            leak=abort.leak,
            internal_pressure=inf if limit is None else limit * 1e3,
        ),
    )


def dive_plan(mission: Mission, plant: Plant) -> DivePlan:
    """What one dive is asked to do.

    Raises
    ------
    StommelError
        The vehicle cannot fly the dives that the plan asks for.
    """
    plan = mission.plan
    dives, surface = plan.dives, plan.surface
    neutral = neutral_volumes(mission)
    down, up = ballast_volumes(mission, plant, neutral)
    afloat = plant.ballast_high if surface.ballast_ml is None else surface.ballast_ml / 1e6
    drifting = float(neutral[-1])
    knows_antenna = mission.vehicle.description.antenna is not None
    return DivePlan(
        depth=dives.depth_m,
        theta=radians(dives.pitch_deg),
        V_b_dive=down,
        V_b_climb=up,
        V_b_surface=afloat,
        V_b_drift=drifting,
        r_px_drift=mass_position_at_rest(mission, plant, drifting, 0.0),
        r_px_surface=(
            mass_position_at_rest(mission, plant, afloat, radians(surface.pitch_deg)) if knows_antenna else nan
        ),
        surface_time=surface.session_s,
        longest_surface_time=surface.longest_s,
        drift_time=dives.drift_hours * 3600.0,
        surfacing_interval=inf if surface.every_hours is None else surface.every_hours * 3600.0,
        least_altitude=dives.least_altitude_m,
        shallow_depth=surface.depth_m,
        dives_per_surfacing=float(dives.per_surfacing),
        turn_depth=dives.turn_depth_m,
        abort_depth=plan.abort.depth_m or 1.1 * dives.depth_m,
        abort_time=plan.abort.dive_hours * 3600.0,
    )


CORRECTED = 1.0 / 3.0
"""Part of a pitch error that one correction by the moving mass takes away."""


def _pitch_law(plan: MissionFile, dives: DivePlan, table: FlightTable) -> PitchLaw:
    law = plan.pitch_control
    if law.gain_mm_per_deg is None:
        ends = [look_up(table, dives.theta + turn, dives.V_b_dive)[0] for turn in (-radians(1.0), radians(1.0))]
        gain = CORRECTED * abs(ends[1] - ends[0]) / radians(2.0)
    else:
        gain = law.gain_mm_per_deg / 1e3 / radians(1.0)
    return PitchLaw(
        gain=gain,
        dead_band=radians(law.dead_band_deg),
        period=law.period_s,
        tolerance=law.tolerance_mm / 1e3,
    )


def _heading_law(plan: MissionFile) -> HeadingLaw:
    law = plan.heading_control
    return HeadingLaw(law.response_s, radians(law.dead_band_deg), radians(law.limit_deg))


def _waypoints(plan: MissionFile) -> Array:
    """Waypoints in radians; with `repeat`, as often as the mission could reach them."""
    places = [(radians(place.latitude_deg), radians(place.longitude_deg)) for place in plan.waypoints]
    if plan.guidance.repeat and places:
        places *= max(1, int(2000 / len(places)))
    return np.array(places, dtype=float).reshape(-1, 2)
