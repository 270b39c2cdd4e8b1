"""Buoyancy engine: its parts and circuit, simulation, steady pumping, energy of an inflation (docs/theory/engine).

Names are imported when they are first used: steady pumping alone needs neither compiler nor integrator.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

_WHERE = {
    "EngineParameters": "steady_state",
    "EngineRequestError": "cycle",
    "EngineRun": "results",
    "InflationCosts": "reduction",
    "NamedEngine": "files",
    "Outcome": "results",
    "PhaseResult": "results",
    "SteadyState": "steady_state",
    "engine_of": "files",
    "engine_parameters": "reduction",
    "example_names": "files",
    "inflation_energy": "reduction",
    "load_engine": "files",
    "simulate": "cycle",
    "stall_pressure": "stall",
}

__all__ = [
    "EngineParameters",
    "EngineRequestError",
    "EngineRun",
    "InflationCosts",
    "NamedEngine",
    "Outcome",
    "PhaseResult",
    "SteadyState",
    "engine_of",
    "engine_parameters",
    "example_names",
    "inflation_energy",
    "load_engine",
    "simulate",
    "stall_pressure",
]

if TYPE_CHECKING:
    from stommel.machinery.engine.cycle import EngineRequestError, simulate
    from stommel.machinery.engine.files import NamedEngine, engine_of, example_names, load_engine
    from stommel.machinery.engine.reduction import InflationCosts, engine_parameters, inflation_energy
    from stommel.machinery.engine.results import EngineRun, Outcome, PhaseResult
    from stommel.machinery.engine.stall import stall_pressure
    from stommel.machinery.engine.steady_state import EngineParameters, SteadyState


def __getattr__(name: str) -> Any:
    if name not in _WHERE:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_WHERE[name]}"), name)
