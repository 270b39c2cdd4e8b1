"""Studies and reports of the built-in vehicles, computed once each."""

from collections.abc import Callable
from functools import cache

import pytest

from stommel.design.study import DesignStudy, design_study
from stommel.report import report_html
from stommel.vehicle import load_vehicle


@cache
def _study(name: str) -> DesignStudy:
    return design_study(load_vehicle(name))


@cache
def _report(name: str) -> str:
    return report_html(_study(name))


@pytest.fixture(scope="session")
def study_of() -> Callable[[str], DesignStudy]:
    return _study


@pytest.fixture(scope="session")
def report_of() -> Callable[[str], str]:
    return _report


@pytest.fixture(scope="session")
def zju() -> DesignStudy:
    return _study("zju")
