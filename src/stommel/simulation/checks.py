"""What cannot be flown, found before the mission begins."""

from stommel.errors import FileError, Problem, StommelError
from stommel.simulation.mission import Mission


def refuse_impossible(mission: Mission) -> None:
    """Refuse what cannot be flown: too deep for the hull, waypoints on land or outside the ocean."""
    plan, hull, origin = mission.plan, mission.vehicle.description.hull, mission.origin
    wrong: list[Problem] = []
    rating = hull.depth_rating_m if hull is not None else None
    if rating is not None and plan.dives.depth_m > rating:
        text = f"dives.depth_m = {plan.dives.depth_m:g}: deeper than the hull's rating, {rating:g} m"
        wrong.append(Problem(origin, "dives.depth_m", text))
    places = {"start": plan.start} | {f"waypoints.{i}": place for i, place in enumerate(plan.waypoints)}
    for key, place in places.items():
        try:
            mission.ocean.at(plan.start_seconds, place.latitude_deg, place.longitude_deg, 0.0)
        except StommelError as error:
            text = f"{key} = ({place.latitude_deg:g}, {place.longitude_deg:g}): {error}"
            wrong.append(Problem(origin, key, text))
    if not wrong:
        bottom = mission.ocean.bottom_depth(plan.start.latitude_deg, plan.start.longitude_deg)
        if plan.dives.depth_m > bottom:
            text = f"dives.depth_m = {plan.dives.depth_m:g}: below the bottom at the start, {bottom:.4g} m"
            wrong.append(Problem(origin, "dives.depth_m", text))
    if wrong:
        raise FileError(wrong)
