"""Table 5 of the paper, by hand; and tables of holds that no hull can have made."""

from pathlib import Path

import pytest

from stommel.bench import BenchFileError, judge, read_pressure_test

HEADER = "hold,from,to,from_pressure_mpa,to_pressure_mpa\n"
TABLE_5 = [
    (0.5, 0.067), (1.0, 0.075), (1.0, 0.073), (0.5, 0.042), (1.0, 0.046), (1.0, 0.025),
]  # fmt: skip
"""Hours and lost MPa of each hold, subtracted by hand."""


def table(tmp_path: Path, *rows: str, description: str = "") -> Path:
    path = tmp_path / "holds.csv"
    path.write_text(HEADER + "\n".join(rows) + "\n")
    if description:
        path.with_suffix(".toml").write_text(description)
    return path


def test_losses_and_rates_of_table_5() -> None:
    report = judge(read_pressure_test("fan2013-table5"))
    assert report.passed
    assert report.failures() == []
    for result, (hours, loss) in zip(report.results, TABLE_5, strict=True):
        assert result.hold.duration == hours * 3600
        assert result.hold.loss / 1e6 == pytest.approx(loss, abs=1e-9)
        assert result.rate * 3600 / 1e6 == pytest.approx(loss / hours, abs=1e-9)
    assert "Fan et al. (2013)" in report.test.comments[0]


def test_leak_rate_from_the_chamber_s_compliance(tmp_path: Path) -> None:
    """100 l of which the hull takes 50: 50 l / 2000 MPa + 100 l * 1e-11 + 50 l * 4e-10 per Pa, by hand 46 ml/MPa."""
    description = """
        [chamber]
        volume_l = 100.0
        compressibility_per_pa = 1e-11
        water_bulk_modulus_mpa = 2000.0
        water_thermal_expansion_per_k = 2e-4
        hull_volume_l = 50.0
        hull_compressibility_per_pa = 4e-10
        """
    report = judge(read_pressure_test(table(tmp_path, "1,10:00,12:00,2.30,2.25", description=description)))
    (result,) = report.results
    assert report.as_json()["compliance_ml_per_mpa"] == pytest.approx(46.0)
    assert result.as_row()["leak_ml_per_h"] == pytest.approx(46.0 * 0.05 / 2)
    # 46 ml/MPa * 0.05 MPa of water volume, from 50 l that shrink by 10 ml/K
    assert result.cooling == pytest.approx(2.3 / 10.0)
    assert report.settling is None


def test_no_leak_rate_without_a_chamber(tmp_path: Path) -> None:
    report = judge(read_pressure_test(table(tmp_path, "1,10:00,12:00,2.30,2.25")))
    assert report.results[0].leak is None
    assert any("no leak rate" in note for note in report.notes())


def test_the_rate_of_table_5_dies_out() -> None:
    settling = judge(read_pressure_test("fan2013-table5")).settling
    assert settling is not None
    assert settling.high < 1.0
    assert "settle" in settling.verdict


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        (["1,10:00,11:00,2.4,2.30"], "hold 1 loses 0.100 MPa; less than 0.1"),
        (["1,10:00,11:00,2.4,2.35", "2,11:10,12:00,2.05,2.0"], "hold 2 falls to 2.000 MPa; it must stay above 2"),
    ],
)
def test_limits_themselves_fail(tmp_path: Path, rows: list[str], words: str) -> None:
    report = judge(read_pressure_test(table(tmp_path, *rows)))
    assert not report.passed
    assert words in report.failures()[0]


def test_stated_limits_count(tmp_path: Path) -> None:
    loose = "[limits]\nlargest_loss_mpa = 0.2\nlowest_pressure_mpa = 1.0\n"
    assert judge(read_pressure_test(table(tmp_path, "1,10:00,11:00,2.4,2.25", description=loose))).passed


def test_holds_across_midnight(tmp_path: Path) -> None:
    holds = read_pressure_test(
        table(tmp_path, "1,22:30,23:30,2.4,2.35", "2,23:45,00:45,2.4,2.36", "3,01:00,02:00,2.4,2.37")
    ).holds
    assert [hold.duration for hold in holds] == [3600.0] * 3
    assert [hold.begin / 3600 for hold in holds] == [22.5, 23.75, 25.0]
    rows = [result.as_row() for result in judge(read_pressure_test(tmp_path / "holds.csv")).results]
    assert [row["across_midnight"] for row in rows] == [False, True, False]
    assert (rows[1]["from"], rows[1]["to"]) == ("23:45", "00:45")


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        (["1,16:45,17:15,2.4,2.3", "2,17:00,18:00,2.4,2.3"], ["column 'from', row 3", "17:00", "overlap", "at 17:15"]),
        (["1,16:45,17:15,2.4,2.3", "2,15:00,16:00,2.4,2.3"], ["row 3", "out of order"]),
        (["1,17:15,16:45,2.4,2.3"], ["column 'to', row 2", "17:15 to 16:45", "23.5 h across midnight", "at most 12 h"]),
        (["1,17:15,17:15,2.4,2.3"], ["row 2", "lasts no time"]),
        (["1,16:45,17:15,2.3,2.4"], ["column 'to_pressure_mpa', row 2", "2.4 MPa after 2.3 MPa", "rises in hold 1"]),
        (["1,16:45,24:00,2.4,2.3"], ["'24:00'", "00:00 to 23:59"]),
        (["1,quarter to,17:15,2.4,2.3"], ["'quarter to'", "hh:mm"]),
        (["1,16:45,17:15,2.4,nan"], ["column 'to_pressure_mpa', row 2", "nan MPa"]),
        (["1,16:45,17:15,2.4,?"], ["'?' is not a number"]),
        (["1,16:45,17:15,2.4,-0.1"], ["-0.1 MPa", "above 0"]),
        (["1,16:45,17:15,2.4"], ["row 2", "4 cells"]),
    ],
)  # fmt: skip
def test_impossible_tables_are_refused(tmp_path: Path, rows: list[str], words: list[str]) -> None:
    path = table(tmp_path, *rows)
    with pytest.raises(BenchFileError) as caught:
        read_pressure_test(path)
    assert str(caught.value).startswith(str(path))
    for word in words:
        assert word in str(caught.value)


@pytest.mark.parametrize(
    ("description", "words"),
    [
        ('[columns]\nbegin_pressure = { column = "from_pressure_mpa", unit = "atm" }', "unknown unit; allowed are MPa"),
        (
            "[chamber]\nvolume_l = 40\nhull_volume_l = 57\nhull_compressibility_per_pa = 5e-10",
            "must be less than volume_l = 40",
        ),
        ("[chamber]\nvolume_l = 400\nhull_volume_l = 57", "hull_compressibility_per_pa is missing"),
        ("[limits]\nlargest_loss_mpa = 0", "between 0.0001 and 20 MPa"),
        ("[limits]\nlargest_los_mpa = 1", "did you mean largest_loss_mpa"),
    ],
)
def test_wrong_descriptions_are_refused(tmp_path: Path, description: str, words: str) -> None:
    with pytest.raises(BenchFileError, match=words):
        read_pressure_test(table(tmp_path, "1,16:45,17:15,2.4,2.3", description=description))


def test_a_missing_column_is_named(tmp_path: Path) -> None:
    path = table(tmp_path, "1,16:45,17:15,2.4,2.3")
    path.write_text(path.read_text().replace("to_pressure_mpa", "p"))
    with pytest.raises(BenchFileError, match=r"column 'to_pressure_mpa': missing; the file has: hold, from, to"):
        read_pressure_test(path)
