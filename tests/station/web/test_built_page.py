"""The page as it is served: compressed, kept for ever where its name holds its hash, and no path leads elsewhere."""

import gzip
import http.client
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest

from stommel.station.station import Station
from stommel.station.web import app as web_app
from stommel.station.web.app import create_app
from stommel.station.web.built_page import BuiltPage
from tests.support.station_served import served

SCRIPT = b"console.log('dive');" * 200


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    folder = tmp_path / "built"
    (folder / "assets").mkdir(parents=True)
    (folder / "index.html").write_text("<!doctype html><title>Station</title>", encoding="utf-8")
    (folder / "assets" / "index-4f2a.js").write_bytes(SCRIPT)
    (folder / "icon.svg").write_text("<svg/>", encoding="utf-8")
    (folder / ".secret").write_text("not for browsers", encoding="utf-8")
    (tmp_path / "beside.txt").write_text("not for browsers", encoding="utf-8")
    return folder


@pytest.fixture
def page(station: Station, folder: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[httpx.Client]:
    monkeypatch.setattr(web_app, "BuiltPage", lambda: BuiltPage(folder))
    with served(create_app(station)) as address, httpx.Client(base_url=address) as client:
        yield client


def test_the_page_and_what_it_loads(page: httpx.Client) -> None:
    index = page.get("/")
    assert index.headers["content-type"] == "text/html; charset=utf-8"
    assert index.headers["cache-control"] == "no-cache"
    script = page.get("/assets/index-4f2a.js")
    assert script.headers["content-type"] == "text/javascript; charset=utf-8"
    assert script.headers["cache-control"] == "public, max-age=31536000, immutable"
    assert script.headers["content-encoding"] == "gzip"
    assert script.content == SCRIPT
    assert int(script.headers["content-length"]) < len(SCRIPT) / 10
    plain = page.get("/assets/index-4f2a.js", headers={"Accept-Encoding": "identity"})
    assert "content-encoding" not in plain.headers
    assert plain.content == SCRIPT
    assert page.get("/icon.svg").headers["content-type"] == "image/svg+xml; charset=utf-8"


def test_what_has_not_changed_is_not_sent_again(page: httpx.Client) -> None:
    tag = page.get("/").headers["etag"]
    again = page.get("/", headers={"If-None-Match": tag})
    assert (again.status_code, again.content) == (304, b"")
    assert page.get("/", headers={"If-None-Match": '"another"'}).status_code == 200


def test_what_was_compressed_at_the_build_is_taken(folder: Path, page: httpx.Client) -> None:
    (folder / "assets" / "index-4f2a.js.gz").write_bytes(gzip.compress(SCRIPT + b"//built"))
    assert page.get("/assets/index-4f2a.js").content.endswith(b"//built")
    assert page.get("/assets/index-4f2a.js.gz").status_code == 404


def test_a_page_built_anew_is_served_at_once(folder: Path, page: httpx.Client) -> None:
    assert "Station" in page.get("/").text
    (folder / "index.html").write_text("<!doctype html><title>Newer</title>", encoding="utf-8")
    assert "Newer" in page.get("/").text


@pytest.mark.parametrize(
    "path",
    [
        "/../beside.txt", "/assets/../../beside.txt", "/%2e%2e/beside.txt", "/..%2fbeside.txt", "/assets/..%5c..%5cx",
        "//etc/passwd", "/etc/passwd", "/.secret", "/assets", "/assets/", "/%00", "/index.html%00.js", "/x" * 2000,
        "/..;/beside.txt", "/assets/%252e%252e/%252e%252e/beside.txt", "/C:/windows/win.ini",
    ],
    ids=lambda path: path[:40],
)  # fmt: skip
def test_no_path_leads_elsewhere(page: httpx.Client, path: str) -> None:
    connection = http.client.HTTPConnection(page.base_url.host, page.base_url.port or 0)
    connection.request("GET", path)  # as it is written, which httpx would mend
    answer = connection.getresponse()
    body = answer.read()
    connection.close()
    assert answer.status in (400, 404)
    assert b"not for browsers" not in body
    assert b"root:" not in body


def test_the_page_is_only_read(page: httpx.Client) -> None:
    for method in ("POST", "PUT", "DELETE", "PATCH"):
        assert page.request(method, "/").status_code == 405
    head = page.head("/")
    assert (head.status_code, head.content) == (200, b"")


def test_before_it_is_built_it_says_how(station: Station, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(web_app, "BuiltPage", lambda: BuiltPage(tmp_path / "nothing"))
    with served(create_app(station)) as address:
        answer = httpx.get(address)
    assert "make page" in answer.text
    assert answer.headers["cache-control"] == "no-store"


def test_no_inline_script_in_what_we_say_ourselves(station: Station) -> None:
    from stommel.station.web.built_page import NOT_BUILT

    assert "<script" not in NOT_BUILT
    assert "style=" not in NOT_BUILT
