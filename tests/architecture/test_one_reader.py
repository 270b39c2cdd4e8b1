"""Files from outside are read in one place: no other module parses TOML, words pydantic's errors or opens a file."""

import ast
from collections.abc import Iterator
from pathlib import Path

import stommel

SRC = Path(stommel.__file__).parent

WORDS_ERRORS = {
    "files/sentences.py": "the one place",
    "ocean/analytic/everywhere.py": "numbers of an ocean, which come from no file of their own",
    "dynamics/state_files.py": "a list in JSON",
}
OPENS = {
    "files/opening.py": "the one place",
    "files/whole.py": "writes",
    "files/folder_lock.py": "the folder itself, to lock it",
    "cli/__init__.py": "the null device",
    "compilation/cache.py": "the machine code that it keeps",
    "compilation/sources.py": "the package's own source",
    "design/published/__init__.py": "the package's own data",
    "ocean/reading/classic.py": "after files/opening.py has looked at the file",
    "cli/station/simulated.py": "what the simulated glider prints",
    "data/files.py": "writes a whole file line by line",
    "station/alarms/delivery.py": "secrets of mail and web hooks",
    "archive/quiet_opening.py": "the head of an archive, without touching it",
    "archive/telemetry_file.py": "writes a whole file line by line",
    "station/vehicles/file_follower.py": "a file that came, to know its hash",
    "station/vehicles/mission_fetch.py": "orders that came, to know their hash",
    "station/web/built_page.py": "the built page",
    "link/files/folder_disk.py": "received files and their journals",
    "files/folder_storage.py": "the vehicle's own disk",
    "studies/study.py": "digest of ocean files that were read before",
    "studies/journal.py": "its lock",
    "studies/result.py": "what it has written itself",
}


def trees() -> Iterator[tuple[str, ast.Module]]:
    for path in sorted(SRC.rglob("*.py")):
        yield path.relative_to(SRC).as_posix(), ast.parse(path.read_text(encoding="utf-8"))


def imported(tree: ast.Module) -> set[str]:
    found = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        if isinstance(node, ast.ImportFrom):
            found |= {str(node.module), *(f"{node.module}.{alias.name}" for alias in node.names)}
    return found


def opens(tree: ast.Module) -> Iterator[str]:
    """Calls that open a file, but for the package's own resources and for oceans, whose method has that name."""
    for node in ast.walk(tree):
        if not isinstance(node, ast.Call):
            continue
        call = ast.unparse(node.func)
        name = call.rsplit(".", 1)[-1]
        of_the_package = "files(" in call
        if name in ("open", "read_text", "read_bytes", "open_dataset") and not of_the_package:
            yield call


def test_toml_is_parsed_in_one_place() -> None:
    assert {name for name, tree in trees() if "tomllib" in imported(tree)} == {"files/toml_reader.py"}


def test_errors_of_validation_are_worded_in_one_place() -> None:
    found = {name for name, tree in trees() if "pydantic.ValidationError" in imported(tree)}
    assert found == set(WORDS_ERRORS)


def test_files_are_opened_in_one_place() -> None:
    own = {"Ocean.open", "Archive.open", "Image.open", "self._open", "read_text", "read_bytes", "_open"}
    own |= {"hub.open", "self.hub.open", "station.previews.open", "self._opener().open"}  # no files
    found = {name: {call for call in opens(tree) if call not in own} for name, tree in trees()}
    found = {name: calls - {"xr.open_dataset"} for name, calls in found.items()}
    assert {name for name, calls in found.items() if calls} == set(OPENS)
