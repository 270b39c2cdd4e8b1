"""Bad logs on purpose: each is refused with file, column, row and value; the same log untouched is read."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from stommel.bench import BenchFileError, read_engine_log
from tests.bench.conftest import Edit, edited

RUN, TIME, PRESSURE, SPEED, VOLTAGE, CURRENT, TRAVEL = range(7)
COMMENT_LINES = 2


def put(row: int, column: int, text: str) -> Edit:
    def edit(cells: list[list[str]]) -> None:
        cells[row][column] = text

    return edit


def every(column: int, change: Callable[[str], str], first: int = 1, last: int = 10**6) -> Edit:
    def edit(cells: list[list[str]]) -> None:
        for row in cells[first:last]:
            row[column] = change(row[column])

    return edit


def times(factor: float) -> Callable[[str], str]:
    return lambda cell: f"{float(cell) * factor:.6f}"


def without_rows(first: int, last: int) -> Edit:
    def edit(cells: list[list[str]]) -> None:
        del cells[first:last]

    return edit


def refused(path: Path) -> str:
    with pytest.raises(BenchFileError) as caught:
        read_engine_log(path)
    message = str(caught.value)
    assert "\n" not in message
    assert message.startswith(str(path))
    return message


def test_the_untouched_log_is_read(log_file: Path) -> None:
    log = read_engine_log(log_file)
    assert len(log.runs) == 4
    assert log.generated


@pytest.mark.parametrize(
    ("edit", "column", "row", "words"),
    [
        (put(0, CURRENT, "amps"), "current_a", None, ["missing", "amps"]),
        (put(0, CURRENT, "voltage_v"), "voltage_v", None, ["stands twice"]),
        (put(7, CURRENT, "nan"), "current_a", 7, ["'nan'", "not a finite number"]),
        (put(7, CURRENT, "-inf"), "current_a", 7, ["'-inf'", "not a finite number"]),
        (put(7, CURRENT, "n/a"), "current_a", 7, ["'n/a' is not a number"]),
        (put(7, CURRENT, ""), "current_a", 7, ["empty cell"]),
        (put(7, PRESSURE, "5.1 bar"), "pressure_mpa", 7, ["'5.1 bar'", "mixed units", "MPa"]),
        (put(7, PRESSURE, "400"), "pressure_mpa", 7, ["400 MPa", "wrong unit"]),
        (put(7, PRESSURE, "12"), "pressure_mpa", 7, ["12 MPa", "beyond the range of the sensor"]),
        (put(7, TIME, "3.0"), "time_s", 7, ["runs backwards", "3 s after"]),
        (put(7, TIME, "10.000"), "time_s", 8 - 1, ["stands still"]),
        (without_rows(10, 16), "time_s", 10, ["gap in time", "14 s after", "usual are 2 s"]),
        (without_rows(15, 44), "motor_speed_rpm", None, ["too few samples", "at least 20"]),
        (every(CURRENT, lambda _: "0.5123", 10, 20), "current_a", 10, ["stuck sensor", "0.5123 A for 10 rows"]),
        (every(TRAVEL, lambda _: "200.1", 10, 25), "piston_travel_mm", 10, ["stuck sensor", "200.1 mm"]),
        (every(CURRENT, lambda _: "30.0", 12, 15), "current_a", 12, ["saturated sensor", "end of its range"]),
        (every(SPEED, lambda _: "0", 12, 13), "motor_speed_rpm", 12, ["rests in the middle"]),
        (every(PRESSURE, times(10.0), 20, 40), "pressure_mpa", 20, ["mixed units", "bar", "MPa"]),
        (every(TRAVEL, times(0.1), 20, 44), "piston_travel_mm", 20, ["mixed units", "cm", "mm"]),
        (put(7, RUN, ""), "run", 7, ["empty cell"]),
    ],
)  # fmt: skip
def test_refused(log_file: Path, edit: Edit, column: str, row: int | None, words: list[str]) -> None:
    message = refused(edited(log_file, edit))
    assert f"column {column!r}" in message
    if row is not None:
        assert f"row {row + 1 + COMMENT_LINES}:" in message
    for word in words:
        assert word in message


def test_a_logger_that_hangs_is_refused(log_file: Path) -> None:
    def freeze(cells: list[list[str]]) -> None:
        for row in cells[11:25]:
            row[PRESSURE:] = cells[10][PRESSURE:]

    assert "the logger hangs" in refused(edited(log_file, freeze))


def test_clipped_readings_without_a_stated_range_are_refused(log_file: Path) -> None:
    """The tops of the current are cut off where nothing says what the sensor's range is."""
    beside = log_file.with_suffix(".toml")
    beside.write_text(beside.read_text().replace(", range = [-1.0, 30.0]", ""))
    read_engine_log(log_file)
    clipped = edited(log_file, every(CURRENT, lambda cell: f"{min(float(cell), 0.57):.4f}"))
    message = refused(clipped)
    assert "saturated sensor" in message
    assert "0.57 A" in message


def test_a_piston_that_turns_round_is_refused(log_file: Path) -> None:
    def back(cells: list[list[str]]) -> None:
        first = [row for row in cells[1:] if row[RUN] == "01"]
        half = len(first) // 2
        for k, row in enumerate(first[half:]):
            row[TRAVEL] = f"{float(first[max(half - 1 - k, 0)][TRAVEL]) + 0.003 * k:.3f}"

    assert "turns round" in refused(edited(log_file, back))


def test_rows_before_the_motor_starts_are_left_out(log_file: Path) -> None:
    whole = read_engine_log(log_file).runs[0]
    rest = read_engine_log(edited(log_file, every(SPEED, lambda _: "0.0", 1, 6))).runs[0]
    assert len(rest.time) == len(whole.time) - 5
    assert rest.time[0] == whole.time[5]


@pytest.mark.parametrize(
    ("find", "replacement", "words"),
    [
        ('unit = "MPa"', 'unit = "mpa"', ["pressure.unit = 'mpa'", "unknown unit", "MPa, Pa, kPa, bar"]),
        ('unit = "MPa"', 'unit = "bar"', ["mixed units", "named in MPa", "says bar"]),
        ('column = "time_s"', "value = 3.0", ["time", "must be a column"]),
        ("format = 1", "format = 2", ["format"]),
        ("[columns]", "[colums]", ["colums", "did you mean columns"]),
        ("[0.0, 300.0]", "[300.0, 0.0]", ["first number must be less"]),
        ("[columns]", "[columns", ["is not valid TOML", "line 6, column 9"]),
        ("piston_diameter_mm = 50", "piston_diameter_mm = -50", ["piston_diameter_mm", "between 2 and 500 mm"]),
    ],
)
def test_wrong_column_maps_are_refused(log_file: Path, find: str, replacement: str, words: list[str]) -> None:
    beside = log_file.with_suffix(".toml")
    text = beside.read_text()
    assert find in text
    beside.write_text(text.replace(find, replacement))
    with pytest.raises(BenchFileError) as caught:
        read_engine_log(log_file)
    for word in words:
        assert word in str(caught.value)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "no rows"),
        (b"run,time_s\n", "no rows"),
        (b"\xff\xfe\x00", "not UTF-8"),
    ],
)
def test_files_that_are_no_tables_are_refused(log_file: Path, content: bytes, words: str) -> None:
    log_file.write_bytes(content)
    assert words in refused(log_file)


def test_a_short_row_is_refused(log_file: Path) -> None:
    lines = log_file.read_text().splitlines()
    lines[9] = lines[9].rpartition(",")[0]
    log_file.write_text("\n".join(lines))
    assert re.search(r"row 10: has 6 cells where the column names are 7", refused(log_file))


def test_a_missing_file_and_a_missing_map_are_refused(tmp_path: Path, log_file: Path) -> None:
    log_file.rename(tmp_path / "moved.csv")
    with pytest.raises(BenchFileError, match=r"moved\.csv: no column map: write .*moved\.toml"):
        read_engine_log(tmp_path / "moved.csv")
    with pytest.raises(BenchFileError, match=r"log\.csv: cannot be read: No such file"):
        read_engine_log(log_file)
