"""Engine logs made by the model, with noise from a seed, and marked as such.

The paper shows its bench results (Figs. 14 and 15) as curves without numbers: there is no measured log to test with.
"""

from dataclasses import asdict, dataclass
from math import isfinite, pi
from pathlib import Path

import numpy as np

from stommel.bench.engine_log import EngineLog, EngineRun
from stommel.bench.failures import BenchRequestError
from stommel.bench.performance import OperatingPoint, model_points
from stommel.bench.quantities import MARKER, QUANTITIES
from stommel.files.whole import write_whole
from stommel.machinery.engine.steady_state import EngineParameters
from stommel.version import __version__

PAPER_PRESSURES_MPA = (0.0, 0.5, 1.0, 1.5, 2.0, 2.5)
"""Section 5.1.2 of the paper."""
PAPER_SPEEDS_RPM = (3500.0, 5250.0, 7000.0, 8750.0)
"""Section 5.1.2 of the paper."""


MOST_ROWS = 100_000
"""Of one run."""
MOST_RUNS = 1000


@dataclass(frozen=True)
class SensorNoise:
    """Standard deviations of independent normal errors: assumptions about a careful bench, none is published."""

    pressure_pa: float = 5e3
    motor_speed_rad_s: float = 15 * 2 * pi / 60
    voltage_v: float = 0.05
    current_a: float = 0.02
    piston_travel_m: float = 1e-4
    current_repeat: float = 0.01
    """From run to run, relative: temperature and running-in change friction."""
    flow_repeat: float = 0.005
    """From run to run, relative."""

    def times(self, factor: float) -> "SensorNoise":
        """All errors larger by a factor.

        Raises
        ------
        BenchRequestError
            The factor is negative or not finite.
        """
        if not (isfinite(factor) and factor >= 0.0):
            raise BenchRequestError(f"noise = {factor:g}: must be at least 0, in multiples of the usual noise")
        return SensorNoise(**{name: value * factor for name, value in asdict(self).items()})


@dataclass(frozen=True)
class BenchPlan:
    """What the bench does: every speed against every pressure, inflating."""

    pressures: tuple[float, ...] = tuple(p * 1e6 for p in PAPER_PRESSURES_MPA)
    """Gauge [Pa]."""
    motor_speeds: tuple[float, ...] = tuple(n * 2 * pi / 60 for n in PAPER_SPEEDS_RPM)
    """[rad/s]"""
    piston_from: float = 0.2775
    """Where an inflation begins [m]: section 4.3.2 of the paper."""
    piston_to: float = 0.0225
    """Where it ends [m]."""
    period: float = 0.5
    """Between two rows [s]."""
    longest: float = 600.0
    """A run is stopped after so long [s]."""


# digits after the point, in the unit that stommel writes: the resolution of the sensors
_DECIMALS = {"time": 3, "pressure": 4, "motor_speed": 1, "voltage": 3, "current": 4, "piston_travel": 3}
_HEADERS = {name: f"{name}_{unit}" for name, unit in zip(QUANTITIES, ("s", "mpa", "rpm", "v", "a", "mm"), strict=True)}
_RANGES = {"pressure": [-0.1, 10.0], "current": [-1.0, 30.0], "piston_travel": [0.0, 300.0]}
"""Ranges of the sensors of a generated log, in the written unit; the piston's stroke is 300 mm (section 4.3.2)."""


def generate_log(
    engine: EngineParameters, seed: int, plan: BenchPlan | None = None, noise: SensorNoise | None = None
) -> EngineLog:
    """Run the model on a bench: steady pumping, no start-up, normal noise; the same seed gives the same log.

    Parameters
    ----------
    engine
        The constants to be recovered.
    seed
        Of the noise; 0 or more.
    plan
        Pressures, speeds and sampling; the paper's if left out.
    noise
        Of the sensors and from run to run.

    Raises
    ------
    BenchRequestError
        The engine pumps nothing at a point of the plan, or a number is impossible.
    """
    plan, noise = plan or BenchPlan(), noise or SensorNoise()
    _check_request(seed, plan, noise)
    points = [_as_supplied(engine, P, omega) for P in plan.pressures for omega in plan.motor_speeds]
    random = np.random.default_rng(seed)
    runs = tuple(_run(f"{k:02d}", point, plan, noise, random) for k, point in enumerate(points, start=1))
    true = {name: value for name, value in asdict(engine).items() if isfinite(value)}
    return EngineLog(MARKER, runs, float(np.sqrt(4 / pi * engine.piston_area_m2)), true)


def _check_request(seed: int, plan: BenchPlan, noise: SensorNoise) -> None:
    runs = len(plan.pressures) * len(plan.motor_speeds)
    if runs > MOST_RUNS:
        raise BenchRequestError(f"{runs} runs: at most {MOST_RUNS} pressures times motor speeds are allowed")
    shortest = plan.longest / MOST_ROWS
    for words, value, possible, allowed in (
        ("seed", seed, seed >= 0, "at least 0"),
        ("pressure", min(plan.pressures) / 1e6, min(plan.pressures) >= 0.0, "at least 0 MPa"),
        ("motor speed", min(plan.motor_speeds) * 60 / (2 * pi), min(plan.motor_speeds) > 0.0, "greater than 0 r/min"),
        ("period", plan.period, plan.period >= shortest, f"at least {shortest:g} s"),
        ("least noise", min(asdict(noise).values()), min(asdict(noise).values()) >= 0.0, "at least 0"),
    ):
        if not (possible and isfinite(value)):
            raise BenchRequestError(f"{words} = {value:g}: must be {allowed}")


def _as_supplied(engine: EngineParameters, P: float, omega: float) -> OperatingPoint:
    """The point that the motor reaches: slower than set where the supply does not allow the speed under this load."""
    (point,) = model_points(engine, [P], [omega])
    if point.attainable:
        return point
    slower = omega * np.linspace(0.0, 1.0, 1001)[1:]
    reached = [one for one in model_points(engine, [P], slower) if one.attainable]
    if not reached:
        raise BenchRequestError(
            f"the engine pumps nothing against {P / 1e6:g} MPa at {omega * 60 / (2 * pi):.0f} r/min or slower: supply "
            "voltage, current limit or leakage"
        )
    return reached[-1]


def _run(
    name: str, point: OperatingPoint, plan: BenchPlan, noise: SensorNoise, random: np.random.Generator
) -> EngineRun:
    repeat_v, repeat_i = 1.0 + random.standard_normal(2) * (noise.flow_repeat, noise.current_repeat)
    v = point.piston_speed * repeat_v
    stroke = plan.piston_from - plan.piston_to
    rows = int(min(abs(stroke) / v, plan.longest) / plan.period) + 1
    t = plan.period * np.arange(rows)
    series = {
        "time": t,
        "pressure": point.pressure + noise.pressure_pa * random.standard_normal(rows),
        "motor_speed": point.motor_speed + noise.motor_speed_rad_s * random.standard_normal(rows),
        "voltage": point.voltage + noise.voltage_v * random.standard_normal(rows),
        "current": point.current * repeat_i + noise.current_a * random.standard_normal(rows),
        "piston_travel": plan.piston_from
        - np.sign(stroke) * v * t
        + noise.piston_travel_m * random.standard_normal(rows),
    }
    return EngineRun(name, **{quantity: _as_written(quantity, values) for quantity, values in series.items()})


def _as_written(
    quantity: str, values: np.ndarray[tuple[int, ...], np.dtype[np.float64]]
) -> "np.ndarray[tuple[int, ...], np.dtype[np.float64]]":
    factor = next(iter(QUANTITIES[quantity].units.values()))
    return np.round(values / factor, _DECIMALS[quantity]) * factor


def log_text(log: EngineLog, seed: int, vehicle: str) -> str:
    """Text of the CSV file of a generated log; its first line says that nobody measured it."""
    lines = [
        f"# {MARKER}",
        f"# stommel {__version__}, vehicle {vehicle}, seed {seed}: steady pumping with normal noise",
        ",".join(["run", *_HEADERS.values()]),
    ]
    factors = {name: next(iter(quantity.units.values())) for name, quantity in QUANTITIES.items()}
    for run in log.runs:
        columns = [getattr(run, name) / factors[name] for name in QUANTITIES]
        form = ",".join(f"{{:.{_DECIMALS[name]}f}}" for name in QUANTITIES)
        lines += [f"{run.name},{form.format(*row)}" for row in zip(*columns, strict=True)]
    return "\n".join(lines) + "\n"


def map_text(log: EngineLog, seed: int, vehicle: str) -> str:
    """Text of the column map of a generated log, with the constants that made it."""
    lines = [
        f"# Column map of a log that was {MARKER}.",
        "format = 1",
        f'origin = "{MARKER}"',
        f"piston_diameter_mm = {(log.piston_diameter_m or 0.0) * 1e3:.12g}",
        "",
        "[columns]",
        'run = "run"',
    ]
    for name, quantity in QUANTITIES.items():
        sensor = f", range = {_RANGES[name]}" if name in _RANGES else ""
        lines.append(f'{name} = {{ column = "{_HEADERS[name]}", unit = "{next(iter(quantity.units))}"{sensor} }}')
    lines += ["", "[generated]", f'vehicle = "{vehicle}"', f"seed = {seed}", "", "[generated.parameters]"]
    lines += [f"{name} = {float(value)!r}" for name, value in (log.true_parameters or {}).items()]
    return "\n".join(lines) + "\n"


def write_log(log: EngineLog, path: Path, seed: int, vehicle: str) -> list[Path]:
    """Write a generated log and its column map beside it, and return their paths.

    Raises
    ------
    OutputError
        A file cannot be written.
    BenchRequestError
        The name of the log ends in .toml, where its map belongs.
    """
    beside = path.with_suffix(".toml")
    if beside == path:
        raise BenchRequestError(f"{path}: a log ends in .csv; its column map is written to the .toml beside it")
    write_whole(path, log_text(log, seed, vehicle))
    write_whole(beside, map_text(log, seed, vehicle))
    return [path, beside]
