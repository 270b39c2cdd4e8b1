"""How far a flight is: a bar with simulated date, speed and what is left, on the error stream."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.progress import ProgressColumn

    from stommel.simulation.scenario.mission import Mission

_SHORT_WAIT = 6.0
"""Loading the kept machine code takes less; whoever waits longer sees it being compiled [s]."""


@contextmanager
def flight_progress(mission: "Mission") -> Iterator[Callable[[float], None]]:
    """Bar with simulated date and speed on the error stream, if that is a terminal."""
    from datetime import timedelta
    from time import monotonic

    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn

    plan = mission.scenario
    whole = plan.duration_days * 86400.0
    console = Console(stderr=True)
    columns = (TextColumn("{task.fields[date]}"), BarColumn(bar_width=None), TextColumn("{task.percentage:>3.0f} %"),
               _speed_column())  # fmt: skip
    began: list[float] = []
    with Progress(*columns, console=console, disable=not console.is_terminal, transient=True, expand=True) as bar:
        task = bar.add_task("", total=1.0, date=f"{plan.start_time:%Y-%m-%d %H:%M}", speed=None, whole=whole)

        def report(share: float) -> None:
            simulated = share * whole
            date = plan.start_time + timedelta(seconds=simulated)
            # the first piece may include compilation, which is no speed of flight
            speed = (simulated - began[1]) / max(monotonic() - began[0], 1e-9) if began else 0.0
            if not began:
                began.extend((monotonic(), simulated))
            bar.update(task, completed=share, date=f"{date:%Y-%m-%d %H:%M}", speed=speed)

        yield report


def _left(seconds: float) -> str:
    """How long it will take if it goes on so."""
    if seconds < 90.0:
        return f"{seconds:.0f} s left"
    return f"{seconds / 60.0:.0f} min left" if seconds < 5400.0 else f"{seconds / 3600.0:.1f} h left"


def _speed_column() -> "ProgressColumn":
    """Times real time and what is left; before the first piece is flown, what the user waits for."""
    from rich.progress import ProgressColumn, Task
    from rich.table import Column
    from rich.text import Text

    class Speed(ProgressColumn):
        def render(self, task: Task) -> Text:
            speed = task.fields["speed"]
            if speed is None:
                return Text("getting ready" if (task.elapsed or 0.0) < _SHORT_WAIT else "compiling, once")
            if not speed:
                return Text("")
            left = (1.0 - task.completed) * task.fields["whole"] / speed
            return Text(f"{speed:,.0f} x real time, {_left(left)}")

    return Speed(Column(min_width=34, justify="right", no_wrap=True))
