"""The documentation builds without a warning, and its pages need no network."""

import os
import re
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path

import pytest

pytest.importorskip("sphinx", reason="the documentation's extra is not installed")
pytest.importorskip("furo", reason="the documentation's extra is not installed")
pytest.importorskip("myst_parser", reason="the documentation's extra is not installed")
pytest.importorskip("latex2mathml", reason="the documentation's extra is not installed")

DOCS = Path(__file__).parents[2] / "docs"


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-b", "html"]
    command += ["-d", str(folder / "doctrees"), str(DOCS), str(folder / "html")]
    # an own process: the pages describe compiled functions before they are compiled (docs/conf.py)
    environment = {**os.environ, "PYTHONWARNINGS": "default"}
    done = subprocess.run(command, capture_output=True, text=True, env=environment, timeout=300, check=False)
    assert done.returncode == 0, done.stderr
    return folder / "html"


class Resources(HTMLParser):
    """Collects what a browser loads by itself; a link that a reader may click is none."""

    LOADED = (("script", "src"), ("img", "src"), ("iframe", "src"), ("source", "src"), ("object", "data"))

    def __init__(self) -> None:
        super().__init__()
        self.addresses: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        attributes = dict(attrs)
        self.addresses += [
            attributes[name] or "" for element, name in self.LOADED if element == tag and name in attributes
        ]
        if tag == "link" and attributes.get("rel") not in ("next", "prev", "search", "index", "canonical", "genindex"):
            self.addresses.append(attributes.get("href") or "")
        if attributes.get("style"):
            self.addresses += addresses_in_style(attributes["style"] or "")


def addresses_in_style(text: str) -> list[str]:
    return re.findall(r"url\(\s*['\"]?([^'\")]+)", text) + re.findall(r"@import\s+['\"]([^'\"]+)", text)


def is_remote(address: str) -> bool:
    return address.startswith(("http:", "https:", "//"))


def test_pages_load_nothing_from_the_network(site: Path) -> None:
    remote = {}
    for page in sorted(site.rglob("*.html")):
        text = page.read_text(encoding="utf-8")
        resources = Resources()
        resources.feed(text)
        styles = [
            address
            for style in re.findall(r"<style[^>]*>(.*?)</style>", text, re.S)
            for address in addresses_in_style(style)
        ]
        found = [address for address in resources.addresses + styles if is_remote(address)]
        if found:
            remote[page.name] = found
    assert not remote


def test_styles_load_nothing_from_the_network(site: Path) -> None:
    sheets = sorted(site.rglob("*.css"))
    assert sheets
    remote = [a for sheet in sheets for a in addresses_in_style(sheet.read_text(encoding="utf-8")) if is_remote(a)]
    assert not remote


def test_equations_of_the_paper_carry_its_numbers(site: Path) -> None:
    pages = "".join(page.read_text(encoding="utf-8") for page in (site / "theory").glob("*.html"))
    for number in range(1, 8):
        assert len(re.findall(rf'<div class="math" id="equation-eq-{number}">', pages)) == 1
        assert f'<span class="eqno">({number})' in pages


def test_equations_are_mathml_that_a_browser_renders_itself(site: Path) -> None:
    for page in (site / "theory").glob("*.html"):
        text = page.read_text(encoding="utf-8")
        assert len(re.findall('<div class="math"', text)) == len(re.findall('<div class="math"[^>]*>\\s*<math ', text))


def test_every_key_of_a_vehicle_file_has_a_row(site: Path) -> None:
    from stommel.vehicle import builtin_names, load_vehicle, stated_numbers

    page = (site / "guide" / "vehicle-file.html").read_text(encoding="utf-8")
    keys = {key.split(".")[-1] for name in builtin_names() for key, _, _ in stated_numbers(load_vehicle(name))}
    missing = {key for key in keys if f'<span class="pre">{key}</span>' not in page}
    assert not missing
