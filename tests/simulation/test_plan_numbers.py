"""Numbers that a plan leaves to the planner; oracles: the file's words, differences of trims, gsw's densities."""

from math import radians

import gsw
import numpy as np
import pytest

from stommel.analysis.trim import trim
from stommel.planning.ballasting import pump_flow, surplus_afloat
from stommel.planning.orders import orders_of
from stommel.vehicle import FULL
from tests.simulation.conftest import Document, flown, made, mission_document, stays

DIVES: Document = {"depth_m": 100.0, "pitch_deg": 35.0, "speed_m_s": 0.35}


@pytest.mark.parametrize("depth", [50.0, 160.0])
def test_too_deep_is_a_tenth_below_the_dive(depth: float) -> None:
    mission = made(mission_document(dives=DIVES | {"depth_m": depth}))
    orders = orders_of(mission.deployment, 1.0, 1e6)
    assert orders.dives.abort_depth == pytest.approx(1.1 * depth)
    stated = made(mission_document(dives=DIVES | {"depth_m": depth}, abort={"depth_m": 175.0}))
    assert orders_of(stated.deployment, 1.0, 1e6).dives.abort_depth == 175.0


@pytest.mark.parametrize("pitch", [25.0, 35.0])
def test_one_correction_takes_a_third_of_the_error_away(pitch: float) -> None:
    """Metres of moving mass for a radian of pitch, between trims a little steeper and shallower of that ballast."""
    mission = made(mission_document(ocean={"name": "still"}, dives=DIVES | {"pitch_deg": pitch}))
    orders = orders_of(mission.deployment, 1.0, 1e6)
    places = []
    for turn in (-1.0, 1.0):
        flight = trim(mission.vehicle, speed_m_s=0.35, pitch_deg=-pitch + turn, physics=FULL)
        places.append(flight.r_px)
    whole = abs(places[1] - places[0]) / radians(2.0)
    assert orders.laws.pitch.gain == pytest.approx(whole / 3.0, rel=0.1)


def test_surplus_afloat_is_the_oil_beyond_neutral_at_the_surface() -> None:
    """Neutral at 43 m: at the surface, where the water is lighter, some of the 250 ml only makes up for that."""
    water = {"name": "two_layer"}
    mission = made(mission_document(ocean=water, ballasting={"neutral_depth_m": 43.0}))
    here = [mission.ocean.at(mission.scenario.start_seconds, 18.0, 116.0, z) for z in (0.0, 43.0)]
    rho = [float(gsw.rho(s.absolute_salinity, s.conservative_temperature, s.pressure / 1e4)) for s in here]
    d = mission.vehicle.description
    hull = d.hull
    assert hull is not None
    # the hull that is neutral at 43 m, let go of its pressure and taken to the surface's warmth
    whole = d.mass_kg / rho[1]
    grown = hull.compressibility_per_pa * here[1].pressure
    grown += hull.thermal_expansion_per_k * (here[0].temperature - here[1].temperature)
    neutral_at_the_top = d.mass_kg / rho[0] - whole * (1.0 + grown)
    assert 20e-6 < neutral_at_the_top < 190e-6
    assert surplus_afloat(mission.deployment) == pytest.approx(250e-6 - neutral_at_the_top, abs=2e-6)
    stated = made(mission_document(ocean=water, ballasting={"neutral_depth_m": 43.0}, surface={"ballast_ml": 200.0}))
    assert surplus_afloat(stated.deployment) == pytest.approx(200e-6 - neutral_at_the_top, abs=2e-6)


def test_pump_s_flow_is_that_at_the_depth_of_the_dives() -> None:
    """Leakage and friction take more of it the deeper: three per cent and more between 20 and 190 m."""
    flows = [
        pump_flow(made(mission_document(ocean={"name": "still"}, dives=DIVES | {"depth_m": z})).deployment)
        for z in (20.0, 190.0)
    ]
    ideal = 1.1e-6 * 7000.0 / 15.0 / 60.0
    assert flows[1] < 0.97 * flows[0] < flows[0] <= ideal


def test_every_stay_at_the_surface_is_the_session() -> None:
    found = flown(ocean={"name": "still"}, dives=DIVES | {"depth_m": 30.0}, surface={"session_s": 240.0})
    lengths = {end - begin for begin, end in stays(found, "surface")}
    assert lengths == {240.0}
    assert np.diff([begin for begin, _ in stays(found, "surface")]).min() > 240.0
