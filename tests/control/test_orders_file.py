"""Orders as a file: the same bits come back, only for the file's own vehicle, and nothing impossible is taken."""

from dataclasses import replace
from math import inf, isnan, nan
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from typer.testing import CliRunner

from stommel.cli.app import app
from stommel.control.orders import Orders
from stommel.control.orders_file import OrdersHeader, orders_text, parse_orders, read_orders, write_orders
from stommel.errors import FileError
from stommel.simulation.scenario.loading import load_mission
from stommel.simulation.scenario.shipped import mission_path
from stommel.simulation.setup import prepare
from tests.support.orders import ORDERS

SMALL, HEADER = parse_orders(ORDERS, "orders.toml")


def bits(value: Any) -> Any:
    """A value down to its bits and its place in the tuple."""
    if isinstance(value, tuple):
        return {name: bits(inner) for name, inner in zip(type(value)._fields, value, strict=True)}  # type: ignore[attr-defined]
    array = np.asarray(value)
    return array.dtype.str, array.shape, array.tobytes()


def test_a_mission_is_told_to_the_last_bit_as_the_simulator_flies_it(tmp_path: Path) -> None:
    """Oracle: the orders that the mission loop is given, byte by byte; so what it flies by them is the same."""
    path = tmp_path / "orders.toml"
    done = CliRunner().invoke(app, ["orders", "pool_trial", "--output", str(path), "--json"])
    assert done.exit_code == 0, done.output
    told, header = read_orders(path)
    mission = load_mission(mission_path("pool_trial"))
    assert bits(told) == bits(prepare(mission).orders)
    assert (header.mission, header.created_from) == ("Pool trial", "pool_trial.toml")
    assert header.expires_hours == mission.scenario.duration_days * 24.0


@given(
    theta=st.floats(0.05, 1.2),
    ballast=st.floats(1e-9, 0.1),
    place=st.tuples(st.floats(-1.571, 1.571), st.floats(-3.142, 3.142)),
    energy=st.floats(0, 1e12) | st.just(inf),
    interval=st.floats(1, 6e7) | st.just(inf),
    raised=st.floats(-5, 5) | st.just(nan),
    expires=st.floats(0.01, 17520) | st.none(),
)
def test_every_number_comes_back_to_the_last_bit(
    theta: float, ballast: float, place: tuple[float, float], energy: float, interval: float, raised: float,
    expires: float | None,
) -> None:  # fmt: skip
    dives = SMALL.dives._replace(
        theta=theta, V_b_dive=-ballast, surfacing_interval=interval, r_px_surface=raised, dives_per_surfacing=3.0
    )
    orders = SMALL._replace(
        dives=dives, waypoints=np.array([place]), alarms=SMALL.alarms._replace(energy=energy, leak=False)
    )
    header = replace(HEADER, expires_hours=expires, sample_every_s=None if expires is None else 0.1 + abs(theta))
    found, found_header = parse_orders(orders_text(orders, header), "orders.toml")
    assert found_header == header
    if isnan(raised):
        assert isnan(found.dives.r_px_surface)
        found = found._replace(dives=found.dives._replace(r_px_surface=nan))
    assert bits(found) == bits(orders)


def test_no_waypoints_and_no_alarms() -> None:
    orders = SMALL._replace(waypoints=np.empty((0, 2)), sampled=np.zeros(6))
    assert bits(parse_orders(orders_text(orders, HEADER), "o")[0].waypoints) == bits(orders.waypoints)
    text = ORDERS.replace("energy_j = 3e6", "")
    assert parse_orders(text, "o")[0].alarms == (inf, True, inf)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("format = 1", "format = 2", "format = 2: must be 1"),
        ('kind = "orders"', 'kind = "plan"', "kind"),
        ("[alarms]", "[alarms]\nleaks = true", "alarms.leaks: unknown key"),
        ("depth_m = 100.0", "depth_m = 99999", "dives.depth_m = 99999: must be between 0.5 and 12000 m"),
        ("depth_m = 100.0", "depth_m = nan", "dives.depth_m"),
        ("pitch_rad = 0.6\n", "pitch_rad = 34\n", "dives.pitch_rad = 34: must be between 0.05 and 1.2 rad"),
        ("ballast_dive_m3 = -1e-4", "ballast_dive_m3 = 0.01", "dives: ballast_climb_m3 = 0.0002: must not be less"),
        ("longest_surface_s = 1800.0", "longest_surface_s = 20", "longest_surface_s = 20: must not be less"),
        ("energy_j = 3e6", "energy_j = inf", "alarms.energy_j"),
        ("pitch_rad = [0.3, 0.6]", "pitch_rad = [0.6, 0.3]", "flight_table: pitch_rad: must rise in even steps"),
        ("ballast_m3 = [1e-4, 2e-4]", "ballast_m3 = [1e-4, 2e-4, 3e-4]", "must be 2 rows of 3 numbers"),
        ("[0.52, 2.09]", "[30.0, 2.09]", "waypoints_rad.0.0 = 30"),
        ("expires_hours = 48.0", "expires_hours = 0", "expires_hours = 0: must be between 0.01 and 17520 h"),
        ("step_s = 1.0", "", "step_s"),
        (
            "step_s = 1.0",
            "step_s = 1.0\nsample_every_s = 4e3",
            "sample_every_s = 4000.0: must be between 0.1 and 3600",
        ),
    ],
)
def test_impossible_orders_are_refused(tmp_path: Path, old: str, new: str, words: str) -> None:
    path = tmp_path / "orders.toml"
    assert old in ORDERS
    path.write_text(ORDERS.replace(old, new, 1))
    with pytest.raises(FileError, match=r"orders\.toml: ") as refused:
        read_orders(path)
    assert words in str(refused.value)


def test_orders_for_another_vehicle_are_refused() -> None:
    with pytest.raises(FileError, match=r"vehicle_sha256 = 000000000000\.\.\.: the orders are for another vehicle"):
        parse_orders(ORDERS, "orders.toml", "1" * 64)
    assert parse_orders(ORDERS, "orders.toml", "0" * 64)[1] == HEADER


def test_what_could_not_be_read_is_not_written(tmp_path: Path) -> None:
    path, header = tmp_path / "orders.toml", OrdersHeader(**vars(HEADER))
    wrong: Orders = SMALL._replace(lookahead=0.0)
    with pytest.raises(FileError, match=r"lookahead_m = 0\.0: must be between 5"):
        write_orders(path, wrong, header)
    assert not path.exists()
