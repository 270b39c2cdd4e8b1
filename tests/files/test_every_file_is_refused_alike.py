"""Every kind of file, with everything that can be wrong with a file: one sentence, the same from each.

Oracle: the sentences as `conftest.py` states them, and POSIX's words for what the system refuses.
"""

import codecs
import os
import socket
import time
from pathlib import Path

import pytest

from stommel.errors import FileError, StommelError
from stommel.ocean import Ocean
from tests.files.conftest import LARGE, LOADERS, NOT_USABLE, TABLES, TOML_KINDS, UNREADABLE, Refused, in_time
from tests.support.command import Command


@pytest.fixture(autouse=True)
def _in_an_empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def refusal(kind: str, path: str) -> str:
    """What is said after the name of the file."""
    with in_time(20), pytest.raises(FileError) as caught:
        LOADERS[kind](path)
    (problem,) = caught.value.problems
    assert problem.file == (path or ".")
    text = str(caught.value)
    assert "\n" not in text
    assert len(text) < 600
    return problem.message


@pytest.mark.parametrize("defect", UNREADABLE)
@pytest.mark.parametrize("kind", LOADERS)
def test_what_cannot_be_read(kind: str, defect: str, tmp_path: Path) -> None:
    case = UNREADABLE[defect]
    assert refusal(kind, case.make(tmp_path)) == f"cannot be read: {case.sentence}"


@pytest.mark.parametrize("defect", NOT_USABLE)
@pytest.mark.parametrize("kind", TOML_KINDS)
def test_what_is_no_usable_toml(kind: str, defect: str, tmp_path: Path) -> None:
    case = NOT_USABLE[defect]
    assert refusal(kind, case.make(tmp_path)) == case.sentence


@pytest.mark.parametrize("kind", LOADERS)
def test_what_is_too_large(kind: str, tmp_path: Path) -> None:
    """100 MB are refused by their size, before memory is asked for them."""
    path = LARGE.make(tmp_path)
    start = time.process_time()
    assert refusal(kind, path) == "cannot be read: " + LARGE.sentence.format(64 if kind in TABLES else 1)
    assert time.process_time() - start < 10.0


@pytest.mark.parametrize("kind", LOADERS)
def test_what_may_not_be_read(kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "x.toml"
    path.write_text("name = 'secret'\n")
    path.chmod(0)
    if os.access(path, os.R_OK):  # the tests run as root, whom nothing stops
        opened = Path.open

        def stopped(self: Path, mode: str = "r", *arguments: object, **options: object) -> object:
            if self == path:
                raise PermissionError(13, os.strerror(13))
            return opened(self, mode, *arguments, **options)  # type: ignore[call-overload]

        monkeypatch.setattr(Path, "open", stopped)
    assert refusal(kind, str(path)) == "cannot be read: Permission denied"


@pytest.mark.parametrize("kind", TOML_KINDS)
@pytest.mark.parametrize("mark", [b"", codecs.BOM_UTF8], ids=["plain", "marked"])
def test_files_of_other_systems_simply_work(kind: str, mark: bytes, tmp_path: Path) -> None:
    """With a mark of the encoding, as Windows' editors write it, and lines ended in the way of each system."""
    load, text = TOML_KINDS[kind]
    (tmp_path / "plain").mkdir()
    good, strange = tmp_path / "plain" / "x.toml", tmp_path / "x.toml"
    good.write_text(text(), encoding="utf-8")
    strange.write_bytes(mark + text().replace("\n", "\r\n").encode())
    assert load(str(strange)) == load(str(good))


@pytest.mark.parametrize("name", ["x.nc", "x.csv", "x_*.nc"])
def test_an_ocean_is_refused_alike(name: str, tmp_path: Path) -> None:
    path = tmp_path / name.replace("*", "1")

    def said() -> str:
        with in_time(20), pytest.raises(FileError) as caught:
            Ocean.open(name)
        return str(caught.value)

    if "*" not in name:
        assert said() == f"{name}: cannot be read: No such file or directory"
    os.mkfifo(path)
    assert said() == f"{path.name}: cannot be read: it is a pipe"
    path.unlink()
    with socket.socket(socket.AF_UNIX) as end:
        end.bind(path.name)
    assert said() == f"{path.name}: cannot be read: it is a socket"
    path.unlink()
    path.symlink_to("/dev/zero")
    assert said() == f"{path.name}: cannot be read: it is a device"


@pytest.mark.parametrize("name", ["x" * 300, "x" * 300 + ".csv", "/".join(["x" * 200] * 30), "", ".", "/"])
def test_an_ocean_of_an_impossible_name(name: str) -> None:
    with pytest.raises(StommelError, match=r": cannot be read: (File name too long|it is a folder)"):
        Ocean.open(name)


VERBS: dict[str, tuple[str, ...]] = {
    "vehicle": ("trim", "PATH", "--speed", "0.4", "--pitch", "-35"),
    "vehicle, shown": ("vehicle", "show", "PATH", "--toml"),
    "vehicle, checked": ("vehicle", "check", "PATH"),
    "mission": ("simulate", "PATH"),
    "study": ("study", "PATH"),
    "engine": ("engine", "zju", "--engine", "PATH"),
    "materials": ("hull", "zju", "--materials", "PATH"),
    "column map": ("bench", "analyse", "log.csv", "--map", "PATH"),
    "pressure test": ("bench", "pressure", "log.csv", "--description", "PATH"),
    "compass samples": ("vehicle", "calibrate-compass", "PATH"),
    "engine log": ("bench", "analyse", "PATH"),
    "table of holds": ("bench", "pressure", "PATH"),
    "states": ("derivative", "zju", "--states", "PATH"),
    "ocean": ("ocean", "show", "PATH"),
}
ON_THE_COMMAND_LINE = [(verb, "pipe") for verb in VERBS] + [
    (verb, defect)
    for verb in ("vehicle", "study")
    for defect in ("folder", "zero", "missing", "long name", "empty", "latin", "lists in lists", "5000 digits")
]


@pytest.mark.parametrize(("verb", "defect"), ON_THE_COMMAND_LINE)
def test_the_command_says_the_same(stommel: Command, tmp_path: Path, verb: str, defect: str) -> None:
    (tmp_path / "log.csv").write_text("t,p\n1,2\n")
    case: Refused = (UNREADABLE | NOT_USABLE)[defect]
    path = case.make(tmp_path)
    found = stommel(*(path if word == "PATH" else word for word in VERBS[verb]))
    reading = "" if defect in NOT_USABLE else "cannot be read: "
    named = path or "."
    named = named if len(named) <= 300 else f"{named[:300]}..."
    assert (found.status, found.out) == (2, "")
    assert found.err == f"error: {named}: {reading}{case.sentence}\n"


def test_a_name_on_one_line(tmp_path: Path) -> None:
    with pytest.raises(FileError) as caught:
        LOADERS["vehicle"]("two\nlines\x1b[31m.toml")
    assert str(caught.value) == r"two\nlines\x1b[31m.toml: cannot be read: No such file or directory"
