"""Machine code on disk: found again by whoever has the same sources, never by others, in folders that are ours."""

import json
import os
import shutil
import subprocess
import sys
import time
from collections import namedtuple
from collections.abc import Iterator
from pathlib import Path

import pytest

import stommel
from stommel.compilation import cache, plain

ROOT = Path(stommel.__file__).parent

ASK = """
import json
from stommel.geometry import earth
value = earth.to_waypoint(0.5, 0.1, 0.501, 0.102)
dispatcher = getattr(earth.to_waypoint, "dispatcher", earth.to_waypoint)
print(json.dumps([value, sum(dispatcher.stats.cache_hits.values())]))
"""


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    return copy_to(tmp_path / "first")


def copy_to(folder: Path) -> Path:
    shutil.copytree(ROOT, folder / "stommel", ignore=shutil.ignore_patterns("__pycache__"))
    time.sleep(0.1)  # sources that are newer than the process are not trusted
    return folder


def ask(copy: Path, kept: Path) -> tuple[list[float], int]:
    """Ask the way on the ellipsoid in a new process that uses `copy`: the answer, and how much code came from disk."""
    environment = os.environ | {"PYTHONPATH": str(copy), "NUMBA_CACHE_DIR": str(kept)}
    done = subprocess.run([sys.executable, "-c", ASK], env=environment, capture_output=True, text=True, check=True)
    value, hits = json.loads(done.stdout)
    return value, hits


def test_another_copy_of_the_same_sources_finds_the_code_and_an_edited_one_does_not(copy: Path, tmp_path: Path) -> None:
    kept = tmp_path / "kept"
    first, hits = ask(copy, kept)
    assert hits == 0
    second = copy_to(tmp_path / "second")
    earth = second / "stommel" / "geometry" / "earth.py"
    earth.write_text("# a comment moves all lines\n" + earth.read_text())
    time.sleep(0.1)
    assert ask(second, kept) == (first, 1)
    text = earth.read_text()
    assert "6378137.0" in text
    earth.write_text(text.replace("6378137.0", "6400000.0"))
    time.sleep(0.1)
    other, hits = ask(second, kept)
    assert hits == 0
    assert other != first


@pytest.fixture
def fresh(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[Path]:
    """No place for machine code is known yet; the temporary folder is an empty one."""
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    monkeypatch.setattr(cache.tempfile, "gettempdir", lambda: str(temporary))
    forget()
    yield temporary / f"stommel-{os.getuid()}"
    forget()


def forget() -> None:
    for function in (cache.folder_of, cache._keys, cache._home):
        function.cache_clear()


def test_where_the_users_cache_cannot_be_made_the_temporary_folder_serves_and_is_closed_to_others(
    fresh: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    folder = cache.folder_of("stommel.geometry.earth")
    assert folder is not None
    assert folder.parent == fresh
    assert fresh.stat().st_mode & 0o777 == 0o700


@pytest.mark.parametrize("trick", ["open to others", "a link", "another owner"])
def test_a_temporary_folder_that_others_may_have_made_is_not_used(
    fresh: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, trick: str
) -> None:
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    if trick == "a link":
        (tmp_path / "elsewhere").mkdir(mode=0o700)
        fresh.symlink_to(tmp_path / "elsewhere")
    else:
        fresh.mkdir(mode=0o700)
    if trick == "open to others":
        fresh.chmod(0o777)
    if trick == "another owner":
        mine = fresh.stat().st_uid
        monkeypatch.setattr(cache.os, "getuid", lambda: mine + 1)
        fresh.rename(fresh.with_name(f"stommel-{mine + 1}"))
    assert cache.folder_of("stommel.geometry.earth") is None


def test_sources_edited_after_the_start_of_a_process_name_none_of_its_code(
    fresh: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert cache.folder_of("stommel.geometry.earth") is not None
    forget()
    monkeypatch.setattr(cache, "_LOADED", 0.0)
    assert cache.folder_of("stommel.geometry.earth") is None


def test_only_the_newest_entries_are_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "_KEPT", 3)
    for age in range(6):
        entry = tmp_path / f"{age}"
        entry.mkdir() if age % 2 else entry.write_text("")
        os.utime(entry, (1000.0 - age, 1000.0 - age))
    cache._forget_old(tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["0", "1", "2"]


def test_two_processes_never_write_one_file_of_machine_code() -> None:
    from stommel.compilation.machine_code import _Index

    index = _Index("folder", "function", ())
    assert index._data_name(1) != index._data_name(1)
    assert index._data_name(1).endswith(".nbc")


def test_named_tuples_that_differ_in_the_order_of_their_fields_share_no_machine_code() -> None:
    """A function that takes one need not name its class, and Numba looks at its name and types alone."""
    from numba import typeof
    from numba.core.registry import cpu_target

    from stommel.compilation.machine_code import MachineCode
    from stommel.dynamics.equations import derivative

    machine_code, codegen = MachineCode(plain(derivative)), cpu_target.target_context.codegen()
    orders = [("rho", "T"), ("T", "rho")]
    kinds = [typeof(namedtuple("Water", fields)(1.0, 2.0)) for fields in orders]  # type: ignore[misc]  # made here
    keys = [machine_code._index_key((kind,), codegen) for kind in kinds]
    assert keys[0][1:] != keys[1][1:]
    inside = [
        machine_code._index_key((typeof((kind_value, 1)),), codegen)[1:]
        for kind_value in (namedtuple("Water", fields)(1.0, 2.0) for fields in orders)
    ]  # type: ignore[misc]  # made here
    assert inside[0] != inside[1]
