"""Profiles from CSV files: quantities and units come from the names of the columns."""

from pathlib import Path

import gsw
import numpy as np
import pytest

from stommel.errors import FileError
from stommel.seawater import read_stratification

PLACE = {"latitude": 28.0, "longitude": 126.0}


def write(folder: Path, text: str) -> Path:
    path = folder / "profile.csv"
    path.write_text(text)
    return path


def test_the_same_water_declared_in_different_quantities(tmp_path: Path) -> None:
    p = np.array([1.0, 50.0, 300.0])
    S_P, t = np.array([33.9, 34.5, 34.6]), np.array([27.0, 20.0, 11.0])
    S_A = gsw.SA_from_SP(S_P, p, 126.0, 28.0)
    CT, z = gsw.CT_from_t(S_A, t, p), -gsw.z_from_p(p, 28.0)
    tables = {
        "pressure_dbar,temperature_c,salinity_psu": (p, t, S_P),
        "depth_m,conservative_temperature_c,absolute_salinity_g_kg": (z, CT, S_A),
        "depth_m,potential_temperature_c,salinity_psu": (z, gsw.pt_from_CT(S_A, CT), S_P),
    }
    for header, columns in tables.items():
        rows = "\n".join(",".join(f"{number:.12g}" for number in row) for row in zip(*columns, strict=True))
        found = read_stratification(write(tmp_path, f"# a cast\n{header}\n{rows}\n"), **PLACE)
        assert found.depths == pytest.approx(z, rel=1e-9)
        assert found.density(z) == pytest.approx(gsw.rho(S_A, CT, p), abs=1e-6)


def test_density_alone_is_enough(tmp_path: Path) -> None:
    found = read_stratification(write(tmp_path, "depth_m,density_kg_m3\n0,1020\n100,1025\n"))
    assert found.density([0.0, 50.0, 300.0]) == pytest.approx([1020.0, 1022.5, 1025.0])


def test_columns_of_other_names(tmp_path: Path) -> None:
    path = write(tmp_path, "Z,T,S\n0,20,35\n10,19,35\n")
    found = read_stratification(path, {"depth_m": "Z", "temperature_c": "T", "salinity_psu": "S"})
    assert found.depths.tolist() == [0.0, 10.0]


@pytest.mark.parametrize(
    ("text", "columns", "words"),
    [
        ("", None, "has no rows below a line of column names"),
        ("depth_m,temperature_c,salinity_psu\n", None, "has no rows below a line of column names"),
        ("depth,temperature,salinity\n0,1,2\n", None, "no vertical column; add one of depth_m"),
        ("depth_m,temperature_c\n0,10\n", None, "no salinity column"),
        ("depth_m,temperature_c,salinity_psu\n0,10,x\n", None, "row 2: salinity_psu = 'x': must be a number"),
        (
            "depth_m,temperature_c,salinity_psu\n0,10,35\n\n5,10\n",
            None,
            "row 4: has 2 cells where the column names are 3",
        ),
        ("depth_m,temperature_c,salinity_psu\n0,10,99\n", None, "salinity_psu = 99: must be between 0 and 42"),
        ("depth_m,temperature_c,salinity_psu\n0,nan,35\n", None, "temperature_c = nan"),
        ("depth_m,temperature_c,salinity_psu\n5,10,35\n5,10,35\n", None, "5 is followed by 5"),
        ("depth_m,pressure_dbar,density_kg_m3\n5,5,1020\n", None, "only one vertical column"),
        ("z\n5\n", {"depth": "z"}, "unknown name depth"),
        ("z\n5\n", {"depth_m": "Z"}, "no column depth_m = 'Z'; there are: z"),
    ],
)
def test_what_is_wrong_is_said(tmp_path: Path, text: str, columns: dict[str, str] | None, words: str) -> None:
    with pytest.raises(FileError) as refused:
        read_stratification(write(tmp_path, text), columns)
    assert words in str(refused.value)
    assert "profile.csv" in str(refused.value)


def test_no_file(tmp_path: Path) -> None:
    with pytest.raises(FileError, match=r"nothing\.csv: cannot be read: No such file or directory$"):
        read_stratification(tmp_path / "nothing.csv")


@pytest.mark.parametrize(
    ("column", "cell", "said"),
    [
        ("temperature_c", "-9.990e-29", "instrument writes this for a bad reading"),
        ("salinity_psu", "-9.99e-29", "instrument writes this for a bad reading"),
        ("salinity_psu", "1e-30", "instrument writes this for a bad reading"),
        ("temperature_c", "-99.9", "must be between -5 and 42"),
        ("salinity_psu", "nan", "must be between 0 and 42"),
        ("temperature_c", "", "must be a number"),
        ("temperature_c", "1_2", "must be a number"),
        ("depth_m", "2026-07-01", "must be a number"),
    ],
)
def test_what_an_instrument_marks_is_refused_by_its_row(tmp_path: Path, column: str, cell: str, said: str) -> None:
    """A temperature of -9.99e-29 is within the range of water. Row 5 of the file, as an editor counts."""
    rows = [{"depth_m": str(10 * k), "temperature_c": "12", "salinity_psu": "35"} for k in range(5)]
    rows[2][column] = cell
    lines = ["# a cast", ",".join(rows[0]), *(",".join(row.values()) for row in rows)]
    path = tmp_path / "cast.csv"
    path.write_text("\n".join(lines))
    with pytest.raises(FileError) as refused:
        read_stratification(path)
    text = str(refused.value)
    assert f"row 5: {column} = " in text
    assert said in text


@pytest.mark.parametrize(("mark", "name"), [(";", "semicolons"), ("\t", "tabs")])
def test_another_delimiter_is_named(tmp_path: Path, mark: str, name: str) -> None:
    path = tmp_path / "cast.csv"
    path.write_text(mark.join(("depth_m", "density_kg_m3")) + "\n" + mark.join(("0", "1020")) + "\n")
    with pytest.raises(FileError, match=rf"cast\.csv: is delimited by {name}; must be by commas"):
        read_stratification(path)
