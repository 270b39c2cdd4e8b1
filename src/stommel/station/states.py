"""The states of a vehicle as a diagram: the dive cycle, and what stands above it."""

from typing import Any

from stommel.control.dive_cycle import CONDITIONS, PHASES, TRANSITIONS
from stommel.messages.mavlink import entry_words

_LAST_REACTION = "safety or the operator asks for the last reaction"
_UNDER_WATER, _CONTROL_OVER = "it is under water", "control is in recovery"
_CHECKED, _TOO_LONG = "every start check but that of the mission has passed", "the start checks take too long"
_BEGINS_ANEW = "the operator starts a mission, or asks for the start checks"
_CLEARED = "the operator clears, and no alarm that asks for the last reaction is left"
_DIVE_ENDS = "safety or the operator ends the dive, or there is no mission"

EXECUTIVE: tuple[tuple[str, str, str], ...] = (
    ("start-up", _LAST_REACTION, "abort"),
    ("start-up", _UNDER_WATER, "ascend"),
    ("start-up", _CHECKED, "hold"),
    ("start-up", _TOO_LONG, "hold"),
    ("hold", _LAST_REACTION, "abort"),
    ("hold", _UNDER_WATER, "ascend"),
    ("hold", "the operator asks for the start checks", "start-up"),
    ("hold", _CONTROL_OVER, "recover"),
    ("hold", "told to start, mission valid, all proven, no alarm forbids it", "communicate"),
    ("communicate", _LAST_REACTION, "abort"),
    ("communicate", _CONTROL_OVER, "recover"),
    ("communicate", "an alarm, a missing proof or the operator forbids a dive", "hold"),
    ("communicate", "control dives", "mission"),
    ("mission", _LAST_REACTION, "abort"),
    ("mission", _DIVE_ENDS, "ascend"),
    ("mission", _CONTROL_OVER, "recover"),
    ("mission", "control is at the surface", "communicate"),
    ("ascend", _LAST_REACTION, "abort"),
    ("ascend", "it is at the surface", "start-up"),
    ("recover", _LAST_REACTION, "abort"),
    ("recover", _UNDER_WATER, "ascend"),
    ("recover", _BEGINS_ANEW, "start-up"),
    ("abort", _CLEARED, "start-up"),
)
"""State, condition and next state: the executive of `stommel.onboard`, which the station does not import; a test holds
both together."""


def state_machine() -> dict[str, Any]:
    """Return states and transitions of the executive, and phases and transitions of the dive cycle below `mission`."""
    return {
        "states": list(entry_words("GLIDER_EXECUTIVE").values()),
        "transitions": [[state, following, words] for state, words, following in EXECUTIVE],
        "phases": list(PHASES),
        "phase_transitions": [
            [PHASES[row.phase], PHASES[row.next], CONDITIONS[row.condition]]
            for row in TRANSITIONS
            if row.phase != row.next
        ],
    }
