"""The guide's commands run, in their order, and its numbers are what they print."""

import re
from pathlib import Path

import pytest

from tests.support.command import Command
from tests.support.pages import blocks, commands, guide

GUIDE = guide("endurance")


def number(pattern: str) -> float:
    found = re.search(pattern, " ".join(GUIDE.split()))
    assert found is not None, pattern
    return float(found.group(1))


def decided(text: str) -> str:
    """The vehicle file after the decisions of the guide's TOML block, applied as it says."""
    (block,) = blocks(GUIDE, "toml")
    consumer, plan = (part.split("\n", 1)[1] for part in block.split("# in ")[1:])
    text = re.sub(r'^on = "always".*$', consumer.strip(), text, count=1, flags=re.M)
    changed = re.sub(r"^dives_per_surfacing = .*$", plan.strip(), text, flags=re.M)
    assert changed != text
    return changed


def test_commands_and_numbers(stommel: Command, tmp_path: Path) -> None:
    for arguments in commands(GUIDE):
        assert stommel(*arguments).status == 0, arguments
        if arguments[:2] == ["vehicle", "new"]:
            mine = tmp_path / arguments[2]
            mine.write_text(decided(mine.read_text()))
    published = stommel("endurance", "zju", "--json").json
    assert published["endurance_days"] == pytest.approx(number(r"they give \*\*([\d.]+) days"), abs=0.05)
    assert published["gap"]["allowed_power_w"] == pytest.approx(number(r"allow a mean of ([\d.]+) W"), abs=0.005)
    assert published["mean_power_w"] == pytest.approx(number(r"the vehicle takes ([\d.]+) W"), abs=0.005)
    assert published["gap"]["closed_by_favourable_assumptions"] is True
    mine_days = stommel("endurance", "mine.toml", "--json").json["endurance_days"]
    assert mine_days == pytest.approx(number(r"That makes ([\d.]+) days"), abs=0.05)
    slower = stommel("endurance", "mine.toml", "--speed", 0.3, "--json").json
    assert slower["endurance_days"] == pytest.approx(number(r"are met, with ([\d.]+) days"), abs=0.5)
    assert slower["target_met"] is True
