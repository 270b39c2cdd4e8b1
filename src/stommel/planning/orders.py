"""What the vehicle's software is told, from a mission's plan, its vehicle and the water it expects."""

from math import inf, nan, radians

import numpy as np
from numpy.typing import NDArray

from stommel.analysis.flight_table import flight_table
from stommel.control.dive_cycle import PHASES, DivePlan
from stommel.control.flight_table import FlightTable, look_up
from stommel.control.laws import DriftLaw, HeadingLaw, PitchLaw
from stommel.control.orders import GUIDANCE_PERIOD, Alarms, Laws, Orders
from stommel.mission.plan import Plan
from stommel.planning.ballasting import (
    afloat_volume,
    ballast_volumes,
    mass_position_at_rest,
    neutral_ballast,
    surplus_afloat,
)
from stommel.planning.deployment import Deployment
from stommel.planning.overshoot import overshoot

Array = NDArray[np.float64]


def orders_of(deployment: Deployment, step: float, energy: float) -> Orders:
    """Everything that the vehicle's software is told.

    Parameters
    ----------
    deployment
        Plan, vehicle and water.
    step
        Between two decisions [s].
    energy
        Usable in the battery at the start [J]; infinite if it is not known.

    Raises
    ------
    StommelError
        The vehicle cannot fly the dives that the plan asks for.
    """
    plan, dives = deployment.plan, dive_plan(deployment, step)
    table = flight_table(deployment.vehicle, physics=deployment.physics)
    limit = plan.abort.internal_pressure_kpa
    return Orders(
        step=step,
        guidance_every=max(1, round(GUIDANCE_PERIOD / step)),
        dives=dives,
        laws=Laws(_pitch_law(plan, dives, table), _heading_law(plan), _drift_law(plan)),
        table=table,
        waypoints=_waypoints(plan),
        radius=plan.guidance.acceptance_radius_m,
        lookahead=plan.guidance.lookahead_m,
        alarms=Alarms(
            energy=(1.0 - plan.abort.battery_share) * energy,
            leak=plan.abort.leak,
            internal_pressure=inf if limit is None else limit * 1e3,
        ),
        sampled=np.array([float(phase in plan.sampling.phases) for phase in PHASES]),
    )


def dive_plan(deployment: Deployment, step: float) -> DivePlan:
    """What one dive is asked to do, by decisions a `step` [s] apart.

    Raises
    ------
    StommelError
        The vehicle cannot fly the dives that the plan asks for.
    """
    plan = deployment.plan
    dives, surface = plan.dives, plan.surface
    neutral = neutral_ballast(deployment)
    ballast = ballast_volumes(deployment, neutral)
    afloat = afloat_volume(deployment)
    drifting = float(neutral[-1])
    knows_antenna = deployment.vehicle.description.antenna is not None
    return DivePlan(
        depth=dives.depth_m,
        turns_early=overshoot(deployment, ballast, neutral, step),
        theta=radians(dives.pitch_deg),
        V_b_dive=ballast.down,
        V_b_climb=ballast.up,
        V_b_surface=afloat,
        V_b_drift=drifting,
        r_px_drift=mass_position_at_rest(deployment, drifting, 0.0),
        r_px_surface=(
            mass_position_at_rest(deployment, afloat, radians(surface.pitch_deg), surplus_afloat(deployment))
            if knows_antenna
            else nan
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


def _pitch_law(plan: Plan, dives: DivePlan, table: FlightTable) -> PitchLaw:
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


def _heading_law(plan: Plan) -> HeadingLaw:
    law = plan.heading_control
    return HeadingLaw(law.response_s, radians(law.dead_band_deg), radians(law.limit_deg))


def _drift_law(plan: Plan) -> DriftLaw:
    law = plan.drift_control
    return DriftLaw(
        gain=law.gain_ml_s_m / 1e6,
        return_time=law.return_minutes * 60.0,
        fastest=law.fastest_m_s,
        dead_band=law.dead_band_m,
        period=law.period_s,
    )


def _waypoints(plan: Plan) -> Array:
    """Waypoints in radians; with `repeat`, as often as the mission could reach them."""
    places = [(radians(place.latitude_deg), radians(place.longitude_deg)) for place in plan.waypoints]
    if plan.guidance.repeat and places:
        places *= max(1, int(2000 / len(places)))
    return np.array(places, dtype=float).reshape(-1, 2)
