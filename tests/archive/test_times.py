"""One time is one number wherever it comes out of the archive. Oracle: the whole microseconds that were put in."""

import re
from pathlib import Path

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

import stommel
from stommel.archive.times import GREATEST_TIME, microseconds, seconds

TIMES = st.integers(0, round(GREATEST_TIME * 1e6))
SRC = Path(stommel.__file__).parent


@given(TIMES)
def test_a_time_comes_back_as_the_microseconds_that_it_was(t_us: int) -> None:
    assert microseconds(seconds(t_us)) == t_us


@given(st.lists(TIMES, max_size=50))
def test_many_times_are_the_same_numbers_as_each_alone(all_us: list[int]) -> None:
    assert seconds(np.array(all_us, dtype=np.int64)).tolist() == [seconds(t_us) for t_us in all_us]


def test_there_is_no_second_way_from_microseconds_to_seconds() -> None:
    """Of 10 000 times of this year 3 420 times 1e-6 differ in the last digit from themselves by 1e6."""
    assert 1_782_864_000_100_001 * 1e-6 != 1_782_864_000_100_001 / 1e6
    other = re.compile(r"(_us|both)\b\S* (\* 1e-6|/ 1e6)|_us\S*\) (\* 1e-6|/ 1e6)")
    rooms = [path for room in ("archive", "station") for path in sorted((SRC / room).rglob("*.py"))]
    found = [path.relative_to(SRC).as_posix() for path in rooms if other.search(path.read_text(encoding="utf-8"))]
    assert found == ["archive/times.py"]
