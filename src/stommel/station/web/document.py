"""Prints the OpenAPI document of the station, without a station: `python -m stommel.station.web.document`.

With `--schemas` only the shapes of what is asked and answered and said on the live socket: of them
the types of the page are made.
"""

import json
import sys
from typing import Any

from stommel.station.web.app import api


def schemas(document: dict[str, Any]) -> dict[str, Any]:
    """The shapes of the document alone: no routes, no titles, and no words, which change more often."""
    found: dict[str, Any] = _bare(
        document | {"paths": {}, "components": {"schemas": document["components"]["schemas"]}}
    )
    return found


def _bare(part: Any) -> Any:
    """The same schemas without titles and descriptions; a property may have that name."""
    if isinstance(part, list):
        return [_bare(each) for each in part]
    if not isinstance(part, dict):
        return part
    return {
        key: _bare(value)
        for key, value in part.items()
        if key not in ("title", "description") or not isinstance(value, str)
    }


def main(arguments: list[str]) -> None:
    """Print the document."""
    document = api().openapi()
    json.dump(schemas(document) if "--schemas" in arguments else document, sys.stdout, indent=1)


if __name__ == "__main__":
    main(sys.argv[1:])
