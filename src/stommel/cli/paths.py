"""Options that name what is to be written: read in one way, and refused before a verb begins its work."""

from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from stommel.errors import OutputError

PLOT_ENDINGS = (".png", ".svg", ".pdf")
"""As `stommel.figures.saving.ENDINGS`, which is not imported at the start."""

Parser = Callable[[str], Path]
"""From what stands behind an option to a path that can be written to; all else is an OutputError of one line that names
the option."""


def file_parser(option: str, *endings: str) -> Parser:
    """Return how `option` reads the name of a file, which ends with one of `endings`."""

    def check(path: Path) -> None:
        from stommel.files.whole import require_file

        require_file(path, endings)

    return parser_with(option, check, "file")


def folder_parser(option: str) -> Parser:
    """Return how `option` reads the name of a folder for several files."""

    def check(path: Path) -> None:
        from stommel.files.whole import require_folder

        require_folder(path)

    return parser_with(option, check, "folder")


def parser_with(option: str, check: Callable[[Path], None], noun: str) -> Parser:
    """Return how `option` reads the name of a file or folder (`noun`) that `check` does not refuse."""

    def read(text: str) -> Path:
        if not text.strip():
            raise OutputError(f"{option} {text!r}: names no {noun}")
        path = Path(text)
        try:
            check(path)
        except OutputError as error:
            raise OutputError(f"{option} {error}") from error
        return path

    return read


PlotOption = Annotated[
    Path | None,
    typer.Option(
        "--plot",
        metavar="FILE",
        parser=file_parser("--plot", *PLOT_ENDINGS),
        help="Plot to write; its name ends with .png, .svg or .pdf.",
    ),
]
PlotsOption = Annotated[
    Path | None,
    typer.Option(
        "--plots", metavar="FOLDER", parser=folder_parser("--plots"), help="Folder for plots, each as PNG and SVG."
    ),
]


def refuse_existing(path: Path | None, force: bool) -> None:
    """Refuse to replace a file unless `force` allows it."""
    if path is not None and not force and path.exists():
        raise OutputError(f"{path}: already exists; --force replaces it")


def refuse_same(option: str, path: Path | None, plots: Path | None) -> None:
    """Refuse a file of `option` that is the folder of --plots as well."""
    if path is not None and path == plots:
        raise OutputError(f"{option} {path}: is the folder of --plots as well")
