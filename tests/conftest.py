"""What tests of several rooms share: the command, the paper's glider, studies and reports, data beside the checkout."""

import os
from collections.abc import Callable
from functools import cache, partial
from pathlib import Path
from typing import Any

import hypothesis
import pytest

from stommel.design.study import DesignStudy, design_study
from stommel.report import report_html
from stommel.vehicle import Vehicle, load_vehicle
from tests.support.command import Command, run_here, run_process
from tests.support.shared_data import shared_data

# the same examples in each run, and none too slow for a busy machine; `--hypothesis-profile default` draws others
hypothesis.settings.register_profile("same", deadline=None, derandomize=True)
hypothesis.settings.load_profile("same")

TOGETHER = {
    "page": ("tests/page/",),
    "flights": ("tests/sitl/",),
    "reports": (
        "tests/report/", "tests/hull/test_hull_in_the_report.py", "tests/bench/test_plots_and_report.py",
        "tests/cli/test_commands.py",
    ),
}  # fmt: skip
"""What shares costly fixtures runs in one process: a station of the page with its glider, which else flies on beside
the tests of other rooms until all is over; compiled loops; reports. Every other file is for itself."""


def group_of(nodeid: str) -> str:
    """What a test stays together with."""
    file = nodeid.partition("::")[0]
    return next((name for name, begins in TOGETHER.items() if file.startswith(begins)), file)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_auto_num_workers() -> int:
    """One worker more than cores: browsers, servers and flights in real time are mostly waited for."""
    return (os.cpu_count() or 1) + 1


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """Give each worker of pytest-xdist whole groups. (Its own `loadgroup` does nothing under pytest 9.2.)"""
    from xdist.scheduler import LoadScopeScheduling

    class Together(LoadScopeScheduling):
        def _split_scope(self, nodeid: str) -> str:
            return group_of(nodeid)

    return Together(config, log)


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Begin with the groups that take longest, so that no worker waits for another at the end."""
    items.sort(key=lambda item: group_of(item.nodeid) not in TOGETHER)


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
