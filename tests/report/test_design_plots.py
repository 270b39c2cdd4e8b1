"""Plots of hull, drives, engine, budget and endurance, read back: each artist holds what its label and title name.

The oracle is the study's own `as_json`, which the tests of each room hold against closed forms and the paper.
"""

from math import degrees
from typing import Any

import numpy as np
import pytest

from stommel.design.budget.figure import budget_figure
from stommel.design.drives.figure import drives_figure
from stommel.design.endurance.figure import endurance_figure
from stommel.design.engine.engine_plot import engine_figure
from stommel.design.hull.plot import hull_figure
from stommel.design.study import DesignStudy
from stommel.machinery.engine import engine_of, simulate
from stommel.report.plots import envelope_figure, turns_figure


def titled(figure: Any, begin: str) -> Any:
    (axes,) = (axes for axes in figure.axes if axes.get_title(loc="left").startswith(begin))
    return axes


def curve(axes: Any, label: str) -> tuple[np.ndarray, np.ndarray]:
    (line,) = (line for line in axes.get_lines() if line.get_label() == label)
    return np.asarray(line.get_xdata(), float), np.asarray(line.get_ydata(), float)


def at(axes: Any, label: str, x: float) -> float:
    """Height of a curve [of its axis] at x, between its points."""
    xs, ys = curve(axes, label)
    return float(np.interp(x, xs, ys))


def bars(axes: Any) -> dict[str, float]:
    """Widths of lying bars by their names."""
    names = [label.get_text() for label in axes.get_yticklabels()]
    return dict(zip(names, (patch.get_width() for patch in axes.patches), strict=False))


def texts(axes: Any) -> str:
    return " | ".join(text.get_text() for text in axes.texts)


def test_hull_draws_each_criterion_at_the_wall_and_each_mass(zju: DesignStudy) -> None:
    assert zju.hull is not None
    told = zju.hull.as_json()
    figure, own = hull_figure(zju.hull), told["own"]
    left, right = figure.axes
    assert left.get_title(loc="left") == "TC4: what a wall stands"
    assert (left.get_xlabel(), left.get_yscale()) == ("Wall [mm]", "log")
    assert left.get_ylabel() == "Pressure at which it is reached [MPa]"
    drawn = {line.get_label().replace("é", "e") for line in left.get_lines()}
    shown = [row for row in own["criteria"] if row["name"] in drawn]
    assert len(shown) >= 6
    for row in shown:
        xs, ys = curve(left, row["name"].replace("Lame", "Lamé"))
        known = np.isfinite(ys)
        # straight in logarithms, nearly, between points of 1 %
        found = np.exp(np.interp(np.log(own["wall_mm"]), np.log(xs[known]), np.log(ys[known])))
        assert found == pytest.approx(row["collapse_pressure_mpa"], rel=2e-3), row["name"]
        assert np.all(np.diff(ys[known]) > 0.0)
    (dot,) = (line for line in left.get_lines() if line.get_marker() == "o")
    assert dot.get_xdata()[0] == pytest.approx(own["wall_mm"])
    assert dot.get_ydata()[0] == pytest.approx(own["collapse_pressure_mpa"])
    assert f"4.2 mm: {own['collapse_pressure_mpa']:.3g} MPa, {own['collapse_depth_m']:.0f} m" in texts(left)
    ranked = sorted(told["materials"], key=lambda row: row["rank"])
    assert bars(right) == pytest.approx({f"{row['rank']}  {row['name']}": row["mass_kg"] for row in ranked})
    for patch, row in zip(right.patches, ranked[::-1], strict=True):
        words = f"{row['mass_kg']:.1f} kg, {row['wall_mm']:.1f} mm" + ("" if row["fits"] else ", no room")
        assert words in texts(right)
        assert (patch.get_facecolor() == right.patches[-1].get_facecolor()) is row["fits"]
    assert right.get_xlabel() == "Mass of the tube [kg]"


def test_drives_draws_each_way_by_its_name(zju: DesignStudy) -> None:
    assert zju.drives is not None
    told = zju.drives.as_json()
    figure = drives_figure(zju.drives)
    for title, key in (
        ("Speed of the mass [mm/s]", "speed_mm_s"), ("Torque at the motor [mN m]", "torque_mn_m"),
        ("Energy per millimetre [J/mm]", "energy_j_per_mm"),
    ):  # fmt: skip
        axes = titled(figure, title)
        assert axes.get_xlabel() == "Pitch [deg]"
        for row in told["pitch"]["points"]:
            found = at(axes, f"mass moves {row['direction']}", row["pitch_deg"])
            assert found == pytest.approx(row[key], rel=5e-3, abs=5e-3 * abs(row[key])), (title, row["pitch_deg"])
    start = told["pitch"]["hardest_start"]
    (dot,) = (line for line in titled(figure, "Torque").get_lines() if line.get_marker() == "o")
    assert dot.get_xdata()[0] == pytest.approx(start["pitch_deg"])
    assert dot.get_ydata()[0] == pytest.approx(start["starting_torque_mn_m"])
    low, high = titled(figure, "Torque").get_ylim()
    assert low <= start["starting_torque_mn_m"] <= high
    hinge = titled(figure, "Hinge moment of the rudder [mN m]")
    V, most = told["rudder"]["speed_through_water_m_s"], told["rudder"]["hinge_moment_mn_m"]
    for share in (1.0, 0.75, 0.5):
        x, y = curve(hinge, f"{share * V:.3g} m/s")
        assert (x[0], x[-1]) == pytest.approx((0.0, 60.0))
        assert np.abs(y).max() == pytest.approx(share**2 * most, rel=1e-3)  # dynamic pressure
    speed = titled(figure, "Speed of the mass")
    (line,) = (line for line in speed.get_lines() if line.get_label().startswith("vehicle file"))
    assert line.get_ydata()[0] == pytest.approx(told["pitch"]["file_speed_mm_s"])


def test_engine_draws_each_course_in_its_panel(zju: DesignStudy) -> None:
    run = simulate(engine_of(zju.vehicle).engine, pressure_pa=1e6, inflate_m3=1e-4, deflate_m3=5e-5, hold_s=6.0,
                   motor_speed_rpm=None, ideal=False, name="a vehicle")  # fmt: skip
    figure, courses = engine_figure(run), run.as_json()["courses"]
    panels = {
        "Piston [mm]": courses["piston_mm"],
        "Flow into the bladder [ml/s]": courses["flow_ml_s"],
        "Power from the supply [W]": courses["power_w"],
        "Current of the motor [A]": courses["current_a"],
        "Voltage of the motor [V]": courses["voltage_v"],
    }
    for title, expected in panels.items():
        (line,) = titled(figure, title).get_lines()
        found = np.interp(courses["t_s"], line.get_xdata(), line.get_ydata())
        np.testing.assert_allclose(found, expected, atol=1e-6 * max(map(abs, expected)), err_msg=title)
    pressure = titled(figure, "Pressure [MPa, gauge]")
    nodes = run.courses.pressure_mpa
    assert 1 <= len(pressure.get_lines()) <= len(nodes)
    for line in pressure.get_lines():
        first = line.get_label().split(" = ")[0]
        (name,) = (node for node in nodes if node.split(" - ")[0].replace(".", " ").replace("_", " ") == first)
        np.testing.assert_array_equal(line.get_ydata(), nodes[name])
    words = texts(titled(figure, "Piston"))
    for phase in run.phases:
        assert f"{phase.name}\n{round(phase.duration_s, 1):g} s" in words
    for axes in figure.axes:  # every second phase is shaded, from its begin to its end
        (shaded,) = axes.patches
        hold = run.phases[1]
        assert (shaded.get_x(), shaded.get_width()) == pytest.approx((hold.begin_s, hold.duration_s))
    assert figure.get_suptitle() == "a vehicle: buoyancy engine at 1 MPa"


def test_budget_stacks_to_all_the_mass_and_volume(zju: DesignStudy) -> None:
    assert zju.budget is not None
    figure, told = budget_figure(zju.budget), zju.budget.as_json()
    masses, volumes, side = figure.axes
    parts = zju.vehicle.description.parts
    heights = {bar.get_label(): sum(patch.get_height() for patch in bar) for bar in masses.containers}
    assert heights == pytest.approx({
        "rigid body": told["rigid_body"]["mass_kg"], "moving mass, at neutral": told["moving_mass_kg"],
        "ballast system": told["ballast_kg"],
    })  # fmt: skip
    (volume,) = volumes.containers
    assert sum(patch.get_height() for patch in volume) == pytest.approx(told["displaced_volume_ml"] / 1e3)
    # centres of both, from the slices: within half a slice
    for containers, centre in ((masses.containers, told["centre_of_mass_m"][0]),
                               (volumes.containers, told["centre_of_buoyancy_m"][0])):  # fmt: skip
        slices = [(one.get_x() + 0.5 * one.get_width(), one.get_height()) for bar in containers for one in bar]
        x, amount = (np.array(column) for column in zip(*slices, strict=True))
        assert (x * amount).sum() / amount.sum() == pytest.approx(centre, abs=2e-3)
    tops: dict[float, float] = {}
    for bar in masses.containers:
        for patch in bar:
            assert patch.get_y() == pytest.approx(tops.get(round(patch.get_x(), 4), 0.0))
            tops[round(patch.get_x(), 4)] = patch.get_y() + patch.get_height()
    for group in side.collections:
        kinds = {"rigid body": lambda p: not (p.moving or p.ballast), "moving mass, at neutral": lambda p: p.moving,
                 "ballast system": lambda p: p.ballast}  # fmt: skip
        chosen = [part for part in parts if kinds[group.get_label()](part)]
        np.testing.assert_allclose(
            group.get_offsets(), [(p.position_m[0], -100.0 * p.position_m[2]) for p in chosen], atol=1e-12
        )
        np.testing.assert_allclose(group.get_sizes(), [40.0 * part.mass_kg for part in chosen])
    (buoyancy,) = (line for line in side.get_lines() if line.get_label() == "centre of buoyancy")
    (mass,) = (line for line in side.get_lines() if line.get_label().startswith("centre of mass"))
    drop = float(buoyancy.get_ydata()[0] - mass.get_ydata()[0])
    assert 10.0 * drop == pytest.approx(told["stability_arm_mm"])
    assert f"{told['stability_arm_mm']:.1f} mm lower" in mass.get_label()
    assert mass.get_xdata()[0] == pytest.approx(told["centre_of_mass_m"][0])


def test_endurance_draws_parts_tornado_and_best_dives(zju: DesignStudy) -> None:
    assert zju.energy is not None
    figure, told = endurance_figure(zju.energy), zju.energy.as_json()
    energies = {name: joules for name, joules in told["energy_per_dive_j"].items() if joules > 0.0}
    parts = titled(figure, "A dive to 200 m")
    assert bars(parts) == pytest.approx(energies)
    assert list(bars(parts).values()) == sorted(energies.values())
    total = sum(energies.values())
    assert f"{total / 1e3:.2f} kJ" in parts.get_title(loc="left")
    for joules in energies.values():
        assert f"{joules:.0f} J, {100.0 * joules / total:.1f} %" in texts(parts)
    tornado = titled(figure, f"What {told['endurance_days']:.1f} days rest on")
    ends: dict[int, set[float]] = {}
    for patch in tornado.patches:
        end = patch.get_x() + patch.get_width()
        away = end if abs(patch.get_x() - told["endurance_days"]) < 1e-9 else patch.get_x()
        ends.setdefault(round(patch.get_y() + 0.5 * patch.get_height()), set()).add(round(float(away), 6))
    labels = [label.get_text() for label in tornado.get_yticklabels()]
    spans = [row for row in told["sensitivity"]
             if row["endurance_days_at_low"] != row["endurance_days_at_high"]][: len(labels)][::-1]  # fmt: skip
    for k, row in enumerate(spans):
        assert " ".join(row["what"].split()) in " ".join(labels[k].split())
        expected = {round(row[key], 6) for key in ("endurance_days_at_low", "endurance_days_at_high") if row[key]}
        assert ends[k] == expected, row["what"]


def test_endurance_marks_this_dive_and_the_best_ones(zju: DesignStudy) -> None:
    assert zju.energy is not None
    figure, told = endurance_figure(zju.energy), zju.energy.as_json()
    marks = {
        "this dive": (told["speed_m_s"], told["endurance_days"], told["range_km"]),
        **{
            label: (found["speed_m_s"], found["endurance_days"], found["range_km"])
            for label, found in (("longest", told["best_for_endurance"]), ("farthest", told["best_for_range"]))
        },
    }
    for column, title in ((1, "Endurance of dives"), (2, "Range of dives")):
        axes = titled(figure, title)
        for label, values in marks.items():
            x, y = curve(axes, label)
            assert (x[0], y[0]) == pytest.approx((values[0], values[column])), (title, label)
        # this dive lies on the curve of its pitch
        found = at(axes, "pitch −35°", told["speed_m_s"])
        assert found == pytest.approx(marks["this dive"][column], rel=5e-3)
        assert axes.get_xlabel() == "Speed along the path [m/s]"
    level = [line for line in titled(figure, "Endurance of dives").get_lines() if list(line.get_xdata()) == [0, 1]]
    assert [list(line.get_ydata()) for line in level] == [[20.0, 20.0]]
    assert "specification: 20 days" in texts(titled(figure, "Endurance of dives"))


def test_envelope_fills_from_slowest_to_fastest(zju: DesignStudy) -> None:
    axes = envelope_figure(zju).axes[0]
    for label, side in (("dives", -1.0), ("climbs", 1.0)):
        (area,) = (one for one in axes.collections if one.get_label() == label)
        corners = {tuple(np.round(corner, 9)) for path in area.get_paths() for corner in path.vertices}
        for row in zju.envelope or ():
            if row.pitch_deg * side > 0 and row.fastest is not None and row.slowest is not None:
                for flight in (row.slowest, row.fastest):
                    assert (round(flight.V, 9), round(row.pitch_deg, 9)) in corners
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("Speed along the path [m/s]", "Pitch [deg]")


def test_turns_draw_each_angle_in_its_panel(zju: DesignStudy) -> None:
    figure = turns_figure(zju)
    rates = [degrees(flight.turn_rate) for flight in zju.turns]
    panels = {
        "Radius [m]": [flight.horizontal_speed / abs(flight.turn_rate) for flight in zju.turns],
        "Rudder angle [deg]": [degrees(flight.delta_r) for flight in zju.turns],
        "Roll [deg]": [degrees(flight.phi) for flight in zju.turns],
        "Sideslip [deg]": [degrees(flight.beta) for flight in zju.turns],
    }
    for title, expected in panels.items():
        (line,) = titled(figure, title).get_lines()
        np.testing.assert_allclose(line.get_xdata(), rates)
        np.testing.assert_allclose(line.get_ydata(), expected, err_msg=title)
    assert f"{panels['Radius [m]'][-1]:.1f} m" in texts(titled(figure, "Radius"))
