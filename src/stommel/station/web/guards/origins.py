"""Who may ask at all: hosts by which the station is known, pages that it served itself."""

from urllib.parse import urlsplit

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Receive, Scope, Send

from stommel.station.web.exposure import LOOPBACK_NAMES, Exposure
from stommel.station.web.guards.answers import refuse

HARMLESS = frozenset({"GET", "HEAD", "OPTIONS"})
_PORTS = {"http": 80, "https": 443, "ws": 80, "wss": 443}


class Origins:
    """Refuses other hosts (a name that was made to point here), other sites' pages, and plain HTTP past the proxy."""

    def __init__(self, app: ASGIApp, exposure: Exposure) -> None:
        self._app, self._exposure = app, exposure

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on what may ask."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        objection = self._objection(scope, Headers(scope=scope))
        if objection is None:
            await self._app(scope, receive, send)
        else:
            await refuse(scope, receive, send, *objection)

    def _objection(self, scope: Scope, headers: Headers) -> tuple[int, str] | None:
        hosts = headers.getlist("host")
        host = _split(f"//{hosts[0]}", scope["scheme"]) if len(hosts) == 1 else None
        if host is None or not self._known(host[0]):
            names = ", ".join(self._names()) or "one name"
            return 421, f"the station is not known by this name; it answers to {names}"
        if self._exposure.behind_proxy and scope["scheme"] not in ("https", "wss"):
            return 403, "the proxy must serve the page over TLS and say so: X-Forwarded-Proto: https"
        if "\x00" in scope["path"]:
            return 400, "no address has a zero character"
        if scope["type"] == "http" and scope["method"] in HARMLESS:
            return None
        return _foreign(scope, headers, host)

    def _names(self) -> tuple[str, ...]:
        """Names by which it may be asked; empty allows any."""
        if not self._exposure.login_required:
            return (*LOOPBACK_NAMES, *self._exposure.names)
        return (*LOOPBACK_NAMES, *self._exposure.names) if self._exposure.names else ()

    def _known(self, name: str) -> bool:
        names = self._names()
        return not names or name in names


def _foreign(scope: Scope, headers: Headers, host: tuple[str, int | None]) -> tuple[int, str] | None:
    """Refuse what another site's page sends; a script sends no origin and has no cookie that somebody lent it."""
    origin, site = headers.get("origin"), headers.get("sec-fetch-site")
    words = "this came from the page of another site; open the station's own page"
    if origin is not None:
        scheme = "https" if scope["scheme"] in ("https", "wss") else "http"
        here = (host[0], host[1] or _PORTS[scheme])
        if not origin.startswith(f"{scheme}://") or _split(origin, scheme) != here:
            return 403, words
    elif site is not None and site not in ("same-origin", "none"):
        return 403, words
    return None


def _split(address: str, scheme: str) -> tuple[str, int | None] | None:
    """Host and port of an address; None if it is none."""
    try:
        parts = urlsplit(address)
        name, port = parts.hostname, parts.port
    except ValueError:
        return None
    if not name or parts.path or parts.query or parts.username is not None:
        return None
    return name.rstrip("."), port or _PORTS.get(scheme)
