"""When the first vehicle can be read, in a browser that has never been there."""

import os
from typing import Any

SEEN = "document.querySelector('article.strip h2') !== null"


def useful_paint_s(browser: Any, station: str) -> float:
    """Seconds from the start of the navigation to the frame that shows the first vehicle of the fleet."""
    context = browser.new_context(viewport={"width": 1440, "height": 900})
    context.add_init_script(
        f"""const look = () => {{
          if ({SEEN}) requestAnimationFrame(() => {{ window.usefulAt = performance.now(); }});
          else requestAnimationFrame(look);
        }};
        requestAnimationFrame(look);"""
    )
    try:
        tab = context.new_page()
        tab.goto(f"{station}/#/fleet")
        tab.locator("article.strip h2").first.wait_for()
        while (useful := tab.evaluate("window.usefulAt")) is None:  # not a function to wait for, which the page forbids
            tab.wait_for_timeout(20)
        return float(useful) / 1e3
    finally:
        context.close()


def is_too_busy() -> bool:
    """Whether this machine has so much other work that how quick the page is cannot be told."""
    return os.getloadavg()[0] > 2.0 * (os.cpu_count() or 1) or "STOMMEL_PAGE_SLOW" in os.environ
