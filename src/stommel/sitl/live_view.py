"""The live view in a terminal: one calm page, drawn at most four times a second, and never for long."""

import time
from collections.abc import Callable, Iterable, Sequence
from math import isnan
from types import TracebackType
from typing import Self

from rich import box
from rich.console import Console, ConsoleOptions, Group, RenderableType, RenderResult
from rich.live import Live
from rich.panel import Panel
from rich.table import Table
from rich.text import Text

from stommel.sitl.observer import Observer
from stommel.sitl.real_time import Pace
from stommel.sitl.shown import BAD, ODD, QUIET, WELL, Line, Shown, Slider, shown
from stommel.sitl.system import System

SHORTEST = 0.25
"""Between two pictures [s of the clock]."""
SHARE = 0.03
"""Of the time, the most that drawing takes."""
STYLES = {WELL: "default", QUIET: "bright_black", ODD: "yellow", BAD: "bold red"}
_DOTS = ((0x01, 0x08), (0x02, 0x10), (0x04, 0x20), (0x40, 0x80))
"""Of a Braille letter, by row and column (Unicode 2800 on)."""
_BLANK = 0x2800
_TRACE_ROWS = 5
_LEAST_DEEP = 3.0
"""Lower end of the trace at the surface [m]: waves and noise stay small."""
_WIDEST_SLIDER = 21
_LEAST_HEIGHT = 23
"""Lines of the page without trace, alarms and events."""
_NARROW = 76
"""Columns below which the panels stand one above the other."""


class LiveView:
    """Draws a system while it flies; a watcher of `stommel.sitl.flight.fly`.

    Parameters
    ----------
    console
        Where to draw.
    pace
        Of the flight, if it is held back; the view says when it cannot keep up.
    clock
        Says the time [s].
    """

    def __init__(self, console: Console, pace: Pace | None = None, clock: Callable[[], float] = time.monotonic) -> None:
        self._live = Live(console=console, auto_refresh=False, transient=False)
        self._pace, self._clock = pace, clock
        self._observer = Observer()
        self._due = self._drawn_at = clock()
        self._drawn_t = 0.0
        self.pictures = 0
        """Drawn so far."""

    def __enter__(self) -> Self:
        self._live.start()
        self._live.update(
            Text("getting ready: machine code is loaded, or made once", style="bright_black"), refresh=True
        )
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._live.stop()

    def __call__(self, system: System) -> None:
        """Note what is new, and draw if it is time."""
        self._observer(system)
        now = self._clock()
        if now >= self._due and system.coordinator.view is not None:
            self._draw(system, now)

    def _draw(self, system: System, now: float) -> None:
        t = system.plant.time
        speed = (t - self._drawn_t) / (now - self._drawn_at) if self.pictures and now > self._drawn_at else None
        height = self._live.console.height
        self._live.update(picture(shown(system, self._observer), self._speed(speed), height), refresh=True)
        self.pictures += 1
        after = self._clock()
        self._due = max(now + SHORTEST, after + (after - now) * (1.0 / SHARE - 1.0))
        self._drawn_at, self._drawn_t = now, t

    def _speed(self, speed: float | None) -> Text:
        if speed is None:
            return Text("")
        words = Text(f"{speed:,.0f} × real time" if speed >= 10.0 else f"{speed:.1f} × real time")
        if self._pace is not None and self._pace.lost > 0.0:
            words.append(f", {self._pace.lost:.0f} s behind", style=STYLES[ODD])
        return words


def picture(now: Shown, speed: Text | None = None, height: int = 40) -> RenderableType:
    """Return the page, at most `height` lines high where that is possible."""
    left = height - _LEAST_HEIGHT - max(1, len(now.alarms))
    rows = min(_TRACE_ROWS, max(0, left // 2))
    events = max(0, left - rows)
    return Group(_head(now, speed or Text("")), _state(now, rows), _columns(now), _news(now, events))


def _head(now: Shown, speed: Text) -> Table:
    head = Table.grid(expand=True, padding=(0, 1))
    head.add_column(ratio=1)
    head.add_column(justify="right", no_wrap=True)
    words = Text.assemble(now.date, "  ", (now.elapsed, "bold"), "  ", speed)
    head.add_row(Text(now.mission, style="bold", overflow="ellipsis", no_wrap=True), words)
    return head


def _state(now: Shown, rows: int) -> Panel:
    style = "bold cyan" if now.state_how == WELL else STYLES[now.state_how]
    words = Text.assemble(
        (now.state, style), "   ", (now.because, "bright_black"), overflow="ellipsis", no_wrap=True
    )  # fmt: skip
    border = "bright_black" if now.state_how == WELL else "red"
    return _panel("", Group(words, _Trace(now, rows)) if rows else words, border)


class _Trace:
    """The last depths, as wide as there is room."""

    def __init__(self, now: Shown, rows: int) -> None:
        self._now, self._rows = now, rows

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        now, rows = self._now, self._rows
        known = [depth for depth in now.depths if not isnan(depth)]
        deepest = max(_LEAST_DEEP, *known) if known else _LEAST_DEEP
        for k, row in enumerate(trace(now.depths, max(10, options.max_width - 9), rows, deepest)):
            label = "0 m" if k == 0 else f"{deepest:.0f} m" if k == rows - 1 else ""
            yield Text.assemble((f"{label:>7} ", "bright_black"), (row, "blue"), no_wrap=True)


def trace(depths: Sequence[float], columns: int, rows: int, deepest: float) -> list[str]:
    """Draw depths [m] in Braille, two columns and four rows of dots a letter, the newest at the right."""
    cells = [[_BLANK] * columns for _ in range(rows)]
    last = depths[-2 * columns :]
    before: int | None = None
    for k, depth in enumerate(last, start=2 * columns - len(last)):
        if isnan(depth):
            before = None
            continue
        level = min(4 * rows - 1, max(0, round(depth / deepest * (4 * rows - 1))))
        other = level if before is None else before + (before < level) - (before > level)
        for dot in range(min(level, other), max(level, other) + 1):
            cells[dot // 4][k // 2] |= _DOTS[dot % 4][k % 2]
        before = level
    return ["".join(map(chr, row)) for row in cells]


def _columns(now: Shown) -> RenderableType:
    left = Group(
        _panel("flight", _lines(now.flight)), _panel("actuators", _Sliders(now.actuators)),
        _panel("way", _lines(now.place)),
    )  # fmt: skip
    right = Group(
        _panel("power and hull", _lines(now.power)), _panel("bus and nodes", _lines(now.bus)),
        _panel("instruments", _inline(now.instruments)),
    )  # fmt: skip
    return _Beside(left, right)


class _Beside:
    """Two columns where there is room, else one."""

    def __init__(self, left: RenderableType, right: RenderableType) -> None:
        self._left, self._right = left, right

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        if options.max_width < _NARROW:
            yield self._left
            yield self._right
            return
        both = Table.grid(expand=True)
        both.add_column(ratio=1)
        both.add_column(ratio=1)
        both.add_row(self._left, self._right)
        yield both


def _panel(title: str, content: RenderableType, border: str = "bright_black") -> Panel:
    return Panel(
        content, title=Text(title, style="cyan") if title else None, title_align="left", border_style=border,
        box=box.ROUNDED, padding=(0, 1),
    )  # fmt: skip


def _lines(lines: Iterable[Line]) -> Table:
    table = Table.grid(padding=(0, 2, 0, 0))
    table.add_column(style="bright_black", no_wrap=True)
    table.add_column(no_wrap=True, overflow="ellipsis")
    for line in lines:
        table.add_row(line.name, Text(line.value, style=STYLES[line.how]))
    return table


def _inline(lines: Iterable[Line]) -> Text:
    words = Text(overflow="fold")
    for k, line in enumerate(lines):
        words.append("  " if k else "")
        words.append(f"{line.name}\u00a0", style="bright_black")
        words.append(line.value.replace(" ", "\u00a0"), style=STYLES[line.how])
    return words


class _Sliders:
    """A line for each actuator: where it stands, a drawing as wide as there is room, and where it shall stand."""

    def __init__(self, sliders: Iterable[Slider]) -> None:
        self._sliders = sliders

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        width = min(_WIDEST_SLIDER, max(5, options.max_width - 29))
        for one in self._sliders:
            measured, wanted = _whole(one.measured), f"{_whole(one.wanted)} {one.unit}"
            yield Text.assemble(
                (f"{one.name:<8} ", "bright_black"), f"{measured:>5} ", slider(one, width), f" {wanted:<7} ",
                (one.runs, "cyan"), no_wrap=True,
            )  # fmt: skip


def slider(one: Slider, width: int) -> Text:
    """Draw where an actuator stands (a dot), and where it shall (a bar)."""
    letters = ["─"] * width
    letters[_cell(one, one.wanted, width)] = "│"
    at = _cell(one, one.measured, width)
    letters[at] = "●"
    drawn = Text("".join(letters), style="bright_black")
    drawn.stylize("cyan" if one.runs else "default", at, at + 1)
    return drawn


def _cell(one: Slider, value: float, width: int) -> int:
    if isnan(value) or one.high <= one.low:
        return 0
    return min(width - 1, max(0, round((value - one.low) / (one.high - one.low) * (width - 1))))


def _whole(value: float) -> str:
    return "?" if isnan(value) else f"{round(value)}"


def _news(now: Shown, events: int) -> Panel:
    """Alarms, and below them the last events."""
    table = Table.grid(padding=(0, 2, 0, 0))
    table.add_column(style="bright_black", no_wrap=True)
    table.add_column(no_wrap=True, overflow="ellipsis")
    for name, since, how in now.alarms:
        table.add_row(Text("alarm", style=STYLES[how]), Text.assemble((name, STYLES[how]), f", {since}"))
    if not now.alarms:
        table.add_row("alarms", Text("none", style="bright_black"))
    for when, what, grave in now.events[-events:] if events else ():
        table.add_row(when, Text(what, style=STYLES[ODD] if grave else "default"))
    worst = "red" if any(how == BAD for _, _, how in now.alarms) else "bright_black"
    return _panel("alarms and events", table, worst)
