"""Oracle: two programs that write in one folder would mix their logs; the second is refused with file, key, value."""

import re
from pathlib import Path

import pytest

from stommel.errors import FileError
from stommel.onboard.coordination.config import Configuration, read_configuration
from stommel.onboard.running.folders import FOLDERS, claimed, storage_of
from tests.support.configuration import CONFIGURATION


def configured(folder: Path, name: str, top: str = "", log: str = "") -> Configuration:
    path = folder / name
    path.write_text(f"{top}\n{CONFIGURATION}\n[log]\n{log}".replace("{digest}", "0" * 64))
    return read_configuration(path)


@pytest.mark.parametrize(
    ("top", "log", "key"),
    [
        ("", "", "missions = 'missions'"),
        ('missions = "m"', 'folder = "l"', "parameters = 'parameters'"),
        ('missions = "m"\nparameters = "./p"', "", "log.folder = 'log'"),
    ],
)
def test_a_second_program_is_kept_out(tmp_path: Path, top: str, log: str, key: str) -> None:
    first, second = configured(tmp_path, "A.toml"), configured(tmp_path, "B.toml", top, log)
    words = re.escape(f"{tmp_path / 'B.toml'}: {key}: another `stommel vehicle run` is writing there")
    with claimed(first), pytest.raises(FileError, match=words), claimed(second):
        pass
    with claimed(second):
        pass


def test_one_folder_may_serve_for_all(tmp_path: Path) -> None:
    with claimed(configured(tmp_path, "A.toml", 'missions = "all"\nparameters = "all"', 'folder = "./all"')):
        assert sorted(path.name for path in tmp_path.iterdir() if path.is_dir()) == ["all", "inbox"]


@pytest.mark.parametrize("key", FOLDERS)
def test_a_file_in_the_way_is_named(tmp_path: Path, key: str) -> None:
    (tmp_path / key.removesuffix(".folder")).write_text("mine")
    found = configured(tmp_path, "A.toml")
    with pytest.raises(FileError, match=re.escape(f"{tmp_path / 'A.toml'}: {key} = ") + ".*: cannot be used: "):
        storage_of(found, key)
