"""The study of the paper's glider."""

from collections.abc import Callable

import pytest

from stommel.design.study import DesignStudy


@pytest.fixture(scope="session")
def zju(study_of: Callable[[str], DesignStudy]) -> DesignStudy:
    return study_of("zju")
