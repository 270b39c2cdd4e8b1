"""Figures as files: PNG, SVG or PDF, with the same bytes for the same figure."""

import io
import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from stommel.figures.style import plot_style
from stommel.files.whole import require_file, write_whole

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


def pdf_bytes(figure: "Figure") -> bytes:
    """Render a figure as a PDF document, without date or software in its metadata."""
    from matplotlib.backends.backend_pdf import FigureCanvasPdf  # noqa: PLC0415 - start-up counts

    stream = io.BytesIO()
    with plot_style():
        metadata = {"CreationDate": None, "Creator": None, "Producer": None}
        FigureCanvasPdf(figure).print_figure(stream, format="pdf", metadata=metadata)
    return stream.getvalue()


_FORMATS: Mapping[str, Callable[["Figure"], bytes | str]] = {".png": png_bytes, ".svg": svg_text, ".pdf": pdf_bytes}
ENDINGS = tuple(_FORMATS)
"""What the name of a figure's file ends with."""


def save_figure(figure: "Figure", stem: Path) -> list[Path]:
    """Write `stem`.png and `stem`.svg, and return their paths.

    Raises
    ------
    OutputError
        A file cannot be written; none is left half-written.
    """
    return [save_figure_as(figure, stem.with_name(stem.name + ending)) for ending in (".png", ".svg")]


def save_figure_as(figure: "Figure", path: Path) -> Path:
    """Write a figure in the format that the name of its file ends with, and return its path.

    Raises
    ------
    OutputError
        The name ends otherwise, or the file cannot be written; none is left half-written.
    """
    require_file(path, ENDINGS)
    write_whole(path, _FORMATS[path.suffix.lower()](figure))
    return path
