"""Bench tests: engine logs with declared units, their analysis and fit, and hull pressure tests (docs/theory/bench)."""

from stommel.bench.bench_engine import bench_engine, piston_area_of
from stommel.bench.column_map import EngineLogMap, load_map
from stommel.bench.engine_log import EngineLog, EngineRun, joined, read_engine_log
from stommel.bench.failures import BenchFileError, BenchRequestError
from stommel.bench.fitting import DEFAULT_PARAMETERS, EngineFit, FittedParameter, fit_engine
from stommel.bench.generation import BenchPlan, SensorNoise, generate_log, log_text, map_text, write_log
from stommel.bench.holding_cycles import Hold, PressureTest, read_pressure_test
from stommel.bench.leakage import HoldResult, PressureReport, judge
from stommel.bench.performance import OperatingPoint, RunPerformance, model_points, performance
from stommel.bench.quantities import MARKER
from stommel.bench.speed_choice import SpeedCandidate, SpeedChoice, TimeLimit, choose_speed, time_limit_of

__all__ = [
    "DEFAULT_PARAMETERS",
    "MARKER",
    "BenchFileError",
    "BenchPlan",
    "BenchRequestError",
    "EngineFit",
    "EngineLog",
    "EngineLogMap",
    "EngineRun",
    "FittedParameter",
    "Hold",
    "HoldResult",
    "OperatingPoint",
    "PressureReport",
    "PressureTest",
    "RunPerformance",
    "SensorNoise",
    "SpeedCandidate",
    "SpeedChoice",
    "TimeLimit",
    "bench_engine",
    "choose_speed",
    "fit_engine",
    "generate_log",
    "joined",
    "judge",
    "load_map",
    "log_text",
    "map_text",
    "model_points",
    "performance",
    "piston_area_of",
    "read_engine_log",
    "read_pressure_test",
    "time_limit_of",
    "write_log",
]
