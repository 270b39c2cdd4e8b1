"""What a path names: the vehicle, or that there is none."""

from typing import Annotated, Any

from fastapi import Depends, Request

from stommel.station.station import Station
from stommel.station.vehicles.line import VehicleLine
from stommel.station.web.access import VehicleNumber, no_vehicle


def the_station(request: Request) -> Station:
    """The station that is served."""
    station: Any = request.app.state.station
    found: Station = station
    return found


TheStation = Annotated[Station, Depends(the_station)]


def line_to(vehicle: int, station: Station) -> VehicleLine:
    """The line to a vehicle; the refusal of its number where there is none."""
    line = station.vehicles.get(vehicle)
    if line is None:
        raise no_vehicle(vehicle, station.vehicles)
    return line


def line_of(vehicle: VehicleNumber, station: TheStation) -> VehicleLine:
    """The line to the vehicle of the path."""
    return line_to(vehicle, station)


Line = Annotated[VehicleLine, Depends(line_of)]
