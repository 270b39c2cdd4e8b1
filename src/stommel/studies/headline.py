"""Which outputs are shown where there is no room for all, and what they are called in words."""

from collections.abc import Iterable

from stommel.files.units import UNITS, unit_of
from stommel.studies.study import Study

_HEADLINE = (
    "waypoints_reached", "waypoint_distance_m", "days", "dives", "distance_made_good_km", "mean_power_w",
    "battery_left_share", "reckoning_error_m_greatest",
)  # fmt: skip
"""Answers to what a pilot asks first."""


def shown_outputs(study: Study, known: Iterable[str]) -> list[str]:
    """Return the study's own `outputs`, or the headline of those that are `known`."""
    listed = list(known)
    return [name for name in (study.file.outputs or _HEADLINE) if name in listed]


def told_selection(study: Study, shown: int, known: int) -> list[str]:
    """One note that says how many of the outputs are shown and how to choose others; none where all are."""
    if shown >= known:
        return []
    how = "--json has all" if study.file.outputs else "outputs = [...] in the study chooses, --json has all"
    return [f"{shown} of {known} outputs are shown; {how}"]


def in_words(name: str) -> tuple[str, str]:
    """Words and unit of an output or parameter; the unit is empty where the name tells none.

    The unit of a table in the summary stands within: energy_wh_pump is "energy pump" in W h.
    """
    parts = name.split("_")
    # the longest unit counts, wherever it stands, and never the whole name
    for count in range(len(parts) - 1, 0, -1):
        for first in range(1, len(parts) - count + 1):
            key = "_".join(parts[first : first + count])
            if key in UNITS and unit_of("_".join(parts[: first + count])) == UNITS[key]:
                return " ".join(parts[:first] + parts[first + count :]), UNITS[key]
    return " ".join(parts), ""
