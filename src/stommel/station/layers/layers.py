"""Chart layers in the archive."""

import json
from typing import Any, NamedTuple

from sqlalchemy import case, delete, func, insert, select

from stommel.archive import Archive
from stommel.archive.schema import layers as table
from stommel.station.layers.bounds import Bounds, LayerError, require_area
from stommel.station.layers.geojson import checked_geojson
from stommel.station.layers.images import image_kind

MOST_LAYERS = 50
MOST_BYTES = 64 << 20
"""Of all layers together."""
GEOJSON = "geojson"


class Layer(NamedTuple):
    """A layer as the API tells it; an image is fetched by itself."""

    id: int
    name: str
    kind: str
    """`geojson`, or the media type of an image."""
    bounds: Bounds
    content: dict[str, Any] | None
    """GeoJSON; None of an image."""


class Layers:
    """The table of layers."""

    def __init__(self, archive: Archive) -> None:
        self._archive = archive

    def listed(self) -> list[Layer]:
        """All, in the order in which they came."""
        drawn = case((table.c.kind == GEOJSON, table.c.content), else_=None).label("drawn")  # images stay there
        known = select(table.c.id, table.c.name, table.c.kind, table.c.bounds, drawn).order_by(table.c.id)
        with self._archive.reading() as connection:
            return [_layer(*row) for row in connection.execute(known)]

    def image(self, number: int) -> tuple[str, bytes] | None:
        """Media type and content of an image; None if there is none of that number."""
        query = select(table.c.kind, table.c.content).where(table.c.id == number, table.c.kind != GEOJSON)
        with self._archive.reading() as connection:
            row = connection.execute(query).one_or_none()
        return None if row is None else (row.kind, bytes(row.content))

    def add_geojson(self, name: str, content: Any) -> Layer:
        """Keep what is drawn of GeoJSON.

        Raises
        ------
        LayerError
            It cannot be drawn, or there is no room.
        ArchiveError
            The archive does not take it.
        """
        drawn, bounds = checked_geojson(content)
        number = self._add(name, GEOJSON, bounds, json.dumps(drawn, allow_nan=False).encode())
        return Layer(number, name, GEOJSON, bounds, drawn)

    def add_image(self, name: str, bounds: Bounds, content: bytes) -> Layer:
        """Keep an image that covers a rectangle.

        Raises
        ------
        LayerError
            It cannot be drawn, or there is no room.
        ArchiveError
            The archive does not take it.
        """
        require_area(bounds)
        kind = image_kind(content)
        return Layer(self._add(name, kind, bounds, content), name, kind, bounds, None)

    def remove(self, number: int) -> bool:
        """Remove a layer; whether there was one.

        Raises
        ------
        ArchiveError
            The archive does not take it.
        """
        with self._archive.writing() as connection:
            return bool(connection.execute(delete(table).where(table.c.id == number)).rowcount)

    def _add(self, name: str, kind: str, bounds: Bounds, content: bytes) -> int:
        with self._archive.writing() as connection:
            count, size = connection.execute(
                select(func.count(), func.coalesce(func.sum(func.length(table.c.content)), 0))
            ).one()  # fmt: skip
            if count >= MOST_LAYERS or size + len(content) > MOST_BYTES:
                words = f"there is no room for another layer ({count} layers, {size / 1e6:.0f} MB); remove one first"
                raise LayerError(words, "name", f"{MOST_LAYERS} layers, {MOST_BYTES >> 20} MB together")
            row = insert(table).values(name=name, kind=kind, bounds=list(bounds), content=content)
            return int(connection.execute(row.returning(table.c.id)).scalar_one())


def _layer(number: int, name: str, kind: str, bounds: list[float], drawn: bytes | None) -> Layer:
    return Layer(number, name, kind, Bounds(*bounds), None if drawn is None else json.loads(bytes(drawn)))
