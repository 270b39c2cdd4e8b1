"""Why a budget cannot be computed or used."""

from stommel.errors import StommelError


class BudgetError(StommelError):
    """The vehicle file lacks what a budget needs, or the budget is of no vehicle that could float."""
