"""Figures as files: PNG and SVG with the same bytes for the same figure."""

import io
import re
from pathlib import Path
from typing import TYPE_CHECKING

from stommel.figures.style import plot_style
from stommel.files.whole import write_whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PNG_DPI = 150


def png_bytes(figure: "Figure") -> bytes:
    """Render a figure as PNG at 150 dpi, without date or software in its metadata."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg  # noqa: PLC0415 - start-up counts

    stream = io.BytesIO()
    with plot_style():
        FigureCanvasAgg(figure).print_figure(stream, format="png", dpi=PNG_DPI, metadata={"Software": None})
    return stream.getvalue()


def svg_text(figure: "Figure") -> str:
    """Render a figure as an SVG document with fixed identifiers, without date or software in its metadata."""
    from matplotlib.backends.backend_svg import FigureCanvasSVG  # noqa: PLC0415 - start-up counts

    stream = io.BytesIO()
    with plot_style():
        FigureCanvasSVG(figure).print_figure(
            stream, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None}
        )
    return _with_unique_identifiers(stream.getvalue().decode("utf-8"))


def _with_unique_identifiers(svg: str) -> str:
    """Number the identifiers that several artists share; none of these is referred to."""
    seen: dict[str, int] = {}

    def unique(match: re.Match[str]) -> str:
        name = match.group(1)
        seen[name] = seen.get(name, 0) + 1
        return match.group(0) if seen[name] == 1 else f'<g id="{name}-{seen[name]}"'

    return re.sub(r'<g id="([^"]+)"', unique, svg)


def save_figure(figure: "Figure", stem: Path) -> list[Path]:
    """Write `stem`.png and `stem`.svg, and return their paths.

    Raises
    ------
    OutputError
        A file cannot be written; none is left half-written.
    """
    contents: list[tuple[str, bytes | str]] = [(".png", png_bytes(figure)), (".svg", svg_text(figure))]
    paths = []
    for suffix, content in contents:
        path = stem.with_name(stem.name + suffix)
        write_whole(path, content)
        paths.append(path)
    return paths
