"""The web application: the API, the live socket and the page."""

from typing import Any

from fastapi import FastAPI

from stommel import __version__
from stommel.station.web import live
from stommel.station.web.exposure import Exposure
from stommel.station.web.routes import ROUTERS

LARGEST_BODY = 1 << 20
"""Bytes of a request; a route for files says its own `max_body_size`."""


def create_app(station: Any, exposure: Exposure | None = None) -> FastAPI:
    """Make the application that serves a station.

    Parameters
    ----------
    station
        The station, started by the caller.
    exposure
        Where it listens; this machine only if left out.
    """
    app = FastAPI(
        title="stommel shore station",
        version=__version__,
        openapi_url=None,
        docs_url=None,
        redoc_url=None,
        redirect_slashes=False,
        max_body_size=LARGEST_BODY,
    )
    app.state.station = station
    app.state.exposure = exposure or Exposure()
    for router in ROUTERS:
        app.include_router(router)
    app.include_router(live.router)
    return app
