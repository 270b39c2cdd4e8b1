"""Bits of GLIDER_ALARM. Oracle: their order as it was first given; who listens ashore may be older than the vehicle."""

from stommel.messages.mavlink import entry_words
from stommel.onboard.coordination.failsafes import FAILSAFES

BITS = (
    "leak", "leak, sinking on", "leak in both bays", "too deep", "too deep, sinking on", "deeper than the hull rating",
    "sinking on", "bottom", "bottom, sinking on", "no rise", "no rise, last resort", "does not sink", "no surfacing",
    "no surfacing, still under water", "mission expired", "low battery", "low voltage", "voltage nearly gone",
    "over-current of the battery", "over-current of a motor", "pump stuck", "valve stuck", "moving mass stuck",
    "steering stuck", "limit switch", "weight released", "silent motion node", "silent acquisition node",
    "node of another version", "unknown node", "silent pressure sensor", "pressure sensor stuck", "blind, last resort",
    "silent compass", "silent GPS", "silent CTD", "silent altimeter", "silent leak detector", "silent hull pressure",
    "silent battery gauge", "silent displacement sensor", "silent mass position", "silent steering angle",
    "hull pressure of the mission", "vacuum loss", "hull flooding", "software exception",
    "software exceptions in a row", "node restarted", "log not written", "unproven safety input", "radio key",
)  # fmt: skip
"""What each bit means, from the lowest on: new ones are put at the end, none is ever taken out."""


def test_a_bit_keeps_its_meaning() -> None:
    assert entry_words("GLIDER_ALARM") == {1 << k: words for k, words in enumerate(BITS)}


def test_every_failsafe_has_a_bit() -> None:
    assert {row.name for row in FAILSAFES} == set(BITS)
