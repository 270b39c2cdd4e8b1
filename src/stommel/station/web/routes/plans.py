"""Plans: problems, orders, predicted flight, what the vehicle flies as a plan."""

from typing import Annotated, Any

from fastapi import APIRouter, Path, Query

from stommel.geometry.geodesics import Place
from stommel.planning.vehicle_limits import vehicle_limits
from stommel.plans.expected_water import ocean_at
from stommel.plans.fields import plan_fields
from stommel.plans.flown import current_of_last_dive, held_mission, neutral_density
from stommel.plans.plan import StationPlan
from stommel.plans.problems import PlanError, plan_from
from stommel.plans.resolving import resolved
from stommel.plans.templates import DEFAULT_START, place_row, templates
from stommel.station.station import Station
from stommel.station.web.access import Pilot, Viewer
from stommel.station.web.errors import refusal
from stommel.station.web.found import Line, TheStation, line_to
from stommel.station.web.routes.plan_shapes import (
    Checked,
    FlownPlan,
    Job,
    OpenedPlan,
    OrdersBody,
    PlanBody,
    PlanTemplate,
    PlanTemplates,
    Problem,
    StartedJob,
)
from stommel.vehicle import builtin_names, load_vehicle

router = APIRouter(prefix="/api", tags=["plans"])

JobName = Annotated[str, Path(min_length=1, max_length=64, pattern=r"^[0-9a-f]+$")]
DEFAULT_VEHICLE = "zju"


@router.get("/plan-templates", response_model_exclude_unset=True)
def list_plan_templates(
    _user: Viewer, station: TheStation, vehicle: Annotated[int | None, Query(ge=1, le=250)] = None
) -> PlanTemplates:
    """Return plans to begin with, at the place of a vehicle if one is named."""
    model, start, density = DEFAULT_VEHICLE, None, None
    if vehicle is not None:
        line_to(vehicle, station)
        model, start = _model(station, vehicle), _place(station, vehicle)
        density = neutral_density(station.archive, vehicle)
    limits = vehicle_limits(load_vehicle(model))
    around = {} if density is None else {"neutral_density_kg_m3": density}
    return PlanTemplates(
        templates=[
            PlanTemplate(name=each.name, words=each.words, plan=plan_from(each.plan))
            for each in templates(model, start, limits.depth_rating_m, around)
        ],
        fields=plan_fields(limits),
        vehicles=_vehicles(station),
    )


@router.post("/plans/validate")
def validate_plan(_user: Pilot, body: PlanBody, station: TheStation) -> Checked:
    """Return everything that is wrong with a plan at once, or its orders."""
    try:
        plan = _plan(station, body)
    except PlanError as error:
        return Checked(problems=[Problem(**each.as_row()) for each in error.problems], warnings=[], orders=None)
    return Checked(**station.previews.check(plan))


@router.post("/plans/preview", status_code=202)
def preview_plan(_user: Pilot, body: PlanBody, station: TheStation) -> StartedJob:
    """Let the simulator fly a plan; the job tells how far it is."""
    return StartedJob(job=station.previews.start(_plan(station, body)))


@router.post("/plans/open", response_model_exclude_unset=True)
def open_orders(
    _user: Pilot, body: OrdersBody, station: TheStation, vehicle: Annotated[int, Query(ge=1, le=250)]
) -> OpenedPlan:
    """Return the plan of an orders file for a vehicle."""
    line_to(vehicle, station)
    return OpenedPlan(**station.previews.opened(body.orders, _around(station, vehicle)))


@router.get("/jobs/{job}")
def show_job(_user: Viewer, job: JobName, station: TheStation) -> Job:
    """Return how far a job is, and its result once it is done."""
    return Job(**station.previews.job(job))


@router.delete("/jobs/{job}")
def cancel_job(_user: Pilot, job: JobName, station: TheStation) -> Job:
    """Cancel a job; one that is over stays as it is."""
    station.previews.cancel(job)
    return Job(**station.previews.job(job))


@router.get("/vehicles/{vehicle}/mission/plan", response_model_exclude_unset=True)
def show_flown_plan(_user: Viewer, line: Line, station: TheStation) -> FlownPlan:
    """Return the plan of the mission that the vehicle holds: as it was made, or as its orders tell."""
    held = held_mission(station.archive, line.vehicle)
    if held is None:
        raise refusal(404, f"it is not known which mission vehicle {line.vehicle} holds")
    about = {"mission": held.name, "sha256": held.sha256, "t": held.begin or None}
    if held.plan is not None:
        return FlownPlan.model_validate(about | {"plan": plan_from(held.plan), "remarks": []})
    return FlownPlan.model_validate(about | station.previews.opened(held.orders, _around(station, line.vehicle)))


def _plan(station: Station, body: PlanBody) -> StationPlan:
    """The plan of a request, with what the station knows filled in."""
    number = body.vehicle
    if number is not None:
        line_to(number, station)
    return resolved(
        plan_from(body.plan),
        now=station.now(number),
        vehicles=_vehicles(station),
        model=None if number is None else _model(station, number),
        current=None if number is None else current_of_last_dive(station.archive, number),
    )


def _model(station: Station, vehicle: int) -> str:
    return station.vehicles[vehicle].settings.model


def _vehicles(station: Station) -> list[str]:
    own = (line.settings.model for line in station.vehicles.values())
    return sorted({*builtin_names(), *own})


def _place(station: Station, vehicle: int) -> Place | None:
    """Where the vehicle is; None if it is not known."""
    position = station.summary(vehicle).get("position")
    return None if position is None else Place(position["latitude"], position["longitude"])


def _around(station: Station, vehicle: int) -> dict[str, Any]:
    """What orders do not hold: vehicle, start and water."""
    here = _place(station, vehicle) or DEFAULT_START
    return {"vehicle": _model(station, vehicle), "start": place_row(here), "water": {"ocean": ocean_at(here)}}
