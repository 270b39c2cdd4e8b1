"""The dive cycle as a table and a diagram, both from `stommel.control.dive_cycle.TRANSITIONS`."""

from collections.abc import Iterator

import state_diagram

from stommel.control.dive_cycle import (
    CONDITIONS,
    EVENTS,
    KEPT,
    PHASES,
    THE_ALARM,
    TRANSITIONS,
    Transition,
)

_PLACES = {
    "surface": (0.16, 0.93),
    "recovery": (0.86, 0.93),
    "descent": (0.16, 0.50),
    "drift": (0.16, 0.14),
    "inflection": (0.86, 0.14),
    "ascent": (0.66, 0.60),
}
"""Where each phase stands: the surface above, the depth below."""

_LABELS = {
    ("surface", "recovery"): (0.50, 0.965),
    ("surface", "descent"): (0.16, 0.72),
    ("descent", "inflection"): (0.50, 0.325),
    ("descent", "drift"): (0.16, 0.32),
    ("drift", "inflection"): (0.50, 0.075),
    ("inflection", "ascent"): (0.77, 0.37),
    ("ascent", "descent"): (0.39, 0.548),
    ("ascent", "surface"): (0.42, 0.76),
}
"""Where the words of each way stand."""


def _reason(row: Transition) -> str:
    return {KEPT: "", THE_ALARM: "the alarm"}.get(row.reason) or (EVENTS[row.reason] if row.reason >= 0 else "")


def transition_table() -> Iterator[str]:
    """Lines of the table of transitions, in Markdown."""
    yield "| phase | when | next | reason |\n|---|---|---|---|\n"
    for row in TRANSITIONS:
        stays = row.next == row.phase
        yield f"| {PHASES[row.phase]} | {CONDITIONS[row.condition]} | " + (
            "stays | |\n" if stays else f"{PHASES[row.next]} | {_reason(row)} |\n"
        )


def diagram() -> str:
    """SVG of the phases and the ways between them."""
    ways = [(PHASES[row.phase], PHASES[row.next], CONDITIONS[row.condition]) for row in TRANSITIONS]
    return state_diagram.drawn(_PLACES, _LABELS, sorted(ways, key=lambda way: _order(way[0], way[1])))


def _order(phase: str, then: str) -> tuple[int, int]:
    return PHASES.index(phase), PHASES.index(then)
