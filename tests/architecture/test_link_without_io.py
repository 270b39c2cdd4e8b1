"""The link does no input and output but at its edges: no clock, no thread, no port, no file, no chance of its own."""

import ast
from collections.abc import Iterator

import pytest

from tests.architecture.test_one_reader import imported, trees

EDGES = {
    "link/files/folder_disk.py": "a folder as the disk of received files",
    "link/signing/key_file.py": "the file of a key",
}
"""With link/transports, whose ports are its purpose."""
OUTSIDE = {
    "asyncio", "fcntl", "io", "logging", "os", "pathlib", "pty", "secrets", "select", "selectors", "serial", "shutil",
    "signal", "socket", "ssl", "subprocess", "sys", "tempfile", "termios", "threading", "time", "tty",
}  # fmt: skip
"""Modules by which a program reaches its computer."""
CLOCKS = {"datetime.now", "datetime.utcnow", "datetime.today", "date.today"}
CALLS = {"input", "open", "print"}
CHANCE = {"random.Random"}
"""What may be named of `random`: a stream that is handed in."""
READERS = {"stommel.files.opening", "stommel.files.whole", "stommel.files.folder_lock"}


def reaches(tree: ast.Module) -> Iterator[str]:
    """What of the computer a module names."""
    for module in sorted(imported(tree)):
        if module.split(".")[0] in OUTSIDE or module in READERS:
            yield module
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in CALLS:
            yield node.func.id
        if isinstance(node, ast.Attribute) and ast.unparse(node.value) == "random":
            name = ast.unparse(node)
            if name not in CHANCE:
                yield name
        if isinstance(node, ast.Attribute) and ast.unparse(node) in CLOCKS:
            yield ast.unparse(node)


def test_only_the_edges_of_the_link_reach_the_computer() -> None:
    found = {name: sorted(set(reaches(tree))) for name, tree in trees() if name.startswith("link/")}
    assert len(found) > 80
    inner = {name: what for name, what in found.items() if what and not name.startswith("link/transports/")}
    assert set(inner) == set(EDGES), inner
    assert any(found[name] for name in found if name.startswith("link/transports/"))


@pytest.mark.parametrize(
    "text",
    [
        "import time", "from os import urandom", "def f():\n    import socket", "open('x')", "import os.path",
        "import random\nrandom.random()", "from datetime import datetime\ndatetime.now()",
        "from stommel.files.opening import read_text",
    ],
)  # fmt: skip
def test_what_reaches_the_computer_is_found(text: str) -> None:
    assert list(reaches(ast.parse(text)))


def test_a_stream_of_chance_that_is_handed_in_is_none() -> None:
    assert not list(reaches(ast.parse("import random\ndef f(draw: random.Random) -> float:\n    return draw.random()")))
