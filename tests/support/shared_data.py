"""Where the data sets lie that are too large for the repository."""

import os
from pathlib import Path

import pytest

from tests.support.pages import ROOT


def shared_data(*parts: str) -> Path:
    """Path of a file or folder of the shared data; a test that asks where there are none is skipped and says why.

    The folder is that of the environment variable STOMMEL_DATA, or `shared/data` beside the checkout. Who names a
    folder means it: what lacks there fails.
    """
    named = os.environ.get("STOMMEL_DATA")
    path = (Path(named) if named else ROOT.parent / "shared" / "data").joinpath(*parts)
    if not path.exists():
        if named:
            pytest.fail(f"no shared data: {path}, of STOMMEL_DATA = {named}")
        pytest.skip(f"no shared data: {path} (STOMMEL_DATA names another folder)")
    return path
