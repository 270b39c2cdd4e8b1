"""The page of plans. Oracle: its example, checked and flown as it stands."""

import json
import re
from pathlib import Path

from stommel.plans.fields import plan_fields
from stommel.plans.plan import StationPlan, Water
from stommel.plans.preview.flight import previewed
from stommel.plans.preview.ordering import ordered
from stommel.plans.problems import plan_from

PAGE = (Path(__file__).parents[2] / "docs/guide/station/planner.md").read_text(encoding="utf-8")


def test_the_example_can_be_flown() -> None:
    (text,) = re.findall(r"```json\n(.*?)```", PAGE, re.S)
    plan = plan_from(json.loads(text))
    found = ordered(plan)
    assert (found.problems, found.orders is not None) == ((), True)
    assert previewed(plan)["dive_count"] > 10


def test_every_table_of_a_plan_is_named() -> None:
    own = {name for name in StationPlan.model_fields if not name.endswith("_control")} - {"format"}
    assert {name for name in own if f"`{name}" not in PAGE} == set()
    assert {f"`{choice}`" in PAGE for choice in ("ocean", "still", "given", "last_dive")} == {True}
    assert {field.key for field in plan_fields() if field.key.startswith("water.")} == {
        f"water.{name}" for name in Water.model_fields
    }
