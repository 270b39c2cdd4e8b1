"""The page on architecture has the rooms that there are, in the rows of the contract."""

import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
ROWS = re.findall(r"^\| (\d+) \| `(\w+)` \| (.+) \|$", PAGE, re.M)


def test_rooms_are_the_folders() -> None:
    package = ROOT / "src" / "stommel"
    rooms = {path.stem for path in package.iterdir() if (path / "__init__.py").exists() or path.suffix == ".py"}
    assert sorted(name for _, name, _ in ROWS) == sorted(rooms - {"__init__", "__pycache__"})


def test_rows_are_those_of_the_contract() -> None:
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["importlinter"][
        "contracts"
    ]
    (layers,) = [contract["layers"] for contract in contracts if contract.get("containers") == ["stommel"]]
    written: dict[int, set[str]] = {}
    for row, name, _ in ROWS:
        written.setdefault(int(row), set()).add(name)
    assert list(written.values()) == [set(layer.split(" | ")) for layer in layers]


def test_sentences_about_further_contracts_are_true() -> None:
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["importlinter"][
        "contracts"
    ]
    inside = {contract["containers"][0] for contract in contracts if contract["type"] == "layers"} - {"stommel"}
    rooms = re.findall(r"`(\w+)`", re.findall(r"alone; that (`[^.]*) have rows inside", PAGE, re.S)[0])
    assert {f"stommel.{room}" for room in rooms} == inside
    assert any(contract["type"] == "acyclic_siblings" for contract in contracts)
    forbidden, ashore, previews = [contract for contract in contracts if contract["type"] == "forbidden"]
    assert ashore["source_modules"] == previews["source_modules"] == ["stommel.station"]
    blind = re.findall(r"`(\w+)`", re.findall(r"say that (.*?) reach no model", PAGE, re.S)[0])
    assert forbidden["source_modules"] == [f"stommel.{room}" for room in blind]
