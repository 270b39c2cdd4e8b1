"""stommel: the open system for underwater gliders, from equations to ocean.

The names below are the library's front door; each is imported when it is first used, because compiled physics takes
time to load and a script may want only one of them.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from stommel.version import __version__

_WHERE = {
    "FULL": "stommel.vehicle",
    "PAPER": "stommel.vehicle",
    "Physics": "stommel.vehicle",
    "Vehicle": "stommel.vehicle",
    "builtin_names": "stommel.vehicle",
    "load_vehicle": "stommel.vehicle",
    "Ocean": "stommel.ocean",
    "SteadyFlight": "stommel.analysis",
    "UnreachableFlightError": "stommel.analysis",
    "authority": "stommel.analysis",
    "best_conditions": "stommel.analysis",
    "flight_envelope": "stommel.analysis",
    "linearise": "stommel.analysis",
    "modes": "stommel.analysis",
    "ranges_needed": "stommel.analysis",
    "root_locus": "stommel.analysis",
    "steady_flight": "stommel.analysis",
    "trim": "stommel.analysis",
    "trim_table": "stommel.analysis",
    "turn": "stommel.analysis",
    "design_study": "stommel.design.study",
    "write_report": "stommel.report",
    "Mission": "stommel.simulation.scenario.mission",
    "load_mission": "stommel.simulation.scenario.loading",
    "fly_mission": "stommel.simulation.flight",
    "Simulator": "stommel.simulation.simulator",
    "dataset_of": "stommel.simulation.results.dataset",
    "StommelError": "stommel.errors",
}

__all__ = [
    "FULL",
    "PAPER",
    "Mission",
    "Ocean",
    "Physics",
    "Simulator",
    "SteadyFlight",
    "StommelError",
    "UnreachableFlightError",
    "Vehicle",
    "__version__",
    "authority",
    "best_conditions",
    "builtin_names",
    "dataset_of",
    "design_study",
    "flight_envelope",
    "fly_mission",
    "linearise",
    "load_mission",
    "load_vehicle",
    "modes",
    "ranges_needed",
    "root_locus",
    "steady_flight",
    "trim",
    "trim_table",
    "turn",
    "write_report",
]

if TYPE_CHECKING:
    from stommel.analysis.authority import authority
    from stommel.analysis.envelope import flight_envelope, ranges_needed
    from stommel.analysis.flight import SteadyFlight
    from stommel.analysis.limits import UnreachableFlightError
    from stommel.analysis.linearization import linearise
    from stommel.analysis.modes import modes
    from stommel.analysis.performance import best_conditions
    from stommel.analysis.root_locus import root_locus
    from stommel.analysis.trim import steady_flight, trim, trim_table
    from stommel.analysis.turn import turn
    from stommel.design.study import design_study
    from stommel.errors import StommelError
    from stommel.ocean import Ocean
    from stommel.report import write_report
    from stommel.simulation.flight import fly_mission
    from stommel.simulation.results.dataset import dataset_of
    from stommel.simulation.scenario.loading import load_mission
    from stommel.simulation.scenario.mission import Mission
    from stommel.simulation.simulator import Simulator
    from stommel.vehicle import FULL, PAPER, Physics, Vehicle, builtin_names, load_vehicle


def __getattr__(name: str) -> Any:
    if name not in _WHERE:
        raise AttributeError(f"module 'stommel' has no attribute {name!r}")
    return getattr(import_module(_WHERE[name]), name)


def __dir__() -> list[str]:
    return sorted(__all__)
