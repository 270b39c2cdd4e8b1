"""The web application: the API, the live socket and the page."""

from typing import Any

from fastapi import Depends, FastAPI, Request
from fastapi.routing import APIRoute
from starlette.middleware.gzip import GZipMiddleware
from starlette.responses import JSONResponse, Response
from starlette.routing import Match, Route
from starlette.types import Scope

from stommel import __version__
from stommel.station.web import live
from stommel.station.web.access import PUBLIC, gate, least_role
from stommel.station.web.built_page import BuiltPage
from stommel.station.web.description import described
from stommel.station.web.errors import add_handlers, detail_of
from stommel.station.web.exposure import Exposure
from stommel.station.web.guards.bodies import SoundBodies
from stommel.station.web.guards.headers import StrictHeaders
from stommel.station.web.guards.origins import Origins
from stommel.station.web.guards.trail import Trail
from stommel.station.web.routes import ROUTERS


def create_app(station: Any, exposure: Exposure | None = None) -> FastAPI:
    """Make the application that serves a station.

    Parameters
    ----------
    station
        The station, started and stopped by the caller.
    exposure
        Where it listens; this machine only if left out.

    Raises
    ------
    ValueError
        A route names no role that may use it.
    """
    known = exposure or Exposure()
    app = api()
    app.state.station = station
    app.state.exposure = known
    app.include_router(live.router)
    app.router.routes.append(Route("/{path:path}", _rest(BuiltPage()), methods=None, include_in_schema=False))
    add_handlers(app)
    app.add_middleware(Trail, audit=station.people.audit)
    app.add_middleware(SoundBodies, largest=_largest_body)
    app.add_middleware(GZipMiddleware, minimum_size=1000, compresslevel=4)
    app.add_middleware(Origins, exposure=known)
    app.add_middleware(StrictHeaders)
    return app


class _Api(FastAPI):
    def openapi(self) -> dict[str, Any]:
        """The document of the API, made once."""
        if not self.openapi_schema:
            self.openapi_schema = described(super().openapi())
        return self.openapi_schema


def api() -> FastAPI:
    """The routes of the API without a station behind them, each with a role; enough for its document."""
    app = _Api(
        title="stommel shore station",
        version=__version__,
        summary="Vehicles at sea: what they are, what they say, what they are told.",
        openapi_url=None,
        docs_url=None,
        redoc_url=None,
        redirect_slashes=False,
    )
    for route in api_routes():
        _require_role(route)
    for router in ROUTERS:
        app.include_router(router, dependencies=[Depends(gate)])
    return app


def _largest_body(scope: Scope) -> int:
    """Bytes that the route of a request takes, where it says so itself."""
    return max((route.max_body_size or 0 for route in api_routes() if route.matches(scope)[0] is Match.FULL), default=0)


def api_routes() -> list[APIRoute]:
    """Every route of the API."""
    return [route for router in ROUTERS for route in router.routes if isinstance(route, APIRoute)]


def _require_role(route: APIRoute) -> None:
    """Refuse a route that somebody forgot to close."""
    asked = {(method, route.path) for method in route.methods or ()}
    if least_role(route) == "public" and not asked <= PUBLIC:
        raise ValueError(f"{sorted(asked)} names no role that may use it; see web/access.py")


def _rest(page: BuiltPage) -> Any:
    """What answers where no route does: the page, or a sentence."""

    async def rest(request: Request) -> Response:
        path = request.url.path
        if path == "/api" or path.startswith("/api/"):
            return _no_route(request)
        if request.method not in ("GET", "HEAD"):
            return JSONResponse(detail_of("the page is only read"), 405, {"Allow": "GET, HEAD"})
        return page.answer(request, path) or JSONResponse(detail_of("there is nothing at this address"), 404)

    return rest


def _no_route(request: Request) -> Response:
    """Tell an address that is not there from one that does something else."""
    here = [route for route in api_routes() if route.matches(request.scope)[0] is Match.PARTIAL]
    allowed = {method for route in here for method in route.methods or ()}
    if allowed:
        words = f"this address takes {', '.join(sorted(allowed))}, not {request.method}"
        return JSONResponse(detail_of(words), 405, {"Allow": ", ".join(sorted(allowed))})
    return JSONResponse(detail_of("there is nothing at this address of the API"), 404)
