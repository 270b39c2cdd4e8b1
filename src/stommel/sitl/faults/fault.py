"""One fault: a row of the table with its target, its time and its value."""

from collections.abc import Mapping, Sequence
from math import inf, isfinite
from typing import Any, NamedTuple

from stommel.errors import FileError, Problem
from stommel.files.nearest import did_you_mean
from stommel.sitl.faults.table import BY_NAME, FaultKind


class Fault(NamedTuple):
    """A fault of a scenario."""

    kind: str
    """Name of its row in `stommel.sitl.faults.table.KINDS`."""
    target: str
    """Empty where its kind has only one."""
    at: float
    """Time of the mission at which it begins [s]."""
    duration: float
    """How long it lasts [s]; infinite for ever."""
    value: float

    @property
    def row(self) -> FaultKind:
        """Its row of the table."""
        return BY_NAME[self.kind]

    @property
    def ends(self) -> float:
        """Time of the mission at which it is over [s]."""
        return self.at + self.duration

    def holds(self, t: float) -> bool:
        """Whether it acts at a time of the mission [s]."""
        return self.at <= t < self.ends

    @property
    def words(self) -> str:
        """The fault in a line."""
        target = f" of {self.target}" if self.target else ""
        value = f" {self.value:g} {self.row.unit}".rstrip() if self.row.has_value else ""
        end = "" if self.duration == inf else f" for {self.duration:g} s"
        return f"{self.kind}{target}{value} at {self.at:g} s{end}"

    def as_table(self) -> dict[str, Any]:
        """The fault as a scenario file says it."""
        table: dict[str, Any] = {"kind": self.kind}
        if self.target:
            table["target"] = self.target
        table["at_s"] = self.at
        if isfinite(self.duration):
            table["for_s"] = self.duration
        if self.row.has_value:
            table["value"] = self.value
        return table


SHORTEST = 0.001
"""The least time that a fault may last [s]."""
_KEYS = ("kind", "target", "at_s", "for_s", "value")


def faults_from(tables: Any, origin: str) -> tuple[Fault, ...]:
    """Faults of a scenario file's `[[faults]]`; `origin` names the file in messages.

    Raises
    ------
    FileError
        Something in them is impossible; each problem names the key, the value and what is allowed.
    """
    if not isinstance(tables, Sequence) or isinstance(tables, str):
        raise FileError([Problem(origin, "faults", "faults: must be a list of tables, each begun by [[faults]]")])
    problems: list[Problem] = []
    found = [_fault(table, f"faults[{k}]", origin, problems) for k, table in enumerate(tables)]
    if problems:
        raise FileError(problems)
    return tuple(fault for fault in found if fault is not None)


def refuse_late(faults: Sequence[Fault], duration: float, origin: str) -> None:
    """Refuse faults that begin when the mission, which lasts `duration` [s], is over: they would break nothing.

    Raises
    ------
    FileError
        A problem for each.
    """
    problems = [
        Problem(
            origin, f"faults[{k}].at_s",
            f"faults[{k}].at_s = {fault.at:g}: must be less than {duration:g} s, when the mission is over",
        )
        for k, fault in enumerate(faults) if fault.at >= duration
    ]  # fmt: skip
    if problems:
        raise FileError(problems)


def _fault(table: Any, key: str, origin: str, problems: list[Problem]) -> Fault | None:
    before = len(problems)

    def refuse(name: str, words: str) -> None:
        where = f"{key}.{name}" if name else key
        problems.append(Problem(origin, where, f"{where} {words}" if words[0] == "=" else f"{where}: {words}"))

    if not isinstance(table, Mapping):
        refuse("", "must be a table with kind, at_s, and target, for_s, value where it has them")
        return None
    for name in table:
        if name not in _KEYS:
            refuse(str(name), f"is no key of a fault{did_you_mean(str(name), _KEYS)} allowed are {', '.join(_KEYS)}")
    kind = table.get("kind")
    row = BY_NAME.get(kind) if isinstance(kind, str) else None
    if row is None:
        near = did_you_mean(kind, list(BY_NAME)) if isinstance(kind, str) else ";"
        refuse("kind", f"= {kind!r}: is no kind of fault{near} allowed are {', '.join(BY_NAME)}")
        return None
    target = table.get("target", "" if not row.targets else None)
    if target not in (row.targets or ("",)):
        allowed = f"must be one of {', '.join(row.targets)}" if row.targets else f"{row.name} has none; leave it out"
        refuse("target", f"= {target!r}: {allowed}")
    at = _number(table.get("at_s", 0.0), 0.0, inf, "at_s", "s", refuse)
    duration = _number(table["for_s"], SHORTEST, inf, "for_s", "s", refuse) if "for_s" in table else inf
    if not row.has_value and "value" in table:
        refuse("value", f"= {table['value']!r}: {row.name} has no value; leave it out")
        return None
    value = _number(table.get("value", row.default), row.low, row.high, "value", row.unit, refuse)
    return Fault(row.name, str(target), at, duration, value) if len(problems) == before else None


def _number(value: Any, low: float, high: float, name: str, unit: str, refuse: Any) -> float:
    good = isinstance(value, int | float) and not isinstance(value, bool) and isfinite(value) and low <= value <= high
    if not good:
        bounds = [f"at least {low:g}"] * isfinite(low) + [f"at most {high:g}"] * isfinite(high)
        refuse(name, f"= {value!r}: must be a number {' and '.join(bounds)} {unit}".rstrip())
        return 0.0
    return float(value)
