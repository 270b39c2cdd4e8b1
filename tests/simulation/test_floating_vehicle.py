"""A vehicle at the surface and on the bottom; oracles: Archimedes, the balance of moments, heave of a spar buoy."""

from math import cos, pi, radians, sin, sqrt, tan

import numpy as np
import pytest

from stommel.control.commands import GOING_ON, Commands
from stommel.machinery.hull.floating import hull_form, water_line
from stommel.planning.ballasting import surplus_afloat
from stommel.simulation.flight import Flown
from stommel.simulation.plant.waves import antenna_height, heave_period
from stommel.simulation.simulator import Simulator
from tests.simulation.conftest import EXACT, Document, column, events, flown, made, mission_document, stays

STILL: Document = {"name": "still"}
RADIUS, TAIL, TAIL_TIP = 0.11, 0.49, -1.24
"""Of the zju glider [m]."""


def cone_height(volume: float) -> float:
    """Of the tail's cone that holds a volume: V = pi / 3 R2 h3 / L2."""
    return float((3.0 * volume * TAIL**2 / (pi * RADIUS**2)) ** (1.0 / 3.0))


def floating(r_px: float) -> tuple[float, float]:
    """Tangent of the pitch at which it floats with 200 ml outside, and what tilts it by hand [kg m].

    Neutral with no oil outside, and level with the mass at 0.25 m: the mass, the oil from the reservoir at -0.5 m to
    the bladder at -0.75 m, the bladder's buoyancy, and what of the tail's cone stands out.
    """
    simulator = Simulator(made(mission_document(ocean=STILL, sensors=EXACT, duration_days=0.1)))
    for _ in range(400):
        simulator.step(Commands(r_px, 2e-4, 0.0, 1e-5, 0, False, False, GOING_ON))
    found = simulator.flown()
    theta, rho = float(column(found, "pitch")[-1]), float(column(found, "density")[-1])
    V_b, moved = float(column(found, "ballast")[-1]), float(column(found, "moving_mass")[-1]) - 0.25
    assert V_b == pytest.approx(2e-4, abs=1e-7)
    assert column(found, "depth")[-1] == 0.0
    emerged = rho * V_b * (TAIL_TIP + 0.75 * cone_height(V_b))
    return tan(theta), 10.0 * moved + 870.0 * V_b * (-0.75 + 0.5) + rho * V_b * 0.75 + emerged


def test_a_floating_vehicle_balances_about_what_is_out() -> None:
    """tan(pitch) is what tilts it over the whole weight's depth below the centre of buoyancy, the same every time."""
    tangents, moments = zip(*(floating(r_px) for r_px in (0.3, 0.32, 0.34)), strict=True)
    depths = -np.array(moments) / np.array(tangents)
    assert max(tangents) < -0.15  # tilted enough to stand out by the tail alone
    assert depths == pytest.approx(depths[0], rel=0.01)
    assert depths[0] == pytest.approx(2.25, rel=0.01)  # as the vehicle file places its masses: 2.25 kg m


def test_antenna_stands_as_high_as_the_tail_is_out() -> None:
    """From the water line along the axis, and across it; about a hand's breadth, and not a metre."""
    mission = made(mission_document(ocean=STILL))
    theta, surplus = radians(-45.0), surplus_afloat(mission.deployment)
    antenna = (-1.2, 0.0, -0.2)
    line = TAIL_TIP + cone_height(surplus)
    expected = (line - antenna[0]) * sin(-theta) + 0.2 * cos(theta)
    found = antenna_height(antenna, water_line(hull_form(mission.vehicle.description), theta, surplus), theta)
    assert found == pytest.approx(expected, abs=2e-3)
    assert 0.1 < found < 0.4


def test_antenna_s_height_by_geometry() -> None:
    """Level, only what stands above the axis counts; upright nose down, the way from the water line."""
    assert antenna_height((-1.2, 0.0, -0.2), -1.0, 0.0) == pytest.approx(0.2)
    assert antenna_height((-1.2, 0.0, -0.2), -1.0, radians(-90.0)) == pytest.approx(0.2)
    assert antenna_height((-1.2, 0.0, 0.0), -1.0, radians(-30.0)) == pytest.approx(0.1)
    assert antenna_height((-1.2, 0.0, 0.0), -1.0, radians(30.0)) == pytest.approx(-0.1)


@pytest.mark.parametrize("pitch", [-60.0, -45.0, -30.0])
def test_heave_is_that_of_a_spar_on_its_water_line(pitch: float) -> None:
    """2 pi sqrt(m / (rho g A / |sin|)): tilted, the water line cuts the tail's section A the longer."""
    mission = made(mission_document(ocean=STILL, surface={"pitch_deg": pitch}))
    d, surplus = mission.vehicle.description, surplus_afloat(mission.deployment)
    section = pi * (RADIUS * cone_height(surplus) / TAIL) ** 2
    stiffness = mission.vehicle.neutral_density_kg_m3 * 9.81 * section / abs(sin(radians(pitch)))
    expected = 2.0 * pi * sqrt((d.mass_kg + d.added_inertia.heave_kg) / stiffness)
    assert heave_period(mission) == pytest.approx(expected, rel=0.01)
    assert heave_period(mission) > 3.0


def test_lying_flat_the_heave_is_the_assumed_one() -> None:
    assert heave_period(made(mission_document(ocean=STILL, surface={"pitch_deg": -5.0}))) == 3.0


def on_the_bottom(current: float) -> Flown:
    """A vehicle that takes in water and lies on the ground at 60 m while water flows by."""
    sea = {"name": "uniform", "parameters": {"current_east_m_s": current, "bottom_m": 60.0}}
    return flown(
        ocean=sea, sensors=EXACT, dives={"depth_m": 50.0, "pitch_deg": 35.0, "ballast_ml": 100.0},
        leak={"rate_ml_min": 100.0}, abort={"leak": False, "depth_m": 5000.0}, output_every_s=1.0, duration_days=0.1,
    )  # fmt: skip


def test_on_the_bottom_it_rests_over_the_ground_while_the_water_flows_by() -> None:
    found = on_the_bottom(0.4)
    depth, t = column(found, "depth"), column(found, "time")
    lying = t > t[np.argmax(depth >= 60.0)] + 5.0
    assert lying.sum() > 1000
    assert depth[lying] == pytest.approx(60.0)
    for name in ("latitude", "longitude"):
        assert np.ptp(column(found, name)[lying]) == 0.0
    through = np.sqrt(sum(column(found, name)[lying] ** 2 for name in "uvw"))
    assert through == pytest.approx(0.4, rel=1e-6)
    assert (np.array([column(found, name)[lying] for name in "pqr"]) == 0.0).all()
    still = on_the_bottom(0.0)
    lying = column(still, "depth") >= 60.0
    assert np.abs([column(still, name)[lying][5:] for name in "uvw"]).max() < 1e-12


def test_the_rating_that_is_passed_is_told_each_time_once() -> None:
    """A sensor that tells 8 m too little: 197 m asked, over 200 m flown; told at the crossing, and again next dive."""
    sea = {"name": "still", "parameters": {"bottom_m": 2000.0}}
    found = flown(
        ocean=sea, sensors=EXACT | {"pressure_bias_m": -8.0}, output_every_s=1.0, duration_days=0.12,
        dives={"depth_m": 197.0, "pitch_deg": 35.0, "speed_m_s": 0.35},
    )  # fmt: skip
    t, depth = column(found, "time"), column(found, "depth")
    crossed = t[1:][(depth[:-1] <= 200.0) & (depth[1:] > 200.0)]
    assert len(crossed) >= 2
    told = [when for when, _, reason in events(found) if reason == "hull rating passed"]
    assert told == pytest.approx(crossed, abs=1.0)
    row = next(one for one in found.events if one["time"] == told[0])
    assert 200.0 < row["depth"] < 201.0


def test_within_the_rating_nothing_is_told() -> None:
    found = flown(ocean=STILL, sensors=EXACT, dives={"depth_m": 199.0, "pitch_deg": 35.0, "speed_m_s": 0.35})
    assert not [when for when, _, reason in events(found) if reason == "hull rating passed"]


def water_at(leak: Document, pitch_up: bool, seconds: int) -> np.ndarray:
    """Static moment that the leaked water adds at the end [kg m], over its mass."""
    simulator = Simulator(
        made(mission_document(ocean=STILL, sensors=EXACT, duration_days=0.1, leak={"rate_ml_min": 30.0} | leak))
    )
    r_px = 0.1 if pitch_up else 0.4
    for _ in range(seconds):
        simulator.step(Commands(r_px, -1e-4, 0.0, 1e-3, 0, False, False, GOING_ON))
    setup = simulator._setup
    leaked = float(setup.world.leaked)
    assert leaked == pytest.approx(30e-6 / 60.0 * seconds, rel=1e-9)
    theta = float(column(simulator.flown(), "pitch")[-1])
    assert (theta > 0.1) if pitch_up else (theta < -0.1)
    rho = float(column(simulator.flown(), "density")[-1])
    more = np.array(setup.equipment.vehicle.s_0) - np.array(setup.equipment.hull.s_0)
    # as lost ballast volume its weight counts at the bladder already, and its oil came back into the reservoir
    bladder, reservoir = np.array([-0.75, 0.0, 0.0]), np.array([-0.5, 0.0, 0.0])
    whole = more + leaked * (rho * bladder - 870.0 * (bladder - reservoir))
    return np.asarray(whole / (rho * leaked))


def test_leaked_water_runs_to_the_lowest_end() -> None:
    """Ends of the pressure hull at 0.75 m fore and aft, its wall 0.11 m below the axis."""
    assert water_at({}, False, 600) == pytest.approx([0.75, 0.0, 0.11], abs=1e-4)
    assert water_at({}, True, 600) == pytest.approx([-0.75, 0.0, 0.11], abs=1e-4)


def test_leaked_water_stays_in_a_compartment_of_its_own() -> None:
    place = [0.3, 0.02, 0.05]
    for pitch_up in (False, True):
        assert water_at({"position_m": place}, pitch_up, 600) == pytest.approx(place, abs=1e-4)


def test_water_in_the_nose_pushes_it_down() -> None:
    """Two missions that differ by where the water lies: forward of the other, the nose is lower."""
    ends = []
    for x in (0.7, -0.7):
        found = flown(
            ocean=STILL, sensors=EXACT, duration_days=0.03, abort={"leak": False}, output_every_s=1.0,
            dives={"depth_m": 150.0, "pitch_deg": 35.0, "ballast_ml": 200.0}, pitch_control={"gain_mm_per_deg": 0.0},
            leak={"rate_ml_min": 3.0, "position_m": [x, 0.0, 0.1]},
        )  # fmt: skip
        begin, end = stays(found, "ascent")[0]
        ends.append(column(found, "pitch")[round(0.5 * (begin + end))])
    assert ends[0] < ends[1] - radians(1.0)
