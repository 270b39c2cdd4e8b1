"""The routes of the API, one file a concern; a new concern adds its router to the tuple."""

from fastapi import APIRouter

from stommel.station.web.routes import (
    alarms,
    commands,
    comparison,
    data,
    files,
    layers,
    link,
    missions,
    notes,
    parameters,
    people,
    plans,
    replays,
    series,
    station,
    telemetry,
    vehicles,
)

ROUTERS: tuple[APIRouter, ...] = (
    station.router,
    people.router,
    vehicles.router,
    commands.router,
    series.router,
    telemetry.router,
    link.router,
    parameters.router,
    missions.router,
    files.router,
    data.router,
    alarms.router,
    notes.router,
    layers.router,
    replays.router,
    plans.router,
    comparison.router,
)
