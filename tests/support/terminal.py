"""What a verb printed, read back: its tables by column, its named values by name, and their numbers."""

import re
from dataclasses import dataclass, field
from typing import Any

_RULE = re.compile(r"^\s*─{3,}")
_NUMBER = re.compile(r"(?<![\w.])[-+±]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
_UNITS = re.compile(r"1/(?=[A-Za-z(])|(?<=[A-Za-z])\d+|m s-1")
_GAP = 3
"""Blanks between two columns."""


@dataclass(frozen=True)
class Shown:
    """A table: its title, and a row's cells by the words above them."""

    title: str
    columns: tuple[str, ...]
    rows: list[dict[str, str]] = field(default_factory=list)


def numbers_in(text: str) -> list[str]:
    """The numbers of a cell or value as they are written, without those of its units."""
    return [found.lstrip("±+") for found in _NUMBER.findall(_UNITS.sub("", text).replace("−", "-"))]


def agrees(written: str, expected: float) -> bool:
    """Whether a number as it is written is another one rounded to its last digit."""
    mantissa, _, power = written.partition("e")
    decimals = len(mantissa.partition(".")[2])
    last = 10.0 ** (int(power or 0) - decimals)
    if not decimals and not power and len(mantissa.lstrip("-0")) > 3 and mantissa.endswith("0"):
        last *= 10.0  # may be rounded to significant digits
    return abs(float(written) - expected) <= 0.5000001 * last + 1e-9 * abs(expected)


def tables(text: str) -> list[Shown]:
    """Every table that was printed."""
    lines = text.splitlines()
    return [_table(lines, k) for k, line in enumerate(lines) if _RULE.match(line)]


def _table(lines: list[str], rule: int) -> Shown:
    first = rule
    while lines[first - 1].strip():
        first -= 1
    last = rule + 1
    while last < len(lines) and lines[last].strip():
        last += 1
    title = first - 1
    begin = title
    while begin > 0 and lines[begin - 1].strip() and not lines[begin - 1].startswith(" "):
        begin -= 1  # a title of several lines; what stands before it ends with a full stop or has an indent
        if lines[begin].endswith("."):
            begin += 1
            break
    heads, body = lines[first:rule], lines[rule + 1 : last]
    spans = _spans([*heads, *body])
    columns = tuple(" ".join(word for head in heads if (word := head[a:b].strip())) for a, b in spans)
    shown = Shown(" ".join(line.strip() for line in lines[begin:title]), columns)
    for line in body:
        cells = dict(zip(columns, (line[a:b].strip() for a, b in spans), strict=True))
        if shown.rows and not (cells[columns[-1]] and cells[columns[0]]):  # goes on below
            for name, cell in cells.items():
                shown.rows[-1][name] = f"{shown.rows[-1][name]}\n{cell}".strip()
        else:
            shown.rows.append(cells)
    return shown


def _spans(lines: list[str]) -> list[tuple[int, int]]:
    """Columns lie between gaps that no line crosses."""
    width = max(map(len, lines))
    used = "".join("x" if any(line[k : k + 1].strip() for line in lines) else " " for k in range(width))
    return [match.span() for match in re.finditer(rf"x+(?: {{1,{_GAP - 1}}}x+)*", used)]


def values(text: str) -> dict[str, str]:
    """Every named value, by its name; what goes on below is put behind it."""
    found: dict[str, str] = {}
    width = 0
    for line in text.splitlines():
        named = re.match(r"^  (\S.*?) {2,}(\S.*)$", line)
        if named and not _RULE.match(line):
            width = line.index(named.group(2), 2 + len(named.group(1)))
            found[named.group(1)] = named.group(2)
        elif width and re.match(rf"^ {{{width}}}\S", line) and found:
            found[next(reversed(found))] += " " + line.strip()
        else:
            width = 0
    return found


def same(cell: str, expected: Any) -> bool:
    """Whether a cell tells what it should: a text, a number, several numbers in their order, or a dash for none."""
    if expected is None:
        return cell == "-"
    if isinstance(expected, str):
        return " ".join(cell.split()) == " ".join(expected.split())
    wanted = list(expected) if isinstance(expected, list | tuple) else [expected]
    told = numbers_in(cell)
    return len(told) == len(wanted) and all(agrees(one, other) for one, other in zip(told, wanted, strict=True))
