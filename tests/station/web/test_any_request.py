"""Any request that the OpenAPI document allows, and many that it does not: never a 5xx, always what the document says.

STOMMEL_FUZZ_EXAMPLES says how many requests of each route are tried; few in CI.
"""

import os
import re
from collections.abc import Iterator
from contextlib import ExitStack
from functools import cache
from http.client import HTTPConnection
from pathlib import Path
from typing import Any

import httpx
import pytest
import schemathesis
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis.strategies import data, sampled_from
from schemathesis.generation import GenerationMode
from schemathesis.specs.openapi.checks import (
    content_type_conformance,
    response_schema_conformance,
    status_code_conformance,
)

from stommel.station.station import Station
from stommel.station.web.app import api, api_routes, create_app
from tests.station.stations import station as silent_station
from tests.support.station_served import served

EXAMPLES = int(os.environ.get("STOMMEL_FUZZ_EXAMPLES", "6"))
ROUTES = sorted((method, route.path) for route in api_routes() for method in route.methods or ())
AS_DOCUMENTED = (status_code_conformance, content_type_conformance, response_schema_conformance)
"""Of the answer: its status, its kind and its body are those of the document."""
SLOW = {("POST", "/api/plans/preview")}
"""Starts a process for each plan that it takes."""


@pytest.fixture(scope="module")
def _served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, Station]]:
    with ExitStack() as held:
        folder: Path = tmp_path_factory.mktemp("station")
        station = held.enter_context(silent_station(folder, "tcp:127.0.0.1:9"))
        yield held.enter_context(served(create_app(station))), station


@pytest.fixture(scope="module")
def address(_served: tuple[str, Station]) -> str:
    return _served[0]


def check(answer: Any, method: str, path: str) -> None:
    """What every answer must be."""
    assert answer.status_code < 500, f"{method} {path}: {answer.status_code} {answer.text[:500]}"
    if answer.status_code >= 400:
        detail = answer.json()["detail"]
        assert set(detail) >= {"reason", "key", "value", "allowed"}, f"{method} {path}: {answer.text[:500]}"
        assert detail["reason"], f"{method} {path}: {answer.text[:500]}"
        assert len(answer.text) < 20_000
    assert b"Traceback" not in answer.content[:2000]


@cache
def _documented() -> Any:
    """The OpenAPI document of the application."""
    return schemathesis.openapi.from_dict(_without_tuples(api().openapi()))


def _without_tuples(part: Any) -> Any:
    """Tuples as lists of any of their parts: schemathesis does not read its own `items` of them in answers.

    schemathesis/schemathesis#3842, #4099.
    """
    if isinstance(part, list):
        return [_without_tuples(each) for each in part]
    if not isinstance(part, dict):
        return part
    found = {key: _without_tuples(value) for key, value in part.items()}
    return found | {"items": {"anyOf": found.pop("prefixItems")}} if "prefixItems" in found else found


@pytest.mark.parametrize(("method", "path"), sorted(set(ROUTES) - SLOW - {("GET", "/api/openapi.json")}))
def test_no_request_breaks_it(address: str, method: str, path: str) -> None:
    """schemathesis: requests as the document describes them, and as it does not; answers as it describes them."""

    @settings(
        max_examples=EXAMPLES, deadline=None, phases=[Phase.explicit, Phase.generate], derandomize=True,
        suppress_health_check=list(HealthCheck), database=None,
    )  # fmt: skip
    @given(data())
    def attempt(drawn: Any) -> None:
        operation = _documented()[path][method]
        mode = drawn.draw(sampled_from([GenerationMode.POSITIVE, GenerationMode.NEGATIVE]))
        case = drawn.draw(operation.as_strategy(generation_mode=mode))
        answer = case.call(base_url=address, timeout=60.0)
        check(answer, method, case.formatted_path)
        case.validate_response(answer, checks=AS_DOCUMENTED)

    attempt()


NASTY = [
    "0", "-1", "251", "99999999999999999999", "1.5", "1e9", "nan", "inf", "null", "true", "'; DROP TABLE users; --",
    "1 OR 1=1", "..", "../../../etc/passwd", "..%2f..%2fetc%2fpasswd", "%2e%2e%2f%2e%2e%2fetc%2fpasswd",
    "....//....//etc/passwd", "..\\..\\windows", "%00", "a%00b", "%0d%0aSet-Cookie:%20x=1", "%ff%fe", "\u202e",
    "<script>alert(1)</script>", "{{7*7}}", "${7*7}", "%25s%25n", "x" * 2000, "/etc/passwd", "C:\\x", "~root", "*", "%",
]  # fmt: skip
"""What somebody may write into any path or question."""
WITH_PLACES = [(method, path) for method, path in ROUTES if "{" in path]


@pytest.mark.parametrize(("method", "path"), WITH_PLACES)
def test_nasty_paths(address: str, method: str, path: str) -> None:
    """Injection and path traversal in every place of every path; vehicle 1 where another place is tried."""
    places = re.findall(r"\{[^}]*\}", path)
    body: dict[str, Any] = {} if method in ("GET", "DELETE") else {"json": {}}
    with httpx.Client(base_url=address, timeout=60.0) as client:
        for place in places:
            for nasty in NASTY:
                full = path.replace(place, nasty)
                for other in places:
                    full = full.replace(other, "1")
                answer = client.request(method, httpx.URL(address + full), **body)
                check(answer, method, full)
                assert "root:" not in answer.text
                assert "set-cookie" not in answer.headers


@pytest.mark.parametrize(("method", "path"), [(m, p) for m, p in ROUTES if m == "GET"])
def test_nasty_questions(address: str, method: str, path: str) -> None:
    route = next(route for route in api_routes() if route.path == path and method in (route.methods or ()))
    names = [field.alias for field in route.dependant.query_params]
    where = re.sub(r"\{[^}]*\}", "1", path)
    with httpx.Client(base_url=address, timeout=60.0) as client:
        for name in names:
            for nasty in NASTY:
                answer = client.get(httpx.URL(f"{address}{where}?{name}={nasty}"))
                check(answer, "GET", f"{where}?{name}={nasty}")
                assert "root:" not in answer.text


BODIES = [
    b"", b"{", b"null", b"[]", b"7", b'"x"', b"{}" * 1000, b"[" * 100_000, b'{"a":' * 50_000, b"\xff\xfe", b"\x00",
    '{"name": "x"}'.encode("utf-16"), b'{"name": NaN}', b'{"name": Infinity}', b'{"name": "\\ud800"}',
    b'{"name": "\\u0000"}', b'{"name": 1e999}', b'{"name": ' + b"9" * 5000 + b"}", b'{"__proto__": {"a": 1}}',
    b'{"name": "' + b"x" * 100_000 + b'"}', b'{"name": {"$gt": ""}}',
]  # fmt: skip


@pytest.mark.parametrize(("method", "path"), [(m, p) for m, p in ROUTES if m in ("POST", "PUT", "PATCH", "DELETE")])
def test_nasty_bodies(address: str, method: str, path: str) -> None:
    where = re.sub(r"\{[^}]*\}", "1", path)
    with httpx.Client(base_url=address, timeout=60.0) as client:
        for kind in ("application/json", "text/plain", "application/x-www-form-urlencoded", "multipart/form-data", "%"):
            for body in BODIES if kind == "application/json" else BODIES[:4]:
                answer = client.request(method, where, content=body, headers={"Content-Type": kind})
                check(answer, method, f"{where} {body[:40]!r}")


@pytest.mark.parametrize(("method", "path"), [(m, p) for m, p in ROUTES if m in ("POST", "PUT", "PATCH")])
def test_bodies_are_bounded(address: str, method: str, path: str) -> None:
    """At most 1 MiB, said by its length or not; a route for files and images says its own bound, below 100 MB."""
    route = next(route for route in api_routes() if route.path == path and method in (route.methods or ()))
    where = re.sub(r"\{[^}]*\}", "1", path)
    assert (route.max_body_size or 0) < 100_000_000
    assert _status_of_promise(address, method, where, (route.max_body_size or 1 << 20) + 1) == 413
    if route.max_body_size is None:
        for kind in ("application/json", "text/plain"):
            answer = httpx.request(
                method, f"{address}{where}", content=_without_length(), headers={"Content-Type": kind}, timeout=60.0
            )
            # a body that no route asks for is not read at all
            assert answer.status_code == 413 or kind == "text/plain", answer.text
            check(answer, method, where)


def _without_length() -> Iterator[bytes]:
    for _ in range(20):
        yield b" " * 100_000


def _status_of_promise(address: str, method: str, where: str, length: int) -> int:
    """Status that answers the promise of a body, which never comes."""
    place = httpx.URL(address)
    connection = HTTPConnection(place.host, place.port, timeout=60.0)
    try:
        connection.putrequest(method, where)
        connection.putheader("Content-Type", "application/octet-stream")
        connection.putheader("Content-Length", str(length))
        connection.endheaders()
        return connection.getresponse().status
    finally:
        connection.close()


WORDS = [
    '<script>alert("x")</script>',
    "<img src=x onerror=alert(1)>",
    "'; DROP TABLE notes; --",
    "\u202eabc",
    "{{7*7}}",
]


@pytest.mark.parametrize("words", WORDS)
def test_scripts_are_kept_and_given_back_as_text(address: str, words: str) -> None:
    """Cross-site scripting: JSON that no browser takes for a page, the very words, and no inline scripts."""
    with httpx.Client(base_url=address) as client:
        client.post("/api/vehicles/1/holder", json={"by_force": True, "reason": words})
        made = client.post("/api/notes", json={"vehicle": 1, "words": words})
        assert made.status_code in (200, 201), made.text
        told = client.get("/api/notes?vehicle=1")
        assert words in [row["words"] for row in told.json()]
        for answer in (told, made, client.get(f"/api/vehicles/{words}"), client.get(f"/{words}")):
            assert answer.headers["content-type"] == "application/json"
            assert answer.headers["x-content-type-options"] == "nosniff"
            assert (
                "'unsafe-inline'" not in answer.headers["content-security-policy"].split("script-src")[1].split(";")[0]
            )
