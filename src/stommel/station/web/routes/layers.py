"""Chart layers: GeoJSON, or an image with the bounds that it covers."""

from typing import Annotated, Any

from fastapi import APIRouter, Path, Query, Request
from fastapi.responses import Response
from pydantic import BaseModel, ConfigDict, Field
from starlette.concurrency import run_in_threadpool

from stommel.files.sentences import PRINTABLE
from stommel.station.layers.bounds import Bounds, LayerError
from stommel.station.layers.images import LARGEST_IMAGE
from stommel.station.layers.layers import Layer, Layers
from stommel.station.web.access import Admin, Viewer
from stommel.station.web.errors import refusal
from stommel.station.web.found import TheStation

router = APIRouter(prefix="/api", tags=["chart layers"])

LARGEST_GEOJSON = 4 << 20
"""Bytes; as many positions as a layer may have fit into it."""
GREATEST_NUMBER = (1 << 53) - 1
"""Of a row; beyond it JSON's numbers are not exact."""
LayerNumber = Annotated[int, Path(ge=1, le=GREATEST_NUMBER)]


class LayerRow(BaseModel):
    """A layer of the chart; an image is at `/layers/{id}/image`."""

    id: int
    name: str
    kind: str
    """`geojson`, or the media type of an image."""
    bounds: tuple[float, float, float, float]
    """West, south, east, north [deg]."""
    content: dict[str, Any] | None
    """GeoJSON; null of an image."""


class NewLayer(BaseModel):
    """GeoJSON that shall be drawn: RFC 7946, longitude first."""

    model_config = ConfigDict(extra="forbid")

    name: Annotated[str, Field(min_length=1, max_length=80, pattern=PRINTABLE)]
    geojson: dict[str, Any]


@router.get("/layers")
def read_layers(_user: Viewer, station: TheStation) -> list[LayerRow]:
    """All chart layers, in the order in which they came."""
    return [_row(layer) for layer in Layers(station.archive).listed()]


@router.post("/layers", status_code=201, max_body_size=LARGEST_GEOJSON)
def add_layer(_user: Admin, body: NewLayer, station: TheStation) -> LayerRow:
    """Add a layer of GeoJSON; its geometry is kept, and texts and numbers of its features."""
    try:
        return _row(Layers(station.archive).add_geojson(body.name, body.geojson))
    except LayerError as error:
        raise _refusal(error) from None


_IMAGE = {"schema": {"type": "string", "format": "binary"}}


@router.post(
    "/layers/image",
    status_code=201,
    max_body_size=LARGEST_IMAGE,
    openapi_extra={"requestBody": {"required": True, "content": {"image/png": _IMAGE, "image/jpeg": _IMAGE}}},
)
async def add_image_layer(
    _user: Admin,
    request: Request,
    station: TheStation,
    name: Annotated[str, Query(min_length=1, max_length=80, pattern=PRINTABLE)],
    west: Annotated[float, Query(ge=-180, le=180)],
    south: Annotated[float, Query(ge=-90, le=90)],
    east: Annotated[float, Query(ge=-180, le=180)],
    north: Annotated[float, Query(ge=-90, le=90)],
) -> LayerRow:
    """Add an image (PNG or JPEG, the body of the request) that covers a rectangle, as in plate carrée."""
    content = await request.body()
    add = Layers(station.archive).add_image
    try:
        return _row(await run_in_threadpool(add, name, Bounds(west, south, east, north), content))
    except LayerError as error:
        raise _refusal(error) from None


@router.get("/layers/{layer}/image", response_class=Response, responses={200: {"content": {"image/png": _IMAGE}}})
def read_image(_user: Viewer, layer: LayerNumber, station: TheStation) -> Response:
    """The image of a layer."""
    found = Layers(station.archive).image(layer)
    if found is None:
        raise refusal(404, f"there is no image {layer}", key="layer", value=layer)
    return Response(found[1], media_type=found[0], headers={"Cache-Control": "private, max-age=31536000, immutable"})


@router.delete("/layers/{layer}", status_code=204)
def delete_layer(_user: Admin, layer: LayerNumber, station: TheStation) -> None:
    """Remove a layer."""
    if not Layers(station.archive).remove(layer):
        raise refusal(404, f"there is no layer {layer}", key="layer", value=layer)


def _row(layer: Layer) -> LayerRow:
    return LayerRow(
        id=layer.id, name=layer.name, kind=layer.kind, bounds=layer.bounds, content=layer.content
    )  # fmt: skip


def _refusal(error: LayerError) -> Exception:
    return refusal(422, str(error), key=error.key, allowed=error.allowed)
