"""Chart layers: what can be drawn is kept, and nothing else. Oracle: RFC 7946, and images made by Pillow."""

import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from stommel.station.layers import layers as layers_module
from stommel.station.layers.bounds import LayerError
from stommel.station.layers.geojson import MOST_POSITIONS, checked_geojson
from stommel.station.layers.images import MOST_PIXELS, image_kind
from stommel.station.station import Station
from tests.station.client import Client
from tests.station.stations import station as running

LINE = {"type": "LineString", "coordinates": [[122.0, 30.0], [123.5, 29.0, -20.0]]}
COLLECTION = {
    "type": "FeatureCollection",
    "name": "x",
    "features": [
        {"type": "Feature", "id": 1, "geometry": LINE, "properties": {"name": "<b>wreck</b>", "more": {"deep": []}}},
        {"type": "Feature", "geometry": None, "properties": None},
    ],
}
BOUNDS = {"west": 121.0, "south": 28.0, "east": 124.0, "north": 31.0}


@pytest.fixture
def station(tmp_path: Path) -> Iterator[Station]:
    with running(tmp_path, start=False) as made:
        yield made


@pytest.fixture
def client(station: Station) -> Client:
    return Client(station)


def picture(format: str, size: tuple[int, int] = (20, 10), *, noisy: bool = False) -> bytes:
    made = io.BytesIO()
    image = Image.effect_noise((400, 400), 50.0) if noisy else Image.new("RGB", size, (10, 20, 30))
    image.save(made, format)
    return made.getvalue()


def test_geojson_is_drawn_as_its_geometry_says() -> None:
    drawn, bounds = checked_geojson(COLLECTION)
    assert bounds == (122.0, 29.0, 123.5, 30.0)
    assert drawn == {
        "type": "FeatureCollection",
        "features": [
            {
                "type": "Feature",
                "geometry": {"type": "LineString", "coordinates": [[122.0, 30.0], [123.5, 29.0]]},
                "properties": {"name": "<b>wreck</b>"},
            },
            {"type": "Feature", "geometry": None, "properties": {}},
        ],
    }
    assert checked_geojson({"type": "Point", "coordinates": [1, 2]})[1] == (1.0, 2.0, 1.0, 2.0)


def nested(levels: int) -> dict[str, Any]:
    made: dict[str, Any] = LINE
    for _ in range(levels):
        made = {"type": "GeometryCollection", "geometries": [made]}
    return made


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ({}, "geojson: has no type"),
        ({"type": "Circle", "coordinates": [1, 2]}, "type = 'Circle' is not known"),
        ({"type": ["Point"], "coordinates": [1, 2]}, "is not known"),
        ({"type": "Point", "coordinates": [30.0, 122.0]}, "longitude comes first"),
        ({"type": "Point", "coordinates": [True, 1]}, "is no position"),
        ({"type": "Point", "coordinates": ["1", "2"]}, "is no position"),
        ({"type": "Point", "coordinates": [float("nan"), 2]}, "is not on the globe"),
        ({"type": "Point", "coordinates": [10**400, 2]}, "is not on the globe"),
        ({"type": "LineString", "coordinates": [1, 2]}, r"geojson.coordinates\[0\]: is no position"),
        ({"type": "Polygon", "coordinates": {"a": 1}}, "is no list"),
        ({"type": "FeatureCollection"}, "is no list"),
        ({"type": "FeatureCollection", "features": [LINE]}, r"features\[0\]: is no Feature"),
        ({"type": "FeatureCollection", "features": []}, "nothing would be drawn"),
        ({"type": "MultiPoint", "coordinates": [[0, 0]] * (MOST_POSITIONS + 1)}, "thin it out"),
        ({"type": "GeometryCollection", "geometries": [nested(0)] * 20_001}, "features and geometries"),
    ],
)
def test_what_cannot_be_drawn_is_refused_with_its_place(content: dict[str, Any], words: str) -> None:
    with pytest.raises(LayerError, match=words):
        checked_geojson(content)


def test_collections_in_collections_have_an_end() -> None:
    checked_geojson(nested(4))
    with pytest.raises(LayerError, match="too deep"):
        checked_geojson(nested(5))


anything = st.recursive(
    st.none() | st.booleans() | st.integers(-200, 200) | st.floats() | st.sampled_from(["Point", "Feature", "Polygon"]),
    lambda parts: (
        st.lists(parts, max_size=4)
        | st.dictionaries(
            st.sampled_from(["type", "features", "geometry", "coordinates", "geometries"]), parts, max_size=4
        )
    ),
    max_leaves=20,
)


@given(anything)
def test_whatever_comes_is_drawn_or_refused(content: Any) -> None:
    try:
        drawn, bounds = checked_geojson(content)
    except LayerError:
        return
    assert checked_geojson(drawn) == (drawn, bounds)


def test_an_image_is_what_its_bytes_say() -> None:
    assert image_kind(picture("PNG")) == "image/png"
    assert image_kind(picture("JPEG")) == "image/jpeg"


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "no PNG or JPEG"),
        (b"<svg xmlns='http://www.w3.org/2000/svg'><script>alert(1)</script></svg>", "no PNG or JPEG"),
        (picture("GIF"), "no PNG or JPEG"),
        (picture("PNG", noisy=True)[:-2000], "damaged"),
        (picture("JPEG", noisy=True)[:-2000], "damaged"),
        (picture("PNG", (MOST_PIXELS // 100 + 1, 100)), "pixels; make it smaller"),
        (b"\x89PNG\r\n\x1a\n" + bytes(9 << 20), "MB; make it smaller"),
    ],
)
def test_an_image_that_cannot_be_drawn_is_refused(content: bytes, words: str) -> None:
    with pytest.raises(LayerError, match=words):
        image_kind(content)


def test_layers_are_kept_and_removed(client: Client) -> None:
    made = client.post("/layers", {"name": "Wrecks", "geojson": COLLECTION})
    assert made["bounds"] == [122.0, 29.0, 123.5, 30.0]
    png = picture("PNG")
    answer = client.request("POST", "/layers/image", params={"name": "Chart", **BOUNDS}, content=png)
    assert answer.status_code == 201, answer.text
    image = answer.json()
    assert image == {
        "id": 2, "name": "Chart", "kind": "image/png", "bounds": [121.0, 28.0, 124.0, 31.0], "content": None,
    }  # fmt: skip
    assert client.get("/layers") == [made, image]
    shown = client.request("GET", "/layers/2/image")
    assert (shown.content, shown.headers["content-type"]) == (png, "image/png")
    client.refused("GET", "/layers/1/image", 404)
    assert client.request("DELETE", "/layers/1").status_code == 204
    client.refused("DELETE", "/layers/1", 404)
    assert client.get("/layers") == [image]


@pytest.mark.parametrize(
    ("bounds", "key"),
    [({"west": 125.0}, "west"), ({"south": 40.0}, "south"), ({"north": 91.0}, "north"), ({"east": "nan"}, "east")],
)
def test_bounds_that_span_nothing_are_refused(client: Client, bounds: dict[str, Any], key: str) -> None:
    told = client.refused(
        "POST", "/layers/image", 422, params={"name": "Chart", **BOUNDS, **bounds}, content=picture("PNG")
    )
    assert told["key"] == key


def test_an_image_that_is_too_large_is_not_read(client: Client) -> None:
    answer = client.request("POST", "/layers/image", params={"name": "Chart", **BOUNDS}, content=bytes(9 << 20))
    assert answer.status_code == 413
    assert client.get("/layers") == []


def test_there_is_an_end_to_layers(client: Client, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(layers_module, "MOST_LAYERS", 1)
    body = {"name": "Wrecks", "geojson": COLLECTION}
    client.post("/layers", body)
    assert "remove one first" in client.refused("POST", "/layers", 422, json=body)["reason"]


def test_bounds_say_which_side_is_wrong(client: Client) -> None:
    told = client.refused(
        "POST", "/layers/image", 422, params={"name": "Chart", **BOUNDS, "west": 124.0}, content=picture("PNG")
    )
    assert (told["reason"], told["allowed"]) == ("west = 124: must be less than east = 124", "less than 124 deg")
