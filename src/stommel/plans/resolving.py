"""What a plan leaves to the station: the time, the current of the last dive, which vehicles there are."""

from collections.abc import Sequence
from datetime import UTC, datetime

from stommel.plans.plan import StationPlan
from stommel.plans.problems import PlanError, PlanProblem

Current = tuple[float, float]
"""To east and north [m/s]."""


def resolved(
    plan: StationPlan, *, now: float, vehicles: Sequence[str], model: str | None = None, current: Current | None = None
) -> StationPlan:
    """Return a plan with everything filled in that the station knows.

    Parameters
    ----------
    plan
        As people made it.
    now
        Time of the vehicle, or of the station [s since 1970].
    vehicles
        Vehicle files that may be named.
    model
        File of the vehicle that the plan is for, if it is for one.
    current
        Of the last dive; None: none is known.

    Raises
    ------
    PlanError
        The vehicle is another one, or no current is known.
    """
    wrong = [*_vehicle(plan.vehicle, vehicles, model), *_current(plan, current)]
    if wrong:
        raise PlanError(wrong)
    changes: dict[str, object] = {}
    if plan.start_time is None:
        changes["start_time"] = datetime.fromtimestamp(now, UTC)
    if plan.water.current == "last_dive" and current is not None:
        told = {"current": "given", "east_m_s": current[0], "north_m_s": current[1]}
        changes["water"] = plan.water.model_copy(update=told)
    return plan.model_copy(update=changes)


def _vehicle(name: str, vehicles: Sequence[str], model: str | None) -> list[PlanProblem]:
    if model is not None and name != model:
        return [
            _not(f"vehicle = {name!r}: must be {model!r}, the file of the vehicle that the plan is for", name, model)
        ]
    if name not in vehicles:
        allowed = ", ".join(vehicles)
        return [_not(f"vehicle = {name!r}: must be one that this station knows: {allowed}", name, allowed)]
    return []


def _not(reason: str, name: str, allowed: str) -> PlanProblem:
    return PlanProblem("vehicle", name, reason, allowed)


def _current(plan: StationPlan, current: Current | None) -> list[PlanProblem]:
    if plan.water.current != "last_dive" or current is not None:
        return []
    reason = "water.current = 'last_dive': no dive of this vehicle has found a current yet: must be another one"
    return [PlanProblem("water.current", "last_dive", reason, "ocean, still, given")]
