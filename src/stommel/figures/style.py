"""One look for all plots: colours that colour-blind eyes and a printer tell apart, and fonts that matplotlib ships."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from typing import TYPE_CHECKING, Any, ParamSpec

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# Okabe and Ito (2008), darkened where thin lines on white need it
BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY = "#0b62a4", "#c4501b", "#00805f", "#9c4f86", "#c98a00", "#5aa9d6"
INK, MUTED, FAINT, SHADE = "#1d2733", "#5c6875", "#d5dbe1", "#f3f5f7"
CYCLE = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY)
DASHES = ("-", (0, (6, 2)), (0, (2, 1.4)), (0, (7, 2, 1.5, 2)), (0, (4, 1)), (0, (1, 1)))
"""Line styles that go with `CYCLE`, so that the lines differ without colour."""

STYLE: dict[str, Any] = {
    "figure.facecolor": "white",
    "figure.dpi": 100,
    "font.family": "DejaVu Sans",
    "font.size": 9.5,
    "text.color": INK,
    "mathtext.fontset": "dejavusans",
    "axes.edgecolor": MUTED,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.8,
    "axes.titlesize": 10.5,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.unicode_minus": True,
    "grid.color": FAINT,
    "grid.linewidth": 0.6,
    "xtick.color": MUTED,
    "ytick.color": MUTED,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "xtick.labelsize": 8.8,
    "ytick.labelsize": 8.8,
    "lines.linewidth": 1.9,
    "lines.solid_capstyle": "round",
    "legend.frameon": False,
    "legend.fontsize": 8.8,
    "hatch.color": "#c9ced4",
    "hatch.linewidth": 0.7,
    "svg.fonttype": "path",
    "svg.hashsalt": "stommel",
}

_Arguments = ParamSpec("_Arguments")


@contextmanager
def plot_style() -> Iterator[None]:
    """Draw or save in the style of stommel, whatever the user's matplotlibrc says."""
    import matplotlib  # noqa: PLC0415 - start-up counts

    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        for name, value in STYLE.items():
            matplotlib.rcParams[name] = value  # type: ignore[index]  # its names are a Literal of matplotlib's
        yield


def styled(draw: Callable[_Arguments, "Figure"]) -> Callable[_Arguments, "Figure"]:
    """Make a drawing function draw in the style of stommel."""

    @wraps(draw)
    def draw_in_style(*args: _Arguments.args, **kwargs: _Arguments.kwargs) -> "Figure":
        with plot_style():
            return draw(*args, **kwargs)

    return draw_in_style


def new_figure(width_in: float, height_in: float) -> "Figure":
    """Return an empty figure that lays its axes out by itself."""
    from matplotlib.figure import Figure  # noqa: PLC0415 - start-up counts

    return Figure(figsize=(width_in, height_in), layout="constrained")


def legend_below(figure: "Figure", axes: "Axes", columns: int) -> None:
    """Put one legend of the labelled artists of `axes` under the whole figure."""
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower left", ncols=columns, handlelength=2.2, columnspacing=1.6)


def number(value: float) -> str:
    """A number in a title or label, with a proper minus sign."""
    return f"{value:.6g}".replace("-", "−")


def at_least_span(low: float, high: float, span: float) -> tuple[float, float]:
    """Limits of an axis with some room, no narrower than `span`: a constant must not look like noise."""
    width = max(high - low, span)
    middle = 0.5 * (low + high)
    return middle - 0.58 * width, middle + 0.58 * width
