"""Bays from nose to tail: those that overlap are refused by name, those that only touch are not."""

import pytest

from stommel.errors import FileError
from stommel.vehicle import builtin_text, load_vehicle, vehicle_from_text

BAYS = load_vehicle("zju").description.bays


def with_front_at(k: int, metres: float) -> str:
    """The text of the zju glider with one bay's front elsewhere."""
    text, bay = builtin_text("zju"), BAYS[k]
    at = text.index(f'name = "{bay.name}"', text.index("[[bays]]"))
    key = text.index("from_m", at)
    return text[:key] + f"from_m = {metres!r}" + text[text.index("\n", key) :]


@pytest.mark.parametrize("k", range(1, len(BAYS)))
def test_overlapping_bays_are_refused_by_name(k: int) -> None:
    inside = BAYS[k - 1].to_m + 1e-3
    with pytest.raises(FileError, match="may not overlap") as refused:
        vehicle_from_text(with_front_at(k, inside), "own.toml")
    (line,) = (str(problem) for problem in refused.value.problems if "overlap" in str(problem))
    assert repr(BAYS[k].name) in line
    assert repr(BAYS[k - 1].name) in line
    assert f"{inside:g} m" in line


@pytest.mark.parametrize("k", range(1, len(BAYS)))
def test_bays_that_touch_are_not(k: int) -> None:
    found = vehicle_from_text(with_front_at(k, BAYS[k - 1].to_m), "own.toml")
    assert found.description.bays[k].from_m == BAYS[k - 1].to_m
