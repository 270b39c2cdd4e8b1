"""What the equations imply for a design: trim, turning flight, envelope, linearisation, modes, root locus."""

from stommel.analysis.authority import Authority, authority
from stommel.analysis.envelope import (
    EnvelopeRow,
    RangesNeeded,
    flight_envelope,
    ranges_needed,
    specified_flights,
)
from stommel.analysis.flight import SteadyFlight
from stommel.analysis.limits import Excess, Reason, UnreachableFlightError
from stommel.analysis.linearization import Linearization, LinearModel, linearise
from stommel.analysis.modes import Mode, Modes, modes
from stommel.analysis.performance import BestConditions, best_conditions
from stommel.analysis.request import RequestError
from stommel.analysis.root_locus import RootLocus, root_locus
from stommel.analysis.trim import TrimRow, steady_flight, trim, trim_table
from stommel.analysis.turn import turn

__all__ = [
    "Authority",
    "BestConditions",
    "EnvelopeRow",
    "Excess",
    "LinearModel",
    "Linearization",
    "Mode",
    "Modes",
    "RangesNeeded",
    "Reason",
    "RequestError",
    "RootLocus",
    "SteadyFlight",
    "TrimRow",
    "UnreachableFlightError",
    "authority",
    "best_conditions",
    "flight_envelope",
    "linearise",
    "modes",
    "ranges_needed",
    "root_locus",
    "specified_flights",
    "steady_flight",
    "trim",
    "trim_table",
    "turn",
]
