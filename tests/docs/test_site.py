"""The documentation builds without a warning, and its pages need no network."""

import ast
import os
import posixpath
import re
import subprocess
import sys
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path

import pytest

pytest.importorskip("sphinx", reason="the documentation's extra is not installed")
pytest.importorskip("furo", reason="the documentation's extra is not installed")
pytest.importorskip("myst_parser", reason="the documentation's extra is not installed")
pytest.importorskip("latex2mathml", reason="the documentation's extra is not installed")

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-b", "html"]
    command += ["-d", str(folder / "doctrees"), str(DOCS), str(folder / "html")]
    # an own process: the pages describe compiled functions before they are compiled (docs/conf.py)
    environment = {**os.environ, "PYTHONWARNINGS": "default"}
    done = subprocess.run(command, capture_output=True, text=True, env=environment, timeout=900, check=False)
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


def public_modules() -> Iterator[tuple[str, Path]]:
    """Every file of the package, by the name that imports it."""
    for source in sorted((ROOT / "src").rglob("*.py")):
        parts = source.relative_to(ROOT / "src").with_suffix("").parts
        parts = parts[:-1] if parts[-1] == "__init__" else parts
        if not any(part.startswith("_") for part in parts):
            yield ".".join(parts), source


@pytest.fixture(scope="module")
def described(site: Path) -> dict[str, set[str]]:
    """What the site describes, by kind: `py:module`, `py:function` and so on."""
    from sphinx.util.inventory import InventoryFile

    with (site / "objects.inv").open("rb") as inventory:
        return {kind: set(names) for kind, names in InventoryFile.load(inventory, "", posixpath.join).items()}


def test_reference_has_every_public_module(described: dict[str, set[str]]) -> None:
    modules = {name for name, _ in public_modules()}
    assert len(modules) > 200
    assert described["py:module"] == modules


def test_reference_has_every_documented_function_and_class(described: dict[str, set[str]]) -> None:
    missing = []
    for module, source in public_modules():
        for node in ast.parse(source.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.FunctionDef | ast.ClassDef) and ast.get_docstring(node) and node.name[0] != "_":
                kinds = ("py:function",) if isinstance(node, ast.FunctionDef) else ("py:class", "py:exception")
                if not any(f"{module}.{node.name}" in described.get(kind, ()) for kind in kinds):
                    missing.append(f"{module}.{node.name}")
    assert not missing


def test_front_door_stands_with_its_signatures(site: Path, described: dict[str, set[str]]) -> None:
    import stommel

    names = set().union(*(described[f"py:{kind}"] for kind in ("function", "class", "exception", "data")))
    assert {f"stommel.{name}" for name in stommel.__all__} <= names
    page = (site / "reference.html").read_text(encoding="utf-8")
    headings = dict(re.findall(r'<dt class="sig[^>]*id="(stommel\.\w+)">(.*?)</dt>', page, re.S))
    trim = re.sub(r"\s+", " ", re.sub("<[^>]+>", "", headings["stommel.trim"]))
    for part in ("vehicle: Vehicle,", "speed_m_s: float,", "physics: Physics = PAPER,", "SteadyFlight"):
        assert part in trim
