"""What a picture of an ocean shows is what the ocean answers."""

from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.quiver import Quiver

from stommel.ocean import BelowBottomError, LandError, Ocean, OutsideOceanError
from stommel.ocean.pictures.drawing import Layer, draw_ocean, layer_of

FIRST_DAY = 1454328000.0


def drawn(ocean: Ocean, time: float, depth: float, place: tuple[float, float] | None = None) -> Figure:
    figure = Figure(figsize=(11.0, 6.0), layout="constrained")
    draw_ocean(figure, ocean, time, depth, place)
    figure.canvas.draw()
    return figure


def labels(figure: Figure) -> str:
    return " ".join(
        text.get_text() for axes in figure.axes for text in (axes.title, axes.xaxis.label, axes.yaxis.label)
    )


def test_the_layer_of_a_map_is_what_the_ocean_answers(arctic20: Path) -> None:
    ocean = Ocean.open(arctic20)
    layer = layer_of(ocean, FIRST_DAY, 50.0)
    assert np.isnan(layer.temperature).any()
    for j, i in np.argwhere(np.isfinite(layer.temperature))[::400]:
        sample = ocean.at(FIRST_DAY, layer.latitude[j, i], layer.longitude[j, i], 50.0)
        assert layer.temperature[j, i] == pytest.approx(sample.temperature, abs=1e-9)
        assert (layer.east[j, i], layer.north[j, i]) == pytest.approx((sample.current_east, sample.current_north))
    dry = np.argwhere(np.isnan(layer.temperature))
    for j, i in dry[:: len(dry) // 10]:
        with pytest.raises((LandError, BelowBottomError)):
            ocean.at(FIRST_DAY, layer.latitude[j, i], layer.longitude[j, i], 50.0)


def test_a_large_grid_is_thinned(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("stommel.ocean.pictures.drawing._MOST_NODES", 50)
    layer = layer_of(Ocean.analytic("gyre"), 0.0, 0.0)
    assert layer.temperature.shape == (41, 41)
    assert np.ptp(layer.x) == pytest.approx(400.0, rel=2e-3)  # in the plane


def test_colours_are_of_what_varies(arctic20: Path) -> None:
    assert "Speed of the current" in labels(drawn(Ocean.analytic("gyre"), 0.0, 0.0))
    figure = drawn(Ocean.open(arctic20), FIRST_DAY, 50.0, (72.0, 10.0))
    assert "Temperature in situ" in figure.axes[1].yaxis.label.get_text()
    assert "50 m deep, 2016-02-01T12:00:00Z" in labels(figure)
    assert "72.00°N 10.00°E" in labels(figure)


def test_a_bottomless_column_shows_where_the_water_changes() -> None:
    for name, deepest in (("two_layer", 200.0), ("shear", 500.0), ("still", 200.0), ("pool", 3.5)):
        low, high = drawn(Ocean.analytic(name), 0.0, 0.0).axes[0].get_ylim()
        assert (high, low) == pytest.approx((0.0, low))
        assert low <= deepest


def test_a_column_is_drawn_of_the_ocean_s_own_answers() -> None:
    ocean = Ocean.analytic("two_layer", lower_east_m_s=0.2)
    figure = drawn(ocean, 0.0, 0.0)
    (line,) = figure.axes[0].lines
    for temperature, depth in zip(*line.get_data(), strict=True):
        assert temperature == pytest.approx(ocean.at(0.0, 30.0, 125.0, float(depth)).temperature, abs=2e-3)
    east, north = (line.get_xdata()[-1] for line in figure.axes[3].lines)
    assert (east, north) == pytest.approx((0.2, 0.0), abs=2e-5)  # the tail of the tangent


def test_nothing_is_drawn_of_what_is_not_there(arctic20: Path) -> None:
    ocean = Ocean.open(arctic20)
    with pytest.raises(OutsideOceanError):
        drawn(ocean, 0.0, 0.0)
    with pytest.raises(LandError):
        drawn(ocean, FIRST_DAY, 0.0, (78.5, 17.0))
    with pytest.raises(BelowBottomError, match="its deepest bottom"):
        drawn(ocean, FIRST_DAY, 6000.0)


def test_tides_say_when(arctic20: Path) -> None:
    assert "1970-01-01T00:00:00Z" in labels(drawn(Ocean.analytic("east_china_sea"), 0.0, 0.0))
    assert "1970" not in labels(drawn(Ocean.analytic("gyre"), 0.0, 0.0))


def in_plane(layer: Layer, latitude: float, longitude: float, east: float, north: float) -> float:
    """Bearing in the plane [rad] of a current, from the nodes' own places around the nearest one."""
    away = (layer.latitude - latitude) ** 2 + ((layer.longitude - longitude) * np.cos(np.radians(latitude))) ** 2
    j, i = np.unravel_index(int(np.argmin(away[1:-1, 1:-1])), away[1:-1, 1:-1].shape)
    here = (slice(j, j + 3), slice(i, i + 3))
    wide = np.cos(np.radians(layer.latitude[here]))
    places = np.stack([(layer.longitude[here] - layer.longitude[j + 1, i + 1]) * wide, layer.latitude[here]])
    a, b = (places[:, 2, 1] - places[:, 0, 1]) / 2.0, (places[:, 1, 2] - places[:, 1, 0]) / 2.0
    one, other = np.linalg.solve(np.column_stack([a, b]), [east, north])
    x, y = layer.x[here], layer.y[here]
    along = one * (x[2, 1] - x[0, 1]) + other * (x[1, 2] - x[1, 0])
    up = one * (y[2, 1] - y[0, 1]) + other * (y[1, 2] - y[1, 0])
    return float(np.arctan2(up, along))


def test_arrows_point_where_the_water_goes(arctic20: Path) -> None:
    """On a plane where north is not up, by the places of the nodes around each arrow."""
    ocean = Ocean.open(arctic20)
    layer = layer_of(ocean, FIRST_DAY, 50.0)
    axes = drawn(ocean, FIRST_DAY, 50.0, (72.0, 10.0)).axes[0]
    (arrows,) = (one for one in axes.collections if isinstance(one, Quiver))
    checked = 0
    for (x, y), along, up in zip(arrows.get_offsets(), np.ma.filled(arrows.U), np.ma.filled(arrows.V), strict=True):
        j, i = np.unravel_index(int(np.argmin((layer.x - x) ** 2 + (layer.y - y) ** 2)), layer.x.shape)
        east, north = layer.east[j, i], layer.north[j, i]
        if not (np.isfinite(east) and 0 < j < layer.x.shape[0] - 1 and 0 < i < layer.x.shape[1] - 1):
            continue
        assert np.hypot(along, up) == pytest.approx(np.hypot(east, north), abs=1e-9)
        wanted = in_plane(layer, layer.latitude[j, i], layer.longitude[j, i], east, north)
        assert abs((np.arctan2(up, along) - wanted + np.pi) % (2.0 * np.pi) - np.pi) < 0.1
        checked += 1
    assert checked > 50


def test_the_marks_of_the_map_say_the_side(arctic20: Path) -> None:
    axes = drawn(Ocean.analytic("east_china_sea"), 0.0, 0.0).axes[0]
    marks = {text.get_text() for text in axes.texts} | {
        text.get_text() for one in axes.collections for text in getattr(one, "labelTexts", [])
    }
    told = [mark for mark in marks if mark.endswith(("°N", "°S", "°E", "°W"))]
    assert told
    assert all(25.0 <= float(mark[:-2]) <= 31.8 for mark in told if mark[-1] == "N")
    assert all(122.0 <= float(mark[:-2]) <= 130.3 for mark in told if mark[-1] == "E")
    assert not [mark for mark in told if mark[-1] in "SW"]
    (point,) = (line for line in axes.get_lines() if line.get_marker() == "o")
    assert len(point.get_xdata()) == 1


def test_each_scale_of_a_column_shows_its_own_quantity() -> None:
    ocean = Ocean.analytic("two_layer", upper_east_m_s=0.3, lower_north_m_s=-0.2)
    figure = drawn(ocean, 0.0, 0.0)
    expected = {
        "Temperature": ("temperature",), "Absolute Salinity": ("absolute_salinity",), "Density": ("density",),
        "Current to east (dotted) and north (dashed)": ("current_east", "current_north"),
    }  # fmt: skip
    for axes, (label, names) in zip(figure.axes, expected.items(), strict=True):
        assert axes.get_xlabel().startswith(label)
        low, high = axes.get_ylim()
        assert low > high == 0.0
        for line, name, dashes in zip(axes.lines, names, ((":", "--") if len(names) > 1 else (None,)), strict=True):
            assert dashes is None or line.get_linestyle() == dashes
            for k in range(0, len(line.get_ydata()), 40):
                depth = float(line.get_ydata()[k])
                value = getattr(ocean.at(0.0, 30.0, 125.0, depth), name) - (1000.0 if label == "Density" else 0.0)
                assert line.get_xdata()[k] == pytest.approx(value, abs=5e-3), (name, depth)
