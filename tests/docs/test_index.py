"""Every page is reached from the front, and every example is linked."""

import re
from fnmatch import fnmatch
from pathlib import Path

DOCS = Path(__file__).parents[2] / "docs"
INDEX = (DOCS / "index.md").read_text(encoding="utf-8")
LISTED = [
    line for block in re.findall(r"```\{toctree\}\n(.*?)```", INDEX, re.S) for line in block.split() if line[0] != ":"
]


def pages() -> set[str]:
    found = {path.relative_to(DOCS).with_suffix("").as_posix() for path in DOCS.rglob("*.md")}
    return {page for page in found if not page.startswith("_")} - {"index"}


def test_every_page_is_listed_once() -> None:
    times = {page: sum(fnmatch(page, pattern) for pattern in LISTED) for page in pages()}
    assert {page for page, n in times.items() if n != 1} == set()


def test_every_guide_page_is_on_the_map() -> None:
    text = INDEX.split("```{toctree}")[0]
    linked = set(re.findall(r"\{doc\}`(?:[^`<]*<)?([\w/.-]+)>?`", text))
    wanted = {page for page in pages() if page.startswith("guide/")}
    wanted |= {"architecture", "checked", "examples", "reference", "validation"}
    assert wanted - linked == set()


def test_every_example_is_shown() -> None:
    page = (DOCS / "examples.md").read_text(encoding="utf-8")
    assert set(re.findall(r"\.\./examples/(\w+\.py)", page)) == {
        path.name for path in (DOCS.parent / "examples").glob("*.py")
    }
