"""The document of the API: every refusal with its body, and the messages of the live socket, which OpenAPI leaves out.

What may refuse stands mostly before the routes or in what they share, so it follows from what a route takes.
"""

from collections.abc import Iterator
from typing import Any

from pydantic.json_schema import models_json_schema

from stommel.station.web.live_messages import LiveMessage, LiveRequest
from stommel.station.web.refused import Refused

_SCHEMAS = "#/components/schemas/{model}"
_OF_FASTAPI = ("HTTPValidationError", "ValidationError")
REFUSALS = {
    400: "The request cannot be understood.",
    401: "Nobody is logged in, or name, password or token are wrong.",
    403: "The role is too small, or the page of another site asked.",
    404: "What is named is not there.",
    409: "It cannot be done as things are: somebody else holds command, or the vehicle is in another state.",
    413: "The body is too large.",
    421: "The station is not known by this name.",
    422: "A value is missing or not allowed.",
    429: "Too many tries, or too many jobs.",
    500: "A defect of the station.",
    503: "The station cannot for the moment: the archive or the line is busy. Retry-After says when to ask again.",
}
"""What every status means."""
_ANYWHERE = (400, 401, 403, 421, 500, 503)
_OF_CHANGES = (409, 413, 422)
_OF_PARAMETERS = (404, 422)
_TOO_MANY = frozenset({
    ("post", "/api/session"), ("put", "/api/session/password"), ("post", "/api/plans/preview"),
})  # fmt: skip
_NAMED_IN_BODY = frozenset({
    ("post", "/api/notes"), ("post", "/api/replays"), ("post", "/api/tokens"), ("post", "/api/plans/validate"),
    ("post", "/api/plans/preview"),
})  # fmt: skip
"""What names a vehicle or a person that may not be there in its body."""
_ASK_THE_VEHICLE = frozenset({("get", "/api/vehicles/{vehicle}/listing")})


def described(document: dict[str, Any]) -> dict[str, Any]:
    """The document that FastAPI makes, with what it does not know."""
    components = document.setdefault("components", {})
    schemas = components.setdefault("schemas", {})
    for name in _OF_FASTAPI:
        schemas.pop(name, None)
    _, ours = models_json_schema(
        [(Refused, "validation"), (LiveMessage, "serialization"), (LiveRequest, "validation")],
        ref_template=_SCHEMAS,
    )  # fmt: skip
    for name, schema in ours["$defs"].items():
        schemas.setdefault(name, schema)
    components["responses"] = {str(status): _answer(words) for status, words in REFUSALS.items()}
    for path, operations in document["paths"].items():
        for method, operation in operations.items():
            for status in _statuses(method, path, operation):
                operation["responses"][str(status)] = {"$ref": f"#/components/responses/{status}"}
    return document


def _answer(words: str) -> dict[str, Any]:
    return {"description": words, "content": {"application/json": {"schema": {"$ref": "#/components/schemas/Refused"}}}}


def _statuses(method: str, path: str, operation: dict[str, Any]) -> Iterator[int]:
    """Statuses with which a route may refuse."""
    yield from _ANYWHERE
    if method != "get":
        yield from _OF_CHANGES
    if operation.get("parameters"):
        yield from _OF_PARAMETERS
    if (method, path) in _NAMED_IN_BODY:
        yield 404
    if (method, path) in _TOO_MANY:
        yield 429
    if (method, path) in _ASK_THE_VEHICLE:
        yield 409
