"""`stommel vehicle log`: what a file of a vehicle's log holds, and whether it is whole."""

from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.finish import finish
from stommel.cli.options import JsonOption
from stommel.cli.output import number, show_entries, show_notes, show_table, show_values
from stommel.errors import StommelError
from stommel.files.nearest import did_you_mean
from stommel.files.units import counted

if TYPE_CHECKING:
    from stommel.messages.log.reader import LogContents, ReadKind

_MOST_MIB = 256
_SHOWN = 20
"""Events and records in the terminal."""


class UnknownKindError(StommelError):
    """The log describes no such records."""


def log(
    file: Annotated[str, typer.Argument(metavar="LOG", help="A file of a vehicle's log, .log.")],
    kind: Annotated[
        str | None, typer.Option("--kind", metavar="KIND", help="Also the records of this kind, such as event or ctd.")
    ] = None,
    salvage: Annotated[
        bool, typer.Option("--salvage", help="Go on behind damage with the next record whose checksum is right.")
    ] = False,
    as_json: JsonOption = False,
) -> None:
    """Read a file of a vehicle's log: what wrote it, records by kind, events, and whether it is whole.

    A file that a loss of power has cut off yields the records before the cut, and says "truncated".

    Example: stommel vehicle log 00003-000001-essential.log --kind navigation
    """
    from stommel.files.opening import read_bytes
    from stommel.messages.log.reader import read_log

    data = read_bytes(Path(file), _MOST_MIB)
    contents = read_log(data, file, resynchronise=salvage)
    chosen = None if kind is None else _kind_named(contents, kind, file)
    answer = _row(contents, len(data))
    if chosen is not None:
        answer["rows"] = _rows(contents, chosen)
    finish(answer, None, as_json, lambda answer: _show(answer, chosen))


def _kind_named(contents: "LogContents", name: str, file: str) -> "ReadKind":
    kinds = {known.name: known for known in contents.kinds.values()}
    if name not in kinds:
        among = ", ".join(sorted(kinds)) or "none"
        raise UnknownKindError(
            f"--kind {name!r}: {file} holds no such records{did_you_mean(name, kinds)} it has {among}"
        )
    return kinds[name]


def _row(contents: "LogContents", size: int) -> dict[str, Any]:
    header = dict(contents.header)
    if isinstance(header.get("database_hash"), int):
        header["database_hash"] = f"{header['database_hash']:06x}"
    return {
        "header": header,
        "bytes": size,
        "status": contents.status,
        "verdict": contents.verdict,
        "valid_records": contents.valid_records,
        "valid_bytes": contents.offset,
        "records": len(contents.records),
        "missing": contents.missing,
        "skipped_bytes": contents.skipped_bytes,
        "kinds": _kinds(contents),
        "events": _events(contents),
    }


def _kinds(contents: "LogContents") -> list[dict[str, Any]]:
    """Records by kind, with the time of the first and the last."""
    found: dict[str, list[Any]] = {}
    for record in contents.records:
        found.setdefault(record.kind, []).append(record.values[0])
    return [
        {"kind": kind, "records": len(times), "first_s": _plain(times[0]), "last_s": _plain(times[-1])}
        for kind, times in found.items()
    ]


def _events(contents: "LogContents") -> list[dict[str, Any]]:
    columns = contents.columns("event")
    wanted = [columns.get(name, []) for name in ("t", "code", "reason")]
    return [{"t_s": _plain(t), "code": code, "reason": reason} for t, code, reason in zip(*wanted, strict=False)]


def _rows(contents: "LogContents", kind: "ReadKind") -> list[dict[str, Any]]:
    return [
        {name: _plain(value) for name, value in zip(kind.names, record.values, strict=True)}
        for record in contents.records
        if record.kind == kind.name
    ]


def _plain(value: Any) -> Any:
    """A value as JSON has it: None for what is infinite or no number, bytes in hexadecimal."""
    if isinstance(value, bytes):
        return value.hex()
    return None if isinstance(value, float) and not isfinite(value) else value


def _show(answer: dict[str, Any], chosen: "ReadKind | None") -> None:
    header = answer["header"]
    values = {"status": answer["verdict"], "size": counted(answer["bytes"], "byte")}
    if header:
        values |= {
            "vehicle": str(header.get("vehicle") or "-"),
            "software": f"stommel {header.get('software')}, CAN database {header.get('database_hash')}",
            "series": f"{header.get('series')}, first record {header.get('first_sequence')}",
            "start": f"{_utc(header.get('started'))}, after {counted(header.get('restarts', 0), 'restart')}",
        }
    if answer["missing"]:
        values["missing"] = counted(answer["missing"], "record")
    show_values("Log", values)
    rows = [[row["kind"], str(row["records"]), _time(row["first_s"]), _time(row["last_s"])] for row in answer["kinds"]]
    if rows:
        show_table("Records", ["kind", "records", "first\ns", "last\ns"], rows)
    _show_last("Events", [(f"{_time(e['t_s'])} s  {e['code']}", e["reason"]) for e in answer["events"]])
    if chosen is not None:
        _show_last(f"Records {chosen.name}", [_entry(chosen, row) for row in answer["rows"]])


def _show_last(title: str, entries: list[tuple[str, str]]) -> None:
    if not entries:
        return
    show_entries(title, entries[-_SHOWN:])
    if len(entries) > _SHOWN:
        show_notes([f"the last {_SHOWN} of {len(entries)} are shown; --json has all"])


def _entry(kind: "ReadKind", row: dict[str, Any]) -> tuple[str, str]:
    """A record as the time, and below it its other values with their units."""
    first, *others = kind.fields
    told = [f"{field['name']} {_worded(row[field['name']], field)}" for field in others]
    return f"{_time(row[first['name']])} {first.get('unit', '')}", ", ".join(told)


def _worded(value: Any, field: dict[str, Any]) -> str:
    words = field.get("words")
    if words and isinstance(value, int) and value < len(words):
        return str(words[value])
    text = f"{value:.7g}" if isinstance(value, float) else "-" if value is None else str(value)
    return f"{text} {field.get('unit', '')}".rstrip()


def _time(value: Any) -> str:
    return number(value, 2) if isinstance(value, int | float) else "-"


def _utc(seconds: Any) -> str:
    from datetime import UTC, datetime

    try:
        return f"{datetime.fromtimestamp(seconds, UTC):%Y-%m-%d %H:%M:%S} UTC"
    except (TypeError, ValueError, OverflowError, OSError):
        return "at a time that it did not know"
