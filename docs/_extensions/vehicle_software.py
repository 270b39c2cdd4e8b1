"""The executive as a table and a diagram, failsafes and start checks as tables, all from the tables that fly."""

from collections.abc import Iterator

import state_diagram

from stommel.onboard.coordination.executive import STATE_WORDS, TRANSITIONS, State
from stommel.onboard.coordination.failsafes import FAILSAFES, REACTION_WORDS, Cleared, Failsafe, Reaction
from stommel.onboard.coordination.health import CONDITION_WORDS
from stommel.onboard.coordination.start_checks import START_CHECKS

_PLACES = {
    "start-up": (0.12, 0.86),
    "hold": (0.50, 0.86),
    "recover": (0.88, 0.86),
    "communicate": (0.50, 0.55),
    "mission": (0.50, 0.20),
    "ascend": (0.12, 0.34),
    "abort": (0.88, 0.10),
}
"""Where each state stands: the surface above, the depth below."""

_LABELS = {
    ("start-up", "hold"): (0.30, 0.92),
    ("hold", "recover"): (0.69, 0.885),
    ("hold", "communicate"): (0.38, 0.71),
    ("communicate", "hold"): (0.61, 0.74),
    ("communicate", "recover"): (0.75, 0.68),
    ("communicate", "mission"): (0.42, 0.38),
    ("mission", "communicate"): (0.59, 0.44),
    ("mission", "recover"): (0.75, 0.50),
    ("mission", "ascend"): (0.29, 0.23),
    ("start-up", "ascend"): (0.06, 0.60),
    ("ascend", "start-up"): (0.20, 0.60),
    ("mission", "abort"): (0.69, 0.11),
}
"""Where the words of each way stand."""

_QUIET = {("recover", "start-up"), ("hold", "start-up"), ("abort", "start-up")}
"""Ways by the operator alone: in the table, not in the picture."""


def executive_table() -> Iterator[str]:
    """Lines of the table of transitions, in Markdown."""
    yield "| state | what it is |\n|---|---|\n"
    for state in State:
        yield f"| {state.value} | {STATE_WORDS[state]} |\n"
    yield "\n| state | when | next |\n|---|---|---|\n"
    for row in TRANSITIONS:
        yield f"| {row.state.value} | {row.condition.words} | {row.next.value} |\n"


def executive_diagram() -> str:
    """SVG of the states and the ways between them; every state but abort leads to abort, drawn once."""
    ways = [
        (row.state.value, row.next.value, row.condition.words)
        for row in TRANSITIONS
        if (row.next is not State.ABORT or row.state is State.MISSION)
        and (row.state.value, row.next.value) not in _QUIET
        and not (row.next is State.ASCEND and row.state in (State.HOLD, State.RECOVER))
    ]
    return state_diagram.drawn(_PLACES, _LABELS, ways, width=22)


def _over(row: Failsafe) -> str:
    if row.cleared_by is Cleared.SELF and row.clear_after:
        return f"{row.cleared_by.value} after {row.clear_after:g} s"
    return row.cleared_by.value


def failsafe_table() -> Iterator[str]:
    """Lines of the table of failsafes, in Markdown."""
    yield "| reaction | what the vehicle does; each includes those before it |\n|---|---|\n"
    for reaction in Reaction:
        if reaction:
            yield f"| {reaction.name.lower().replace('_', ' ')} | {REACTION_WORDS[reaction]} |\n"
    yield "\n| failsafe | detected | by | for | reaction | over | to do |\n|---|---|---|---|---|---|---|\n"
    for row in FAILSAFES:
        reaction = row.reaction.name.lower().replace("_", " ")
        holds = f"{row.debounce:g} s" if row.debounce else "at once"
        yield f"| {row.name} | {row.words} | {row.detected_by} | {holds} | {reaction} | {_over(row)} |"
        yield f" {row.what_to_do} |\n"


def start_check_table() -> Iterator[str]:
    """Lines of the table of start checks, in Markdown."""
    yield "| check | passed when it | holds | if not |\n|---|---|---|---|\n"
    for check in START_CHECKS:
        lasts = "once, until the checks are done again" if check.lasts else "at every decision"
        yield f"| {check.name} | {check.words} | {lasts} | {check.what_to_do} |\n"


def condition_table() -> Iterator[str]:
    """Lines of the table of conditions of a node or instrument, in Markdown."""
    yield "| condition | what it says |\n|---|---|\n"
    for condition, words in CONDITION_WORDS.items():
        yield f"| {condition.value} | {words} |\n"
