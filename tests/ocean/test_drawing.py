"""What a picture of an ocean shows is what the ocean answers."""

from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from stommel.ocean import BelowBottomError, LandError, Ocean, OutsideOceanError
from stommel.ocean.pictures.drawing import draw_ocean, layer_of

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
