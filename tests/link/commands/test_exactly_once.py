"""Commands over half a link, with copies, other orders, outages, and power cuts of both ends anywhere in their disks.

Oracle: the vehicle's list of what it has begun. Ten thousand seeds: COMMAND_SEEDS=10000 pytest with this file.
"""

import os
from collections import Counter

from stommel.link.commands.states import State
from tests.link.commands.rough_sea import Voyage

SEEDS = int(os.environ.get("COMMAND_SEEDS", "80"))


def test_each_command_is_executed_once_or_reported_as_not_executed() -> None:
    """mavlink/qgroundcontrol#9104, #8334: never twice, never after its expiry, never a false success."""
    found: dict[int, list[str]] = {}
    claims: Counter[State] = Counter()
    kills = 0
    for seed in range(SEEDS):
        voyage = Voyage(seed)
        voyage.run()
        if problems := voyage.problems():
            found[seed] = problems
        claims.update(voyage.claims.values())
        kills += voyage.kills
    assert found == {}
    # the run is rough enough to mean something
    assert kills > SEEDS
    assert min(claims[state] for state in State if state.is_last) > 0
