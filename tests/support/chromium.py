"""The browser that pages are tried in: Debian's Chromium, without its window where that is to be had.

`chromium-headless-shell` is the same engine of the same build; the windows, menus and services that `chromium
--headless` makes behind a page that nobody sees cost as much processor time as the page.
"""

import shutil
from pathlib import Path

_NAMES = ("chromium-headless-shell", "chromium")


def chromium() -> Path | None:
    """The browser's program; None if there is none."""
    return next((Path(found) for name in _NAMES if (found := shutil.which(name))), None)
