"""The faults of the loop as tables, from `stommel.sitl.faults.table`."""

from collections.abc import Iterator
from math import isfinite

from stommel.sitl.faults.table import KINDS, SENSORS, FaultKind


def fault_tables() -> Iterator[str]:
    """Lines of the tables, in Markdown: all kinds of faults, then the sensors that can be broken."""
    yield "| kind | where | targets | value | default | survivable alone | what it does |\n|---|---|---|---|---|---|---|\n"
    for row in KINDS:
        targets = ", ".join(f"`{target}`" for target in row.targets) or "-"
        default = f"{row.default:g}" if row.has_value else "-"
        alone = "yes" if row.survivable else "not always"
        yield f"| `{row.name}` | {row.where} | {targets} | {_value(row)} | {default} | {alone} | {row.words} |\n"
    yield "\n| sensor | what it measures | unit | greatest bias drawn | greatest noise drawn |\n|---|---|---|---|---|\n"
    for name, sensor in SENSORS.items():
        numbers = f"{sensor.bias:g} | {sensor.noise:g}" if sensor.unit else "- | -"
        yield f"| `{name}` | {sensor.words} | {sensor.unit or '-'} | {numbers} |\n"


def _value(row: FaultKind) -> str:
    if not row.has_value:
        return "-"
    ends = [f"{word} {end:g}" for word, end in (("from", row.low), ("to", row.high)) if isfinite(end)]
    return " ".join([*ends, row.unit]).strip() or "any number"
