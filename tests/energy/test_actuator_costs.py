"""The tables of costs against the machines they stand for: the engine's simulation, the drives' own functions."""

from math import radians

import pytest

from stommel.analysis import trim
from stommel.design.drives.trim_change import trim_change
from stommel.machinery.drives import PitchDrive, RudderDrive
from stommel.machinery.engine import Outcome, engine_of, load_engine, simulate
from stommel.machinery.power import energy_model
from stommel.machinery.power.engine_work import pump_by_engine
from stommel.vehicle import Vehicle


@pytest.mark.parametrize("name", ["zju", "slocum-1000m"])
@pytest.mark.parametrize("pressure", [0.0, 0.7e6, 2e6])
def test_pump_costs_what_its_simulation_costs(zju: Vehicle, name: str, pressure: float) -> None:
    engine = engine_of(zju).engine if name == "zju" else load_engine(name).engine
    work = pump_by_engine(engine, 2e6)
    volume = 0.35 * engine.measured_piston.working_volume_ml / 1e6
    for phase, options in (("inflate", {"inflate_m3": volume}), ("deflate", {"deflate_m3": volume})):
        run = simulate(engine, pressure_pa=pressure, **options).phase(phase)
        assert run is not None
        assert run.outcome is Outcome.REACHED
        energy, time = (work.inflation if phase == "inflate" else work.deflation)(volume, pressure)
        # the simulation stops at a step of its sensor; deflating by motor has a start that the table leaves out;
        # between the pressures of a simulated table lies a straight line
        slack = 0.01 if name == "zju" or phase == "inflate" else 0.06
        assert float(energy) == pytest.approx(run.energy_j, rel=slack, abs=3.0)
        assert float(time) == pytest.approx(run.duration_s, rel=0.02)


@pytest.mark.parametrize("pitch", [-50.0, -35.0, -10.0])
def test_trim_change_is_the_drives_own(zju: Vehicle, pitch: float) -> None:
    dive = trim(zju, speed_m_s=0.4, pitch_deg=pitch)
    climb = trim(zju, speed_m_s=0.4, pitch_deg=-pitch)
    work = energy_model(zju).works.pitch
    for start, end in ((dive, climb), (climb, dive)):
        change = trim_change(PitchDrive.of(zju), start, end)
        assert change is not None
        energy, time = work.move(start.r_px, end.r_px, start.theta, end.theta)
        assert float(energy) == pytest.approx(change.energy, rel=5e-3)
        assert float(time) == pytest.approx(change.time, rel=5e-3)


@pytest.mark.parametrize("speed", [0.1, 0.4, 0.8])
def test_rudder_turn_is_the_drives_own(zju: Vehicle, speed: float) -> None:
    plan = energy_model(zju).plan
    turn = RudderDrive.of(zju).turn(radians(plan.rudder_turn_deg), speed, plan.rudder_hold_s)
    assert turn is not None
    assert float(energy_model(zju).works.rudder.turn(speed)) == pytest.approx(turn.energy, rel=5e-3)
