"""Delimited text: what a row, a comment and a column are; profiles and logs of tests share the reader."""

from pathlib import Path

import pytest

from stommel.bench import BenchFileError, read_pressure_test
from stommel.errors import FileError
from stommel.files.delimited import read_delimited
from stommel.seawater import read_stratification


def written(folder: Path, text: str | bytes) -> Path:
    path = folder / "x.csv"
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return path


@pytest.mark.parametrize("mark", ["", "\ufeff"])
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_rows_and_comments(tmp_path: Path, end: str, mark: str) -> None:
    lines = ["# a cast", "a, b", "", "1,2", "  # more", ",", '"3", 4 ', ""]
    table = read_delimited(written(tmp_path, mark + end.join(lines)))
    assert table.header == ("a", "b")
    assert table.rows == (("1", "2"), ("3", "4"))
    assert table.lines == (4, 7)
    assert table.comments == ("a cast", "more")
    assert table.cells("b") == ["2", "4"]


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "has no rows below a line of column names"),
        ("# nothing\n", "has no rows below a line of column names"),
        ("depth_m,density_kg_m3\n", "has no rows below a line of column names"),
        ("depth_m,depth_m\n1,2\n", "column 'depth_m': stands twice in the line of column names"),
        ("depth_m,density_kg_m3\n1,1020\n2\n", "row 3: has 1 cells where the column names are 2"),
        ('depth_m,density_kg_m3\n"1,1020\n2",1020\n', "has a quoted cell that runs over the end of its line"),
        (f"depth_m,density_kg_m3\n1,{'1' * 200_000}\n", "is not a table of numbers: field larger than field limit"),
    ],
)
def test_what_is_no_table(tmp_path: Path, text: str, sentence: str) -> None:
    path = written(tmp_path, text)
    with pytest.raises(FileError) as profile:
        read_stratification(path)
    with pytest.raises(BenchFileError) as log:
        read_pressure_test(path)
    assert str(profile.value) == str(log.value)
    assert str(log.value).startswith(f"{path}: {sentence}")
