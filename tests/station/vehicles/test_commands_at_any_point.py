"""What people are told of a command is true, whatever happens at any point between their click and the vehicle.

Oracle: the fake vehicle, which keeps what has left the station and what it has executed; rows of the archive.
"""

import os
import random

import pytest

from stommel.station.vehicles import asking
from tests.station.vehicles.quay_of_commands import Sea

SEEDS = int(os.environ.get("STOMMEL_COMMAND_SEEDS", "400"))
"""In CI; 5 000 of each kind were run by hand."""


@pytest.fixture(autouse=True)
def no_wait(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(asking, "ANSWER_WITHIN", 0.0)


@pytest.mark.parametrize(
    ("crashes", "faults"), [(0.0, 0.0), (0.03, 0.0), (0.0, 0.1), (0.03, 0.05)], ids=["calm", "kill", "disk", "both"]
)
def test_nothing_that_was_sent_is_told_as_not_sent_and_nothing_as_done_that_was_not(
    crashes: float, faults: float
) -> None:
    seen: dict[str, int] = {}
    for seed in range(SEEDS):
        sea = Sea(random.Random(seed), crashes=crashes, faults=faults)
        for _ in range(40):
            sea.step()
        sea.calm_down()
        assert sea.wrong == [], f"seed {seed}"
        assert {row.id for row in sea.rows.values() if not row.is_last} == set(), f"seed {seed}: never ends"
        for row in sea.rows.values():
            seen[row.state] = seen.get(row.state, 0) + 1
    assert {"done", "refused", "not_sent"} <= seen.keys(), "the test has seen little"
