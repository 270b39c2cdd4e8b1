"""JSBSim with the benchmark's glider as its aircraft: dives in the mission's water under control at 1 Hz.

`benchmarks/peers/glider.xml` holds the six degrees of freedom: weight, hull and bladder buoyancy in stratified water,
the vehicle file's hydrodynamic coefficients, a moving mass, ballast and rudder with the rates of their drives. A loop
in Python, as JSBSim's users write it, decides once a second and turns the dive at the mission's depths. In JSBSim's
favour there is no sensor noise, no surface, no bottom, no energy, no navigation and no stall.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import atan2, cos, radians, sin
from pathlib import Path
from string import Template
from time import process_time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from figures.reference_flight import Leg, ReferenceFlight
from stommel.analysis.flight_table import flight_table
from stommel.control.flight_table import look_up_turning
from stommel.control.laws import steering_gains
from stommel.vehicle import PHYSICS

Array = NDArray[np.float64]

TEMPLATES = Path(__file__).resolve().parents[1] / "peers"
DEFAULT_RATE = 120
"""Steps a second that JSBSim takes unless told otherwise, and that its users take."""
COLUMNS = ("time", "depth", "speed", "pitch", "heading", "roll", "moving_mass", "ballast")
"""Of the rows that a flight returns, SI units and radians."""

_FOOT, _INCH, _SLUG = 0.3048, 0.0254, 14.59390294
"""[m], [m], [kg]"""
_RADIUS = 6.371e6
"""Of the planet [m]."""
_SURFACE = 1000.0
"""Altitude that stands for the surface of the sea [m]; JSBSim's ground stays far below the dives."""
_OUTPUT_PERIOD = 10
"""Seconds between rows."""


def numbers(flight: ReferenceFlight, depths: Array, density: Array, hull_volume: Array) -> dict[str, str]:
    """What stands in the places of the templates; coefficients for reference area, chord and span of 1."""
    middle = float(density[len(density) // 2])
    plain = _masses(flight) | _drives(flight, middle)
    coefficients = {name: 2.0 * value / middle for name, value in _hydrodynamics(flight).items()}
    return {name: f"{value:.12g}" for name, value in (plain | coefficients).items()} | {
        "density": _rows(depths, density / _SLUG * _FOOT**3),
        "hull_volume": _rows(depths, hull_volume / _FOOT**3),
    }


def _masses(flight: ReferenceFlight) -> dict[str, float]:
    """Planet and weights [m, kg]; inertia about the body's own centre of mass."""
    vehicle, p = flight.mission.vehicle.description, flight.vehicle
    body, surge = vehicle.rigid_body, float(p.M_f[0])
    x, _, z = body.centre_of_mass_m
    offset = body.mass_kg if body.inertia_about == "centre_of_buoyancy" else 0.0
    return {
        "radius": _RADIUS,
        "gravitation": float(p.g) * (_RADIUS + _SURFACE) ** 2,
        "inertia_x": body.inertia_kg_m2[0][0] - offset * z**2,
        "inertia_y": body.inertia_kg_m2[1][1] - offset * (x**2 + z**2),
        "inertia_z": body.inertia_kg_m2[2][2] - offset * x**2,
        "body_mass": body.mass_kg,
        "body_aft": -x,
        "body_up": -z,
        "moving_mass": vehicle.moving_mass.mass_kg,
        "ballast_mass": vehicle.ballast.mass_kg,
        "ballast_aft": -vehicle.ballast.position_m[0],
        "added_mass": surge,
        "added_slugs": surge / _SLUG,
    }


def _drives(flight: ReferenceFlight, density: float) -> dict[str, float]:
    """Rates of the actuators in JSBSim's units, and where the bladder's volume acts [m]."""
    p, actuators = flight.vehicle, flight.mission.vehicle.description.actuators
    return {
        # the oil that leaves the reservoir for the bladder takes its weight along
        "bladder_aft": -float(p.r_bl[0] - p.rho_oil / density * (p.r_bl[0] - p.r_res[0])),
        "moving_mass_rate": actuators.moving_mass.speed_mm_s / 1e3 / _INCH,
        "ballast_rate": actuators.buoyancy.flow_ml_s / 1e6 / _FOOT**3,
        "rudder_rate": radians(actuators.rudder.speed_deg_s),
    }


def _hydrodynamics(flight: ReferenceFlight) -> dict[str, float]:
    """Forces and moments over speed squared, as the vehicle file has them [kg/m, kg, kg m]."""
    p = flight.vehicle
    surge, sway, heave = (float(m) for m in p.M_f[:3])
    same = ("K_D0", "K_D", "K_L0", "K_L", "K_beta", "K_delta", "M_zero", "M_alpha", "N_beta", "N_delta")
    return {name: float(p[name]) for name in same} | {
        "side_beta": -float(p.S_beta),
        "side_delta": -float(p.S_delta),
        "roll_damping": float(p.D_omega[0]),
        "pitch_damping": float(p.D_omega[1]),
        "yaw_damping": float(p.D_omega[2]),
        "heave_less_surge": heave - surge,
        "surge_less_sway": surge - sway,
    }


def _rows(depths: Array, values: Array) -> str:
    """A table over altitude [ft], upwards."""
    altitudes = (_SURFACE - depths) / _FOOT
    return "\n".join(f"{a:.9g} {v:.12g}" for a, v in zip(altitudes[::-1], values[::-1], strict=True))


def write_aircraft(flight: ReferenceFlight, folder: Path, *, uniform: bool = False) -> None:
    """Fill the templates: `planet.xml` and `aircraft/glider/glider.xml`.

    The water is the mission's, or that of the vehicle file at all depths if `uniform`.
    """
    depths = np.arange(0.0, 1.5 * flight.mission.scenario.dives.depth_m, 5.0)
    if uniform:
        density = np.full_like(depths, flight.mission.vehicle.neutral_density_kg_m3)
        hull_volume = np.full_like(depths, flight.vehicle.V_0)
    else:
        density, hull_volume = flight.water(depths)
    found = numbers(flight, depths, density, hull_volume)
    for name, place in (("planet", folder), ("glider", folder / "aircraft" / "glider")):
        place.mkdir(parents=True, exist_ok=True)
        template = Template((TEMPLATES / f"{name}.xml").read_text(encoding="utf-8"))
        place.joinpath(f"{name}.xml").write_text(template.substitute(found), encoding="utf-8")


def executive(folder: Path, rate: int = DEFAULT_RATE) -> Any:
    """JSBSim with planet and aircraft of `folder` loaded, at `rate` steps a second."""
    import jsbsim  # noqa: PLC0415  # an extra

    jsbsim.FGJSBBase().debug_lvl = 0  # silence
    fdm = jsbsim.FGFDMExec(str(folder))
    if rate != DEFAULT_RATE:
        fdm.set_dt(1.0 / rate)
    fdm["atmosphere/override/density"] = 1000.0 / _SLUG * _FOOT**3  # until its table is asked
    if not (fdm.load_planet(str(folder / "planet.xml"), False) and fdm.load_model("glider")):
        raise RuntimeError(f"JSBSim refuses its files in {folder}")
    return fdm


@dataclass(frozen=True)
class DivePlan:
    """What the loop in Python commands."""

    down: Leg
    up: Leg
    depth: float
    """Turn to climb [m]."""
    turn_depth: float
    """Turn to dive [m]."""
    heading: float
    """[rad]"""
    steering: tuple[float, float]
    """Radians of rudder for each of heading error, on the descent and on the climb, where the rudder acts the other
    way."""
    limit: float
    """Of the rudder [rad]."""


def plan_of(flight: ReferenceFlight) -> DivePlan:
    """The mission's own settings, depths and answer to heading errors; north."""
    plan = flight.mission.scenario
    law = plan.heading_control
    down, up = flight.leg(True), flight.leg(False)
    table = flight_table(flight.mission.vehicle, physics=PHYSICS[plan.physics])
    turning = [look_up_turning(table, leg.pitch, leg.ballast) for leg in (down, up)]
    gains = [steering_gains(law.response_s, pole)[0] / drive for pole, drive in turning]
    return DivePlan(
        down=down, up=up, depth=plan.dives.depth_m, turn_depth=plan.dives.turn_depth_m,
        heading=0.0, steering=(gains[0], gains[1]), limit=radians(law.limit_deg),
    )  # fmt: skip


def begin(fdm: Any, leg: Leg, heading: float) -> None:
    """Put the glider on a descent at the depth where dives turn, with its actuators in place."""
    _command(fdm, leg)
    attack = leg.pitch + np.arcsin(leg.sinking / leg.speed)
    for name, value in {
        "ic/h-sl-ft": (_SURFACE - 10.0) / _FOOT,
        "ic/theta-deg": float(np.degrees(leg.pitch)),
        "ic/psi-true-deg": float(np.degrees(heading)),
        "ic/u-fps": leg.speed * cos(attack) / _FOOT,
        "ic/w-fps": leg.speed * sin(attack) / _FOOT,
    }.items():
        fdm[name] = value
    if not fdm.run_ic():
        raise RuntimeError("JSBSim finds no initial state")


def _command(fdm: Any, leg: Leg) -> None:
    fdm["commands/moving-mass-in"] = -leg.moving_mass / _INCH
    fdm["commands/ballast-ft3"] = leg.ballast / _FOOT**3


def fly(fdm: Any, plan: DivePlan, seconds: int, rate: int = DEFAULT_RATE) -> Array:
    """Dive for so long; rows of `COLUMNS` every 10 s."""
    rows = np.empty((seconds // _OUTPUT_PERIOD, len(COLUMNS)))
    run: Callable[[], bool] = fdm.run
    leg = plan.down
    for second in range(seconds):
        for _ in range(rate):
            run()
        depth = _SURFACE - fdm["position/h-sl-ft"] * _FOOT
        if depth > plan.depth and leg is plan.down:
            leg = plan.up
            _command(fdm, leg)
        elif depth < plan.turn_depth and leg is plan.up:
            leg = plan.down
            _command(fdm, leg)
        heading = fdm["attitude/psi-rad"]
        error = atan2(sin(plan.heading - heading), cos(plan.heading - heading))
        rudder = plan.steering[leg is plan.up] * error
        fdm["commands/rudder-rad"] = min(plan.limit, max(-plan.limit, rudder))
        if second % _OUTPUT_PERIOD == _OUTPUT_PERIOD - 1:
            rows[second // _OUTPUT_PERIOD] = (
                second + 1, depth, fdm["velocities/vt-fps"] * _FOOT, fdm["attitude/theta-rad"], heading,
                fdm["attitude/phi-rad"], -fdm["inertia/pointmass-location-X-inches"] * _INCH,
                fdm["actuators/ballast-ft3"] * _FOOT**3,
            )  # fmt: skip
    return rows


def timed_flight(folder: Path, plan: DivePlan, seconds: int, rate: int = DEFAULT_RATE) -> tuple[float, Array]:
    """Processor time of a flight [s], without loading, and its rows."""
    fdm = executive(folder, rate)
    begin(fdm, plan.down, plan.heading + radians(20.0))  # so that there is something to steer
    start = process_time()
    rows = fly(fdm, plan, seconds, rate)
    return process_time() - start, rows


def legs_of(rows: Array, depth: float) -> tuple[Leg, Leg]:
    """Descents and climbs of a flight between a quarter and three quarters of the dive depth."""
    found = []
    column = dict(zip(COLUMNS, rows.T, strict=True))
    sinking = np.gradient(column["depth"], column["time"])
    for sign in (1.0, -1.0):
        share = column["depth"] / depth
        mask = (share > 0.25) & (share < 0.75) & (sign * sinking > 0)
        found.append(
            Leg(
                ballast=float(np.median(column["ballast"][mask])),
                moving_mass=float(np.median(column["moving_mass"][mask])),
                speed=float(column["speed"][mask].mean()),
                pitch=float(column["pitch"][mask].mean()),
                sinking=float(sinking[mask].mean()),
            )
        )
    return found[0], found[1]


def sailplane_speed(seconds: int) -> float:
    """Simulated time over processor time of the Schweizer 1-26 that comes with JSBSim, gliding for so long."""
    import jsbsim  # noqa: PLC0415  # an extra

    jsbsim.FGJSBBase().debug_lvl = 0
    fdm = jsbsim.FGFDMExec(None)
    if not fdm.load_model("sgs126"):
        raise RuntimeError("JSBSim does not find its sailplane")
    fdm.disable_output()
    fdm["ic/h-sl-ft"], fdm["ic/vc-kts"] = 5000.0, 45.0
    fdm.run_ic()
    run = fdm.run
    start = process_time()
    for _ in range(DEFAULT_RATE * seconds):
        run()
    return seconds / (process_time() - start)
