"""Every page is reached from the front, and every example is linked."""

import re
from fnmatch import fnmatch
from pathlib import Path

DOCS = Path(__file__).parents[2] / "docs"
INDEX = (DOCS / "index.md").read_text(encoding="utf-8")


def pages() -> set[str]:
    found = {path.relative_to(DOCS).with_suffix("").as_posix() for path in DOCS.rglob("*.md")}
    return {page for page in found if not page.startswith("_")}


def listed_on(page: str) -> list[str]:
    """Pages in the tables of contents of a page, and in those of the pages there."""
    text, folder = (DOCS / f"{page}.md").read_text(encoding="utf-8"), Path(page).parent
    entries = [line for block in re.findall(r"```\{toctree\}\n(.*?)```", text, re.S) for line in block.splitlines()]
    patterns = [(folder / line).as_posix() for line in entries if line and line[0] != ":"]
    found = [name for pattern in patterns for name in sorted(pages()) if fnmatch(name, pattern)]
    return found + [name for inner in found for name in listed_on(inner)]


def test_every_page_is_listed_once() -> None:
    assert sorted(listed_on("index")) == sorted(pages() - {"index"})


def test_every_guide_page_is_on_the_map() -> None:
    text = INDEX.split("```{toctree}")[0]
    linked = set(re.findall(r"\{doc\}`(?:[^`<]*<)?([\w/.-]+)>?`", text))
    wanted = {page for page in pages() if page.startswith("guide/")}
    wanted |= {"architecture", "checked", "decisions/index", "examples", "reference", "validation"}
    assert wanted - linked == set()


def test_every_example_is_shown() -> None:
    page = (DOCS / "examples.md").read_text(encoding="utf-8")
    assert set(re.findall(r"\.\./examples/(\w+\.py)", page)) == {
        path.name for path in (DOCS.parent / "examples").glob("*.py")
    }


def test_decisions_are_numbered_in_their_order() -> None:
    files = sorted((DOCS / "decisions").glob("0*.md"))
    assert [path.name[:4] for path in files] == [f"{number:04d}" for number in range(1, len(files) + 1)]
    for path in files:
        assert path.read_text(encoding="utf-8").startswith(f"# {path.name[:4]} ")
