"""Reports for tests that only read words."""

from collections import defaultdict
from unittest.mock import patch

from stommel.design.study import DesignStudy
from stommel.report import report_html


def report_without_pictures(study: DesignStudy) -> str:
    """Write a report without its pictures, which take most of the time."""
    with patch("stommel.report.page.figures", lambda _study: defaultdict(str)):
        return report_html(study)
