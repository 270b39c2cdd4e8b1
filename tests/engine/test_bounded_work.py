"""An engine that would be integrated without end is given up in seconds, with what makes it slow by name."""

import time
from typing import Any

import pytest

from stommel.machinery.engine import engine_of, simulate
from stommel.machinery.engine.cycle import EngineRequestError
from stommel.machinery.engine.segments import SimulationError
from stommel.vehicle import load_vehicle
from stommel.vehicle.schema import Engine

SLOWEST_S = 10.0


def engine(**changes: float) -> Engine:
    vehicle = load_vehicle("zju")
    for key, value in changes.items():
        vehicle = vehicle.with_value(f"engine.{key.replace('__', '.')}", value)
    return engine_of(vehicle).engine


def refusal(built: Engine, **asked: Any) -> str:
    began = time.process_time()
    with pytest.raises(SimulationError) as caught:
        simulate(built, **asked)
    assert time.process_time() - began < SLOWEST_S
    message = str(caught.value)
    assert len(message.splitlines()) == 1
    return message


def test_a_piston_that_sticks_and_slips_is_named_so() -> None:
    """Friction that falls with speed and nothing viscous: the classical condition of stick and slip."""
    found = refusal(engine(reservoirs__0__viscous_n_s_m=0.0), pressure_pa=1e6, inflate_m3=4e-4)
    assert "sticks and slips" in found
    assert "Stribeck" in found


def test_the_fastest_part_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    """The oil behind the check valve has the least R V / K of this circuit: 0.002 and 0.007 MPa s/ml in parallel with
    10 ml and 1400 MPa make 11 microseconds."""
    monkeypatch.setattr("stommel.machinery.engine.segments._MOST_STEPS", 300)
    found = refusal(engine(), pressure_pa=1e6, inflate_m3=4e-4)
    assert "'check_valve.outlet - line.a'" in found
    assert "oil.node_volume_ml" in found
    R = 1.0 / (1.0 / 0.002 + 1.0 / 0.007)
    expected = R * 10.0 / 1400.0
    told = float(found.split("time constant of ")[1].split(" s")[0])
    assert told == pytest.approx(expected, rel=0.2)


def test_a_day_of_holding_is_no_stiffness() -> None:
    began = time.process_time()
    run = simulate(engine(), pressure_pa=1e6, inflate_m3=1e-4, hold_s=86400.0)
    assert time.process_time() - began < SLOWEST_S
    assert run.phases[-1].duration_s == pytest.approx(86400.0)


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ({"pressure_pa": 3e8}, "pressure = 300 MPa: must be at least 0 (gauge) and at most 200"),
        ({"pressure_pa": -1e6}, "pressure = -1 MPa"),
        ({"pressure_pa": float("nan")}, "pressure = nan MPa"),
        ({"hold_s": 1e6}, "hold = 1e+06 s: must be at least 0 and at most 86400"),
        ({"hold_s": -1.0}, "hold = -1 s"),
        ({"motor_speed_rpm": 0.0}, "motor speed = 0 r/min: must be greater than 0 and at most 50000"),
        ({"motor_speed_rpm": 1e308}, "motor speed = 1e+308 r/min"),
        ({"inflate_m3": -5e-6}, "inflate = -5 ml"),
    ],
)
def test_requests_have_two_ends(asked: dict[str, float], words: str) -> None:
    with pytest.raises(EngineRequestError) as caught:
        simulate(engine(), **({"pressure_pa": 0.0, "inflate_m3": 1e-4} | asked))
    assert words in str(caught.value)


def test_a_hold_shorter_than_a_millisecond_is_none() -> None:
    run = simulate(engine(), pressure_pa=0.0, inflate_m3=1e-4, hold_s=1e-308)
    assert [phase.name for phase in run.phases] == ["inflate"]
