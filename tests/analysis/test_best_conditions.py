"""Best conditions keep to the limits of the vehicle file, or say which they break.

Oracle: a dense table of trims at the same ballast, cut at the limits by hand.
"""

from math import degrees

import numpy as np
import pytest

import stommel
from stommel.analysis import trim_table
from stommel.analysis.limits import excesses
from stommel.vehicle import Vehicle, builtin_text, vehicle_from_text

ZJU = builtin_text("zju")
TRAVEL = next(line for line in ZJU.splitlines() if line.startswith("travel_mm"))


def zju_with(*changes: tuple[str, str]) -> Vehicle:
    text = ZJU
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    return vehicle_from_text(text, "mine.toml")


def short_travel() -> Vehicle:
    """The mass comes forward to 350 mm only: dives end at about -24 deg."""
    return zju_with(("travel_mm = { value = [-50, 550]", "travel_mm = { value = [-50, 350]"))


def test_fastest_flight_stays_within_the_travel() -> None:
    glider = short_travel()
    fastest = stommel.best_conditions(glider, ballast_ml=-250.0).fastest
    assert not excesses(glider, fastest)
    assert fastest.r_px * 1e3 == pytest.approx(350.0, abs=1e-3)
    rows = trim_table(glider, speeds_m_s=np.arange(0.55, 0.85, 0.005), pitches_deg=np.arange(-60.0, -5.0, 0.25))
    within = [row.flight for row in rows if not row.beyond]
    assert fastest.horizontal_speed == pytest.approx(max(flight.horizontal_speed for flight in within), rel=0.01)
    assert max(-degrees(flight.theta) for flight in within) == pytest.approx(-degrees(fastest.theta), abs=1.0)


def test_the_limit_it_lies_at_is_named() -> None:
    best = stommel.best_conditions(short_travel(), ballast_ml=-250.0)
    assert best.fastest_remarks == ("at the end of the moving mass's travel, 350 mm",)
    assert best.glide_remarks == ()
    assert best.as_row()["fastest"]["limits"] == list(best.fastest_remarks)  # type: ignore[index]


def test_the_stall_angle_is_named() -> None:
    """K_D0 / K_D of 2 / 45 asks for 12.1 deg; with a stall from 10 deg the best glide lies there."""
    best = stommel.best_conditions(
        zju_with(("stall_begins_deg = { value = 15", "stall_begins_deg = { value = 10")), ballast_ml=-250.0
    )
    assert degrees(best.best_glide.alpha) == pytest.approx(10.0)
    assert best.glide_remarks == ("at the stall angle, where the model ends",)


def test_where_nothing_is_within_the_limits_the_broken_ones_are_named() -> None:
    """More oil than the engine has."""
    best = stommel.best_conditions(stommel.load_vehicle("zju"), ballast_ml=-400.0)
    for remarks in (best.glide_remarks, best.fastest_remarks):
        assert any("ballast volume of -400.0 ml, but the limits are -250 to 250 ml" in remark for remark in remarks)


def test_limits_that_do_not_bind_change_nothing() -> None:
    free = zju_with(
        (TRAVEL, "travel_mm = [-500, 700]"),
    )
    for merit in ("best_glide", "fastest"):
        found = [
            getattr(stommel.best_conditions(v, ballast_ml=-250.0), merit) for v in (free, stommel.load_vehicle("zju"))
        ]
        assert pytest.approx(found[1].V, rel=1e-9) == found[0].V
