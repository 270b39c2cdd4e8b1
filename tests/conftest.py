"""What tests of several rooms share: the command, the paper's glider, studies and reports, data beside the checkout."""

from collections.abc import Callable
from functools import cache, partial
from pathlib import Path

import pytest

from stommel.design.study import DesignStudy, design_study
from stommel.report import report_html
from stommel.vehicle import Vehicle, load_vehicle
from tests.support.command import Command, run_here, run_process
from tests.support.shared_data import shared_data


@pytest.fixture
def stommel(tmp_path: Path) -> Command:
    """The command, called in this process, in a folder of its own."""
    return partial(run_here, tmp_path)


@pytest.fixture
def stommel_process(tmp_path: Path) -> Command:
    """The installed command as a process, where that is the point; it shares its folder with `stommel`."""
    return partial(run_process, tmp_path)


@pytest.fixture(scope="session")
def zju() -> Vehicle:
    """The paper's glider."""
    return load_vehicle("zju")


@pytest.fixture(scope="session")
def study_of() -> Callable[[str], DesignStudy]:
    """Design study of a built-in vehicle; each is made once."""
    return cache(lambda name: design_study(load_vehicle(name)))


@pytest.fixture(scope="session")
def report_of(study_of: Callable[[str], DesignStudy]) -> Callable[[str], str]:
    """Report of a built-in vehicle; each is written once, as its pictures take seconds."""
    return cache(lambda name: report_html(study_of(name)))


@pytest.fixture(scope="session")
def arctic20() -> Path:
    """Five daily means of an ocean model north of Norway, on a polar stereographic grid."""
    return shared_data("arctic20", "arctic20.nc")
