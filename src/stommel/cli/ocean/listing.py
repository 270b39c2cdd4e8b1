"""`stommel ocean list`: the oceans in closed form."""

from typing import Any

from stommel.cli.finish import finish
from stommel.cli.options import JsonOption
from stommel.cli.output import show_values


def list_oceans(as_json: JsonOption = False) -> None:
    """List the analytic oceans with their parameters and defaults.

    Example: stommel ocean list
    """
    from stommel.ocean.analytic.catalogue import ANALYTIC

    rows: dict[str, dict[str, Any]] = {
        name: {
            "summary": (kind.__doc__ or "").strip(),
            "parameters": {key: field.default for key, field in kind.model_fields.items()},
        }
        for name, kind in ANALYTIC.items()
    }
    finish(rows, None, as_json, _show)


def _show(rows: dict[str, dict[str, Any]]) -> None:
    for name, row in rows.items():
        values = {key: "none" if value is None else f"{value:g}" for key, value in row["parameters"].items()}
        show_values(f"{name}: {row['summary']}", values)
