"""Who names a folder of data means it: a test must not pass over what lacks there."""

from pathlib import Path

import pytest

from tests.support.shared_data import shared_data


def test_a_named_folder_that_lacks_the_data_fails(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("STOMMEL_DATA", str(tmp_path))
    with pytest.raises(pytest.fail.Exception, match=r"arctic20\.nc, of STOMMEL_DATA"):
        shared_data("arctic20", "arctic20.nc")
    (tmp_path / "arctic20").mkdir()
    (tmp_path / "arctic20" / "arctic20.nc").touch()
    assert shared_data("arctic20", "arctic20.nc") == tmp_path / "arctic20" / "arctic20.nc"


def test_without_the_folder_the_reason_of_the_skip_names_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("STOMMEL_DATA", raising=False)
    with pytest.raises(pytest.skip.Exception, match=r"no shared data: .*there-is-none.*STOMMEL_DATA names another"):
        shared_data("there-is-none")
