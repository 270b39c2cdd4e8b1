"""Paths that no message can name: refused at once ashore, where they were asked for without end.

Oracle: a path has 200 bytes in glider.xml, and `FilePort` wants plain names below the root.
"""

import random
from pathlib import Path

import pytest

from stommel.link.files.folder_disk import FolderDisk
from stommel.link.files.progress import State
from stommel.link.shore.shore_end import ShoreEnd, ShoreSettings
from stommel.link.signing.guard import Guard
from stommel.sitl.faults.disk import MemoryDisk

IMPOSSIBLE = ["a" * 201, "log/" + "\N{GREEK SMALL LETTER ALPHA}" * 99, "log/\udcff", "log/../../etc/passwd", "a/" * 17]


@pytest.fixture
def end() -> ShoreEnd:
    draw = random.Random(1)
    return ShoreEnd(ShoreSettings(1, 1e6), Guard.unsigned(255), draw, draw.randbytes, MemoryDisk(), 1.8e9)


@pytest.mark.parametrize("path", IMPOSSIBLE)
def test_impossible_path_is_refused_before_anything_is_said(end: ShoreEnd, path: str, tmp_path: Path) -> None:
    asked = end.download(path, FolderDisk(tmp_path), "x"), end.upload(b"content", path), end.listing(path)
    for each in asked:
        assert each.state is State.REFUSED
        assert "path" in each.reason
    end.poll(1.8e9, 10_000)
    assert not end.session.failures
    assert not list(tmp_path.iterdir())


def test_longest_path_is_asked_for(end: ShoreEnd, tmp_path: Path) -> None:
    path = "a" * 200
    asked = end.download(path, FolderDisk(tmp_path), "x"), end.upload(b"content", path), end.listing(path)
    assert not any(each.state.is_over for each in asked)
    said = b"".join(end.poll(1.8e9 + t, 10_000) for t in range(5))
    assert said.count(path.encode()) >= 3
    assert not end.session.failures
