"""A mission that people gave comes to its end, and is flown once at most, however often the station is killed.

Oracle: the fake vehicle, which keeps every orders file to which it switched; rows of the archive.
"""

import os
import random
from collections import Counter
from pathlib import Path

import pytest

from stommel.station.vehicles.mission_rows import OPEN
from stommel.station.vehicles.mission_task import HAS_NOT
from tests.station.vehicles.quay_of_missions import ELSEWHERE, ON_THE_LINE, Sea

SEEDS = int(os.environ.get("STOMMEL_MISSION_SEEDS", "40"))
"""In CI; 1 000 of each kind were run by hand."""
FIRST = "the first orders"


@pytest.mark.parametrize(
    ("kills", "faults"), [(0.0, 0.0), (0.1, 0.0), (0.05, 0.1)], ids=["calm", "killed", "killed and disk"]
)
def test_every_mission_ends_and_none_is_flown_twice_or_after_it_was_replaced(
    tmp_path: Path, kills: float, faults: float
) -> None:
    seen: Counter[str] = Counter()
    for seed in range(SEEDS):
        sea = Sea(random.Random(seed), tmp_path, kills=kills, faults=faults)
        for _ in range(40):
            sea.step()
        sea.calm_down()
        held = [content.decode() for content in sea.vehicle.files[1:]]
        flown = [orders for orders in held if not orders.startswith(ELSEWHERE.decode())]
        names = {row.orders: row.id for row in sea.rows.values()}
        assert max(Counter(flown).values(), default=1) == 1, f"seed {seed}: flown twice"
        assert [names[orders] for orders in flown] == sorted(names[orders] for orders in flown), (
            f"seed {seed}: replaced"
        )
        assert not [row.id for row in sea.rows.values() if row.state in OPEN], f"seed {seed}: never ends"
        aboard = [row.orders for row in sea.rows.values() if row.state == "aboard"]
        assert aboard == (held[-1:] or [FIRST]), f"seed {seed}: told is not what is aboard"
        for content, t in sea.switched_at.items():
            until = sea.rows[names[content.decode()]].until
            assert until is not None
            assert t < until + ON_THE_LINE, f"seed {seed}: flown after its time"
        for id, steps in sea.history.items():
            if HAS_NOT in steps[-1].words:
                assert sea.rows[id].orders not in flown, f"seed {seed}: {id} was flown"
            assert id not in sea.taken or steps[-1].state != "failed", f"seed {seed}: {id} {steps}"
            seen[steps[-1].state] += 1
    assert {"aboard", "replaced", "superseded", "cancelled", "expired"} <= seen.keys(), seen
