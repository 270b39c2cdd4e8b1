"""An archive with one vehicle, and alarms over it."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from stommel.archive.archive import Archive


@pytest.fixture
def archive(tmp_path: Path) -> Iterator[Archive]:
    with Archive.open(f"sqlite:///{tmp_path / 'archive.sqlite'}", busy_timeout_s=0.5) as opened:
        opened.know(1, "Zhong", "zju")
        opened.know(2, "Guo", "zju")
        yield opened
