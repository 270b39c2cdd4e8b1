"""Circuits from files: other engines without new code, and impossible ones with what is wrong."""

from importlib import resources

import pytest

from stommel.errors import FileError
from stommel.machinery.engine import Outcome, engine_of, example_names, load_engine, simulate
from stommel.machinery.engine.circuit import CircuitError, assemble
from stommel.machinery.engine.files import NoEngineError, engine_from_text
from stommel.vehicle import builtin_text, load_vehicle

ML = 1e-6
ZJU = builtin_text("zju")
HIGH_PRESSURE = (resources.files("stommel.machinery.engine") / "examples" / "high-pressure.toml").read_text()
SLOCUM = (resources.files("stommel.machinery.engine") / "examples" / "slocum-1000m.toml").read_text()


def refusal(old: str, new: str, text: str = ZJU) -> str:
    assert old in text
    with pytest.raises(FileError) as caught:
        engine_from_text(text.replace(old, new, 1), "my.toml")
    message = str(caught.value)
    assert message.startswith("my.toml: ")
    assert all(line.startswith("my.toml: ") for line in message.splitlines())
    return message


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ('"bladder.oil", "solenoid_valve.a"]', '"bladder.oil"]', "unconnected port: solenoid_valve.a"),
        ('["line.b", "bladder.oil"', '["line.b", "blader.oil"', "unknown component 'blader' in 'blader.oil'"),
        ('["line.b", "bladder.oil"', '["line.c", "bladder.oil"', "'line' has no port 'c'; its ports are: a, b"),
        ('["line.b", "bladder.oil"', '["line.a", "bladder.oil"', "port 'line.a' is already in connections.4"),
        ('["gearbox.output", "pump.shaft"]', '["gearbox.output", "pump.inlet"]', "joins ports of different kinds"),
        ('["gearbox.output", "pump.shaft"]', '["gearbox.output"], ["pump.shaft"]', "must join at least two ports"),
        ('measures = "reservoir"', 'measures = "pump"', "sensor.measures = 'pump': must be a reservoir or cylinder"),
        ('open_valves = ["solenoid_valve"]', 'open_valves = ["valve"]', "unknown solenoid valve 'valve'"),
        ('open_valves = ["solenoid_valve"]', "open_valves = []", "deflate: neither turns the motor nor opens a valve"),
        ('name = "gearbox"\nratio', 'name = "pump"\nratio', "two parts have the name 'pump'"),
        ("[[engine.gearboxes]]", "[[engine.turbines]]", "engine.turbines: unknown key in [engine]"),
        ("displacement_ml_r = ", "displacement_ml = ", "did you mean displacement_ml_r (in ml/r)?"),
        ("leakage_ml_s_mpa = { value = 1.057", "leakage_ml_s_mpa = { value = -1", "between 0 and 20 ml/(s MPa)"),
        ("efficiency = { value = 0.8,", "efficiency = { value = 1.8,", "engine.gearboxes.0.efficiency = 1.8: must be"),
        ("[22.5, 277.5]", "[22.5, 377.5]", "must lie within the stroke, 0 to 300"),
        ("[22.5, 277.5]", "[277.5, 22.5]", "the first number must be less than the second"),
    ],
)  # fmt: skip
def test_impossible_circuits(old: str, new: str, expected: str) -> None:
    text = ZJU.replace(old, new, 1)
    with pytest.raises(FileError) as caught:
        engine_from_text(text, "my.toml")
    assert expected in str(caught.value)


def test_no_bladder() -> None:
    assert "bladders: exactly one is needed, there are 0" in refusal(
        '[[engine.bladders]]\nname = "bladder"', "", SLOCUM
    )


def test_parts_that_cannot_work_together() -> None:
    two_stores = HIGH_PRESSURE.replace('"accumulator.oil", ', "").replace(
        '"bladder.oil", "solen', '"bladder.oil", "accumulator.oil", "solen'
    )
    with pytest.raises(CircuitError, match="has two stores of oil"):
        assemble(engine_from_text(two_stores, "my.toml").engine)
    backwards = HIGH_PRESSURE.replace('"gearbox.input"', '"gearbox.x"').replace('"gearbox.output"', '"gearbox.input"')
    with pytest.raises(CircuitError, match=r"no motor drives gearbox\.input, pump\.shaft"):
        assemble(engine_from_text(backwards.replace('"gearbox.x"', '"gearbox.output"'), "my.toml").engine)
    joined = '["motor.shaft", "gearbox.input", "gearbox.output", "screw.shaft"]'
    circle = SLOCUM.replace('["motor.shaft", "gearbox.input"]', joined)
    with pytest.raises(CircuitError, match="the train closes on itself"):
        assemble(engine_from_text(circle.replace('  ["gearbox.output", "screw.shaft"],\n', ""), "my.toml").engine)


def test_vehicle_files_are_checked_when_they_are_loaded() -> None:
    from stommel.vehicle import vehicle_from_text

    with pytest.raises(FileError, match=r"unconnected port: solenoid_valve\.a"):
        vehicle_from_text(ZJU.replace('"bladder.oil", "solenoid_valve.a"', '"bladder.oil"'), "my.toml")


def test_examples() -> None:
    assert example_names() == ("high-pressure", "slocum-1000m")
    assert load_engine("slocum-1000m").name == "Slocum 1000 m piston pump"
    with pytest.raises(NoEngineError, match="neither an example nor a file"):
        load_engine("webb")
    with pytest.raises(NoEngineError, match=r"no table \[engine\]"):
        engine_of(load_vehicle("rogue"))


def test_slocum_pump_reaches_its_published_flow_and_volume() -> None:
    """+-263 cc at 4 cc/s (Merckelbach et al. 2019), down to 1000 m, both ways."""
    engine = load_engine("slocum-1000m").engine
    assert engine.measured_piston.working_volume_ml == pytest.approx(526.0, abs=0.5)
    run = simulate(engine, pressure_pa=10e6, inflate_m3=520 * ML, deflate_m3=520 * ML)
    inflate, deflate = run.phases
    assert inflate.outcome is deflate.outcome is Outcome.REACHED
    for phase in (inflate, deflate):
        assert 520.0 / phase.duration_s == pytest.approx(4.0, rel=0.01)
    # the sea pushes the piston back: cheaper than the way out
    assert deflate.energy_j < 0.1 * inflate.energy_j


def test_high_pressure_pump_at_1000_m() -> None:
    run = simulate(load_engine("high-pressure").engine, pressure_pa=10e6, inflate_m3=500 * ML, deflate_m3=500 * ML)
    assert [phase.outcome for phase in run.phases] == [Outcome.REACHED, Outcome.REACHED]
    assert 0.3 < run.phases[0].efficiency < 0.8
