"""Efficiency and consumption of the buoyancy engine on the bench, as section 5.1.2 of the paper defines them."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stommel.bench.engine_log import EngineLog, EngineRun
from stommel.bench.failures import BenchRequestError
from stommel.machinery.engine.steady_state import EngineParameters, steady_state

Array = NDArray[np.float64]

LEVEL_SHARE = 0.04
"""Runs whose pressures, or speeds, differ by less than this share of the greatest one are at the same level."""
FASTER_THAN_PUMP = 1.15
"""A piston that moves faster than this times what the pump displaces has a wrong unit."""


@dataclass(frozen=True)
class OperatingPoint:
    """The engine at one speed against one pressure; SI units."""

    pressure: float
    """P, gauge [Pa]."""
    motor_speed: float
    """[rad/s]"""
    voltage: float
    """U of the supply [V]."""
    current: float
    """I from the supply, averaged over the run [A]."""
    piston_speed: float
    """l / t [m/s]."""
    K: float
    """U I t / l, energy per metre of piston travel [J/m]."""
    efficiency: float
    """eta = P S l / (U I t)."""
    attainable: bool = True
    """The supply allows this speed under this load."""

    def inflating_time(self, volume: float, piston_area: float) -> float:
        """Time for a volume [m3] with a piston of an area [m2], in seconds."""
        return volume / (piston_area * self.piston_speed)


@dataclass(frozen=True)
class RunPerformance:
    """What one run says."""

    name: str
    point: OperatingPoint
    duration: float
    """t, from the first row with the motor turning to the last [s]."""
    travel: float
    """l, displacement of the piston [m]."""
    speed_error: float
    """Standard error of the piston's speed from the scatter of its readings, relative."""
    current_error: float
    """Standard error of the average current, relative."""

    def as_row(self, piston_area: float, volume: float) -> dict[str, float | str]:
        """Words and units for JSON and tables."""
        p = self.point
        return {
            "run": self.name,
            "pressure_mpa": p.pressure / 1e6,
            "motor_speed_rpm": p.motor_speed * 60 / (2 * pi),
            "voltage_v": p.voltage,
            "average_current_a": p.current,
            "duration_s": self.duration,
            "piston_travel_mm": self.travel * 1e3,
            "energy_j": p.K * self.travel,
            "consumption_j_per_mm": p.K / 1e3,
            "efficiency": p.efficiency,
            "flow_ml_s": p.piston_speed * piston_area * 1e6,
            "inflating_time_s": p.inflating_time(volume, piston_area),
        }


def run_performance(run: EngineRun, piston_area: float) -> RunPerformance:
    """Average one run.

    Parameters
    ----------
    run
        Readings while the motor turns.
    piston_area
        S, cross-section of the reservoir's piston [m2].

    Raises
    ------
    BenchRequestError
        More work comes out than goes in: a unit or the piston's diameter is wrong.
    """
    t = float(run.time[-1] - run.time[0])
    l = abs(float(run.piston_travel[-1] - run.piston_travel[0]))
    P, U, I = (float(np.mean(series)) for series in (run.pressure, run.voltage, run.current))
    if U * I <= 0.0:
        raise BenchRequestError(f"run {run.name}: {U:g} V and {I:g} A on average: the motor takes no power")
    K = U * I * t / l  # section 5.1.2
    efficiency = P * piston_area / K  # section 5.1.2
    if efficiency > 1.0:
        raise BenchRequestError(
            f"run {run.name}: efficiency {efficiency:.3g} is more than 1, from {P / 1e6:.4g} MPa, {U:.4g} V, "
            f"{I:.4g} A, {l * 1e3:.4g} mm in {t:.4g} s: a unit of the column map or the piston's diameter is wrong"
        )
    point = OperatingPoint(P, float(np.mean(run.motor_speed)), U, I, l / t, K, efficiency)
    n = len(run.time)
    line = np.polynomial.Polynomial.fit(run.time, run.piston_travel, 1)
    scatter = float(np.std(run.piston_travel - line(run.time), ddof=2))
    speed_error = scatter / (float(np.std(run.time)) * np.sqrt(n)) / (l / t)
    return RunPerformance(run.name, point, t, l, speed_error, float(np.std(run.current, ddof=1)) / np.sqrt(n) / I)


def performance(log: EngineLog, piston_area: float, engine: EngineParameters | None = None) -> list[RunPerformance]:
    """Average every run of a log, by pressure and then by speed.

    Parameters
    ----------
    log
        Checked runs.
    piston_area
        S [m2].
    engine
        If given, its pump must be able to move the piston as fast as the log says.

    Raises
    ------
    BenchRequestError
        A run gives an impossible efficiency, or a piston faster than its pump.
    """
    found = [run_performance(run, piston_area) for run in log.runs]
    if engine is not None:
        for one in found:
            _no_faster_than_the_pump(one, piston_area, engine)
    return sorted(found, key=lambda one: (round(one.point.pressure / 5e4), one.point.motor_speed))


def _no_faster_than_the_pump(one: RunPerformance, piston_area: float, engine: EngineParameters) -> None:
    ideal = engine.displacement_m3_rev * one.point.motor_speed / (2 * pi) / engine.gear_ratio
    flow = piston_area * one.point.piston_speed
    if flow > FASTER_THAN_PUMP * ideal:
        raise BenchRequestError(
            f"run {one.name}: the piston moves {flow * 1e6:.4g} ml/s where the pump displaces {ideal * 1e6:.4g} ml/s "
            f"at {one.point.motor_speed * 60 / (2 * pi):.4g} r/min: the unit of travel, time or motor speed is wrong"
        )


def model_points(engine: EngineParameters, pressures: ArrayLike, motor_speeds: ArrayLike) -> list[OperatingPoint]:
    """Operating points of the model at every pair of pressure [Pa] and motor speed [rad/s], by pressure, then speed."""
    P, omega = (grid.ravel() for grid in np.meshgrid(pressures, motor_speeds, indexing="ij"))
    steady = steady_state(engine, P, omega)
    v = steady.flow_m3_s / engine.piston_area_m2
    with np.errstate(divide="ignore"):
        K = np.where(v > 0.0, steady.power_w / np.where(v > 0.0, v, 1.0), np.inf)
    return [
        OperatingPoint(
            pressure=float(P[k]),
            motor_speed=float(omega[k]),
            voltage=engine.supply_voltage_v,
            current=float(steady.supply_current_a[k]),
            piston_speed=float(v[k]),
            K=float(K[k]),
            efficiency=float(steady.total_efficiency[k]),
            attainable=bool(steady.attainable[k] and not steady.stalled[k]),
        )
        for k in range(len(P))
    ]


def levels(values: Sequence[float]) -> list[float]:
    """Distinct levels among values that scatter, in rising order: the mean of each cluster."""
    ordered = np.sort(np.asarray(values, dtype=np.float64))
    apart = LEVEL_SHARE * float(np.max(np.abs(ordered)))
    clusters = np.split(ordered, np.flatnonzero(np.diff(ordered) > apart) + 1)
    return [float(np.mean(cluster)) for cluster in clusters]


def nearest(value: float, among: Sequence[float]) -> int:
    """Index of the level that a value belongs to."""
    return int(np.argmin(np.abs(np.asarray(among) - value)))
