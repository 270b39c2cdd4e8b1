"""How a choice of motor speed looks in a terminal."""

from math import pi
from typing import TYPE_CHECKING

from stommel.cli.output import number, show_table

if TYPE_CHECKING:
    from stommel.bench import SpeedChoice


def show_choice(choice: "SpeedChoice") -> None:
    """Print every speed that was compared, and why the chosen one."""
    rows = [
        [
            number(one.motor_speed * 60 / (2 * pi), 0),
            number(one.K / 1e3, 2),
            number(one.inflating_time, 1),
            "chosen" if one is choice.chosen else one.refused_because or "possible",
        ]
        for one in choice.candidates
    ]
    title = f"Motor speed, averaged over {', '.join(f'{abs(round(P / 1e6, 2)):g}' for P in choice.pressures)} MPa"
    columns = ["speed\nr/min", "K\nJ/mm", f"{choice.limit.volume * 1e6:g} ml\ns", ""]
    show_table(title, columns, rows, [choice.reason()])
