"""Oracle: the layers of the architecture, as import-linter reads them from pyproject.toml."""

import subprocess
import sys
from pathlib import Path

import stommel
from tests.support.pages import ROOT
from tests.support.python import run_python


def test_import_contracts_hold() -> None:
    linter = Path(sys.executable).with_name("lint-imports")
    found = subprocess.run([linter, "--no-cache"], cwd=ROOT, capture_output=True, text=True, check=False)
    assert found.returncode == 0, found.stdout + found.stderr


def test_front_door_is_complete() -> None:
    """Every public name of the package imports, and the table of names is the list of them."""
    assert set(stommel.__all__) == {"__version__", *stommel._WHERE}
    for name in stommel.__all__:
        assert getattr(stommel, name) is not None


def test_importing_stommel_is_light() -> None:
    """The front door loads neither compiler nor plots: start-up counts."""
    heavy = {"numba", "numpy", "scipy", "matplotlib"}
    code = f"import sys, stommel, stommel.cli.app; print(sorted({heavy} & set(sys.modules)))"
    assert run_python("-c", code).strip() == "[]"
