"""What a path names: the vehicle, or that there is none."""

from typing import Annotated, Any

from fastapi import Depends, Request

from stommel.station.station import Station
from stommel.station.vehicles.line import VehicleLine
from stommel.station.web.access import VehicleNumber
from stommel.station.web.errors import refusal


def the_station(request: Request) -> Station:
    """The station that is served."""
    station: Any = request.app.state.station
    found: Station = station
    return found


TheStation = Annotated[Station, Depends(the_station)]


def line_of(vehicle: VehicleNumber, station: TheStation) -> VehicleLine:
    """The line to the vehicle of the path."""
    line = station.vehicles.get(vehicle)
    if line is None:
        known = ", ".join(map(str, station.vehicles)) or "none"
        raise refusal(
            404, f"there is no vehicle {vehicle} at this station", key="vehicle", value=vehicle, allowed=known
        )  # fmt: skip
    return line


Line = Annotated[VehicleLine, Depends(line_of)]
