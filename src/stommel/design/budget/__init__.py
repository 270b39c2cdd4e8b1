"""Mass and volume budget: centres, inertia, trim weight and foam, reserve of the buoyancy engine."""

from stommel.design.budget.applying import applied_text
from stommel.design.budget.failures import BudgetError
from stommel.design.budget.mass_properties import MassProperties
from stommel.design.budget.reserve import Reserve, ReserveRow
from stommel.design.budget.study import BudgetStudy, budget_study
from stommel.design.budget.totals import BayTotal, Budget, mass_budget
from stommel.design.budget.trimming import AddedBody, Trimming

__all__ = [
    "AddedBody",
    "BayTotal",
    "Budget",
    "BudgetError",
    "BudgetStudy",
    "MassProperties",
    "Reserve",
    "ReserveRow",
    "Trimming",
    "applied_text",
    "budget_study",
    "mass_budget",
]
