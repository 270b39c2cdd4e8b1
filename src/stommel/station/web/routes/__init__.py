"""The routes of the API, one file a concern; a helper of a concern adds its router to the tuple."""

from fastapi import APIRouter

from stommel.station.web.routes import people, station

ROUTERS: tuple[APIRouter, ...] = (
    station.router,
    people.router,
)
