"""When the first vehicle can be read, in a browser that has never been there."""

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
        tab.wait_for_timeout(100)  # for the frame; a function to wait for would be evaluated, which the page forbids
        return float(tab.evaluate("window.usefulAt")) / 1e3
    finally:
        context.close()
