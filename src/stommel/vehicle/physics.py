"""Switches between the paper's model and a real glider (docs/theory/vehicle)."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Physics:
    """Which effects beyond Eqs. (1)-(7) act. Each needs its numbers in the vehicle file; without them it stays off."""

    bladder: bool
    """The ballast volume displaces water at the bladder, and the oil's own mass moves there from the reservoir."""
    hull_elasticity: bool
    """The hull yields to pressure and temperature."""
    large_angles: bool
    """Forces stay bounded beyond stall, up to 180 degrees."""


PAPER = Physics(bladder=False, hull_elasticity=False, large_angles=False)
"""The model of Fan et al. (2013): its coefficients for `zju` were recovered from Tables 1 and 2."""

FULL = Physics(bladder=True, hull_elasticity=True, large_angles=True)
"""Everything that the vehicle file gives numbers for."""

PHYSICS: dict[str, Physics] = {"paper": PAPER, "full": FULL}
