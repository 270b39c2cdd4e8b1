"""The design study as pictures, and as one self-contained HTML file."""

from pathlib import Path

from stommel.design.study import DesignStudy
from stommel.files.whole import write_whole
from stommel.report.page import report_html

__all__ = ["report_html", "write_report"]


def write_report(study: DesignStudy, path: Path) -> None:
    """Write the report of a study as one HTML file that needs no network.

    Raises
    ------
    OutputError
        The file cannot be written; what stood there before still does.
    """
    write_whole(path, report_html(study))
