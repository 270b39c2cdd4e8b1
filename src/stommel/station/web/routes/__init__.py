"""The routes of the API, one file a concern; a new concern adds its router to the tuple."""

from fastapi import APIRouter

from stommel.station.web.routes import (
    alarms,
    commands,
    data,
    link,
    notes,
    people,
    plans,
    series,
    station,
    vehicles,
)

ROUTERS: tuple[APIRouter, ...] = (
    station.router,
    people.router,
    vehicles.router,
    commands.router,
    series.router,
    link.router,
    data.router,
    alarms.router,
    notes.router,
    plans.router,
)
