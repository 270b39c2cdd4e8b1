"""What cannot be flown, found before the mission begins."""

from collections.abc import Iterator

from stommel.errors import FileError, Problem, StommelError
from stommel.simulation.scenario.mission import Mission


def refuse_impossible(mission: Mission) -> None:
    """Refuse what cannot be flown: too deep for the hull or the water, waypoints on land, outside the ocean.

    Raises
    ------
    FileError
        Everything that is wrong, each with its key and value.
    """
    wrong = [*_too_deep(mission), *_beyond_the_engine(mission), *_places(mission)]
    if not wrong:  # a place in the water can be asked for more
        wrong = [*_bottom(mission), *_end(mission)]
    if wrong:
        raise FileError(wrong)


def _too_deep(mission: Mission) -> Iterator[Problem]:
    hull, depth = mission.vehicle.description.hull, mission.scenario.dives.depth_m
    rating = hull.depth_rating_m if hull is not None else None
    if rating is not None and depth > rating:
        text = f"dives.depth_m = {depth:g}: deeper than the hull's rating, {rating:g} m"
        yield Problem(mission.origin, "dives.depth_m", text)


def _beyond_the_engine(mission: Mission) -> Iterator[Problem]:
    """A ballast volume at the surface that the buoyancy engine does not have."""
    engine, wanted = mission.vehicle.description.actuators.buoyancy, mission.scenario.surface.ballast_ml
    if engine is not None and wanted is not None and wanted > engine.range_ml[1]:
        text = f"surface.ballast_ml = {wanted:g}: more than the buoyancy engine has, {engine.range_ml[1]:g} ml"
        yield Problem(mission.origin, "surface.ballast_ml", text)


def _places(mission: Mission) -> Iterator[Problem]:
    """Start and waypoints on land or outside the ocean; what is wrong with all of them, as the time, is said once."""
    scenario = mission.scenario
    places = {"start": scenario.start} | {f"waypoints.{i}": place for i, place in enumerate(scenario.waypoints)}
    said = set()
    for key, place in places.items():
        try:
            mission.ocean.at(scenario.start_seconds, place.latitude_deg, place.longitude_deg, 0.0)
        except StommelError as error:
            text = f"{key} = ({place.latitude_deg:g}, {place.longitude_deg:g}): {error}"
            if str(error) not in said:
                yield Problem(mission.origin, key, text)
            said.add(str(error))


def _bottom(mission: Mission) -> Iterator[Problem]:
    scenario = mission.scenario
    bottom = mission.ocean.bottom_depth(scenario.start.latitude_deg, scenario.start.longitude_deg)
    if scenario.dives.depth_m > bottom:
        text = f"dives.depth_m = {scenario.dives.depth_m:g}: below the bottom at the start, {bottom:.4g} m"
        yield Problem(mission.origin, "dives.depth_m", text)


def _end(mission: Mission) -> Iterator[Problem]:
    """A mission that may last longer than the ocean's data."""
    scenario = mission.scenario
    try:
        mission.ocean.at(scenario.end_seconds, scenario.start.latitude_deg, scenario.start.longitude_deg, 0.0)
    except StommelError as error:
        text = f"duration_days = {scenario.duration_days:g}: {error}"
        yield Problem(mission.origin, "duration_days", text)
