"""Draw the picture of the live view anew: `python docs/_extensions/draw_live_view.py`."""

import io
import re
from pathlib import Path

from rich.console import Console
from rich.text import Text

from stommel.simulation.scenario.loading import load_mission
from stommel.simulation.scenario.shipped import mission_path
from stommel.sitl.live_view import picture
from stommel.sitl.observer import Observer
from stommel.sitl.shown import shown
from stommel.sitl.system import System

PICTURE = Path(__file__).parents[1] / "_static" / "live_view.svg"
SECONDS = 6020
"""Of the mission: the fourth dive turns."""


def main() -> None:
    """Fly to a good moment, and keep the page."""
    system, observer = System(load_mission(mission_path("kuroshio"))), Observer()
    for _ in range(SECONDS):
        system.step()
        observer(system)
    console = Console(record=True, width=100, file=io.StringIO(), force_terminal=True, color_system="truecolor")
    console.print(picture(shown(system, observer), Text("1,024 × real time"), 36))
    drawn = console.export_svg(title="stommel sitl kuroshio", unique_id="live-view")
    drawn = re.sub(r"@font-face \{.*?\}\s*", "", drawn, flags=re.DOTALL)  # nothing is loaded from elsewhere
    PICTURE.write_text(drawn.replace("Fira Code", "DejaVu Sans Mono"), encoding="utf-8")


if __name__ == "__main__":
    main()
