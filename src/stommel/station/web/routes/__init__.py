"""The routes of the API, one file a concern; a helper of a concern adds its router to the tuple."""

from fastapi import APIRouter

from stommel.station.web.routes import station, vehicles

ROUTERS: tuple[APIRouter, ...] = (station.router, vehicles.router)
