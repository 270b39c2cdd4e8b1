"""Plots show the numbers of the study: artists are read back from the axes and held against it."""

import dataclasses
import logging
import struct
import xml.etree.ElementTree as ET
from math import degrees
from pathlib import Path

import numpy as np
import pytest

from stommel.analysis import RootLocus, root_locus
from stommel.errors import OutputError
from stommel.figures.saving import png_bytes, save_figure, svg_text
from stommel.figures.style import at_least_span
from stommel.report.plots import (
    authority_figure,
    envelope_figure,
    modes_figure,
    root_locus_figure,
    trade_off,
    trim_table_figure,
    turns_figure,
    vehicle_figure,
)
from stommel.vehicle import builtin_names, builtin_text, load_vehicle, vehicle_from_text
from tests.support.python import run_python

NAMES = pytest.mark.parametrize("name", builtin_names())


def lines(figure, gid, axes=0):
    return [line for line in figure.axes[axes].get_lines() if line.get_gid() == gid]


def points(figure, gid, axes=0):
    """Complex points of all lines with this gid."""
    drawn = [line.get_xydata() for line in lines(figure, gid, axes)]
    return np.concatenate([xy[:, 0] + 1j * xy[:, 1] for xy in drawn])


def same(found, expected):
    return np.array_equal(np.sort_complex(np.asarray(found)), np.sort_complex(np.asarray(expected)))


def texts(figure):
    return [t.get_text() for axes in figure.axes for t in axes.texts]


@pytest.fixture(scope="module")
def loci(zju):
    return {locus.over: locus for locus in zju.loci}


@pytest.mark.parametrize(("over", "plane"), [("wing_position", "longitudinal"), ("rudder_position", "lateral")])
def test_a_root_locus_goes_from_circles_to_squares_with_crosses_at_the_design(loci, zju, over, plane):
    locus: RootLocus = loci[over]
    branches = getattr(locus, plane)
    figure = root_locus_figure(locus, modes=zju.modes)
    assert len(figure.axes) == 1
    (start,), (end,), (design,) = (lines(figure, gid) for gid in ("start", "end", "design"))
    assert (start.get_marker(), end.get_marker(), design.get_marker()) == ("o", "s", "x")
    assert same(points(figure, "start"), branches[0])
    assert same(points(figure, "end"), branches[-1])
    assert same(points(figure, "design"), getattr(locus, f"design_{plane}"))
    assert same(points(figure, "branch"), branches.ravel())
    assert set(texts(figure)) >= {mode.name for mode in getattr(zju.modes, plane)}


def test_a_root_locus_draws_the_imaginary_axis_and_says_what_is_varied_and_the_flight(loci):
    figure = root_locus_figure(loci["rudder_position"])
    (axis,) = lines(figure, "imaginary-axis")
    assert list(axis.get_xdata()) == [0.0, 0.0]
    title = figure.get_suptitle()
    assert "from 0.5 to 1" in title
    assert "0.4 m/s" in title
    assert "−35°" in title
    assert "[1/s]" in figure.axes[0].get_xlabel()
    assert "[rad/s]" in figure.axes[0].get_ylabel()


def test_everything_drawn_of_a_root_locus_is_inside_the_axes(loci):
    figure = root_locus_figure(loci["wing_position"])
    (left, right), (low, high) = figure.axes[0].get_xlim(), figure.axes[0].get_ylim()
    z = loci["wing_position"].longitudinal
    assert left < z.real.min()
    assert right > max(z.real.max(), 0.0)
    assert low < z.imag.min()
    assert high > z.imag.max()


def test_any_other_field_shows_both_planes(zju):
    locus = root_locus(zju.vehicle, "moving_mass.mass_kg", 8.0, 12.0, points=5)
    figure = root_locus_figure(locus)
    assert len(figure.axes) == 2
    assert same(points(figure, "start", axes=0), locus.longitudinal[0])
    assert same(points(figure, "start", axes=1), locus.lateral[0])


def test_a_locus_without_the_lateral_plane_shows_the_longitudinal_one():
    locus = root_locus(load_vehicle("rogue"), "moving_mass.mass_kg", 1.5, 2.5, points=3)
    assert len(root_locus_figure(locus).axes) == 1
    shown = root_locus_figure(locus, "lateral")
    assert any("unknown" in text for text in texts(shown))
    png_bytes(authority_figure(locus))


def test_a_locus_whose_design_cannot_fly_has_no_crosses(loci):
    locus = dataclasses.replace(loci["wing_position"], design_longitudinal=None)
    assert lines(root_locus_figure(locus), "design") == []


def test_authority_is_drawn_beside_the_decay_rates(loci, zju):
    locus = loci["rudder_position"]
    figure = authority_figure(locus, modes=zju.modes)
    named = {axes.get_label(): axes for axes in figure.axes}
    decay, authority, against = (named[name] for name in ("decay", "authority", "against"))
    expected = [abs(point.turn_rate_deg_s_per_rudder_deg) for point in locus.authorities]
    (drawn,) = [line for line in authority.get_lines() if line.get_gid() == "authority"]
    assert list(drawn.get_ydata()) == expected
    rates = {line.get_label(): line.get_ydata() for line in decay.get_lines() if line.get_gid() == "decay"}
    assert set(rates) == {"roll oscillation", "yaw subsidence", "spiral"}
    slowest = np.min(-locus.lateral.real, axis=1)
    assert np.array_equal(np.min(list(rates.values()), axis=0), slowest)
    assert len([line for line in against.get_lines() if line.get_gid() == "against"]) == 3
    assert "%" in against.get_xlabel()


def test_the_trade_off_counts_a_conjugate_pair_once(loci, zju):
    trade = trade_off(loci["wing_position"], "longitudinal", zju.modes)
    assert [(d.name, d.oscillatory) for d in trade.decays].count(("short period", True)) == 1
    assert len(trade.decays) == 3


def test_the_modes_drawn_are_those_of_the_study(zju):
    figure = modes_figure(zju)
    assert same(points(figure, "eigenvalues", 0), [mode.eigenvalue for mode in zju.modes.longitudinal])
    assert same(points(figure, "eigenvalues", 1), [mode.eigenvalue for mode in zju.modes.lateral])


def test_an_unknown_lateral_plane_is_said_to_be_unknown(study_of):
    assert any("not known" in text for text in texts(modes_figure(study_of("rogue"))))


def test_the_envelope_marks_fastest_wanted_and_best_flights(zju):
    figure = envelope_figure(zju)
    fast = points(figure, "fastest")
    assert same(fast, [row.fastest.V + 1j * row.pitch_deg for row in zju.envelope if row.fastest])
    wanted = points(figure, "wanted")
    flights = [row.trim.flight for table in zju.tables for row in table.rows]
    assert same(wanted, [flight.V + 1j * degrees(flight.theta) for flight in flights])
    crossed = [line for line in lines(figure, "wanted") if line.get_marker() == "x"]
    assert sum(len(line.get_xdata()) for line in crossed) == 2  # -55 and -60 deg need more travel than there is
    best = [zju.best.best_glide, zju.best.fastest]
    assert same(points(figure, "best"), [flight.V + 1j * degrees(flight.theta) for flight in best])
    assert any("ballast volume" in text for text in texts(figure))
    assert any("moving" in text and "travel" in text for text in texts(figure))


def test_trim_curves_go_through_the_computed_rows_with_published_points(zju):
    table = zju.tables[0]
    figure = trim_table_figure(table)
    (computed,), (published,) = lines(figure, "computed"), lines(figure, "published")
    assert list(computed.get_ydata()) == [row.trim.flight.r_px * 1e3 for row in table.rows]
    assert list(published.get_ydata())[:3] == [272.0, 291.3, 311.5]
    (limit,) = lines(figure, "limit")
    assert limit.get_ydata()[0] == 550.0


def test_turns_show_radius_and_steering(study_of):
    for name, steering in (("zju", "Rudder"), ("seawing", "moving mass")):
        study = study_of(name)
        figure = turns_figure(study)
        assert list(figure.axes[0].get_lines()[0].get_ydata()) == [flight.radius for flight in study.turns]
        assert steering in figure.axes[1].get_title(loc="left")


def test_the_side_view_stands_where_the_file_says(zju):
    figure = vehicle_figure(zju.vehicle)
    axes = figure.axes[0]
    assert axes.get_aspect() == 1.0
    where = {line.get_gid(): (line.get_xdata()[0], line.get_ydata()[0]) for line in axes.get_lines() if line.get_gid()}
    assert where["rigid-body"] == (0.0, -0.05)
    assert where["moving-mass"] == (0.25, 0.0)
    assert where["ballast"] == (-0.5, 0.0)
    assert where["bladder"] == (-0.75, 0.0)
    assert where["wing"] == (-0.225, 0.0)
    assert where["rudder"] == (-1.2, 0.1)
    (travel,) = lines(figure, "travel")
    assert list(travel.get_xdata()) == [-0.05, 0.55]
    assert sum(gid.startswith("bay-") for gid in where) == 5
    (hull,) = [patch for patch in axes.patches if patch.get_gid() == "hull"]
    x = hull.get_xy()[:, 0]
    assert (x.min(), x.max()) == pytest.approx((-1.24, 0.86), abs=1e-12)


def test_bay_names_are_drawn_as_written_or_by_number():
    text = builtin_text("zju").replace('"wet nose"', "'cost $5, $\\frac'").replace('"wet tail"', '"尾部"')
    figure = vehicle_figure(vehicle_from_text(text, "mine.toml"))
    svg_text(figure)
    words = " ".join(" ".join(texts(figure)).split())
    assert "$\\frac" in words
    assert "bay 5" in words


@NAMES
def test_every_plot_of_every_vehicle_can_be_saved(study_of, name, tmp_path):
    study = study_of(name)
    figures = {"vehicle": vehicle_figure(study.vehicle), "turns": turns_figure(study)}
    for stem, figure in figures.items():
        assert save_figure(figure, tmp_path / stem) == [tmp_path / f"{stem}.png", tmp_path / f"{stem}.svg"]
        tree = ET.fromstring((tmp_path / f"{stem}.svg").read_text(encoding="utf-8"))
        ids = [element.get("id") for element in tree.iter() if element.get("id")]
        assert len(ids) == len(set(ids))


def test_png_has_the_size_of_the_figure_at_150_dpi(zju, tmp_path):
    figure = modes_figure(zju)
    path, _ = save_figure(figure, tmp_path / "new folder" / "modes.of.zju")
    data = path.read_bytes()
    assert path.name == "modes.of.zju.png"
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    width, height = struct.unpack(">II", data[16:24])
    assert (width, height) == tuple(int(150 * side) for side in figure.get_size_inches())


def test_the_same_plot_has_the_same_bytes_and_no_date(loci):
    first, second = (root_locus_figure(loci["wing_position"]) for _ in range(2))
    assert svg_text(first) == svg_text(second)
    assert png_bytes(first) == png_bytes(second)
    assert "<dc:date>" not in svg_text(first)


def test_the_users_matplotlibrc_changes_nothing(loci):
    import matplotlib

    plain = svg_text(root_locus_figure(loci["wing_position"]))
    with matplotlib.rc_context({"lines.linewidth": 9.0, "axes.facecolor": "red", "svg.hashsalt": "x"}):
        assert svg_text(root_locus_figure(loci["wing_position"])) == plain
        assert matplotlib.rcParams["lines.linewidth"] == 9.0


def test_no_missing_font(loci, caplog):
    with caplog.at_level(logging.WARNING, logger="matplotlib"):
        svg_text(root_locus_figure(loci["wing_position"]))
    assert not caplog.records


def test_pyplot_is_never_loaded() -> None:
    """In a process of its own: other tests load python-control, which loads pyplot."""
    code = (
        "import sys, stommel; from stommel.figures.saving import svg_text; "
        "from stommel.report.plots import root_locus_figure; "
        "zju = stommel.load_vehicle('zju'); "
        "svg_text(root_locus_figure(stommel.root_locus(zju, 'wing_position', 0, 0.2, points=3))); "
        "sys.exit('matplotlib.pyplot' in sys.modules)"
    )
    run_python("-c", code)


def test_an_unwritable_folder_is_reported_and_nothing_is_left(zju, tmp_path):
    blocked = tmp_path / "file"
    blocked.write_text("in the way")
    with pytest.raises(OutputError, match="cannot be written"):
        save_figure(vehicle_figure(zju.vehicle), blocked / "plot")
    assert [entry.name for entry in tmp_path.iterdir()] == ["file"]
    (tmp_path / "plot.png").mkdir()
    with pytest.raises(OutputError):
        save_figure(vehicle_figure(zju.vehicle), tmp_path / "plot")
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["file", "plot.png"]
    assert list(Path(tmp_path / "plot.png").iterdir()) == []


@pytest.mark.parametrize(
    ("low", "high", "span"), [(0.0, 10.0, 1.0), (3.0, 3.0, 0.5), (-2.0, -1.9, 1.0), (0.0, 1.0, 1.0)]
)
def test_an_axis_holds_all_that_is_drawn_and_is_no_narrower_than_asked(low, high, span):
    first, last = at_least_span(low, high, span)
    assert first < low
    assert last > high
    assert last - first >= span
    assert 0.5 * (first + last) == pytest.approx(0.5 * (low + high))
    assert last - first < 1.3 * max(high - low, span)
