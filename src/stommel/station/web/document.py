"""Prints the OpenAPI document of the station, without a station: `python -m stommel.station.web.document`.

With `--schemas` only the shapes of what is asked and answered and said on the live socket: of them
the types of the page are made.
"""

import json
import sys
from typing import Any

from stommel.station.web.app import api


def schemas(document: dict[str, Any]) -> dict[str, Any]:
    """The document without its routes, and without the titles that say every name again."""
    found: dict[str, Any] = _untitled(
        document | {"paths": {}, "components": {"schemas": document["components"]["schemas"]}}
    )
    return found


def _untitled(part: Any) -> Any:
    """The same schemas without titles; a property may have that name."""
    if isinstance(part, list):
        return [_untitled(each) for each in part]
    if not isinstance(part, dict):
        return part
    return {key: _untitled(value) for key, value in part.items() if not (key == "title" and isinstance(value, str))}


def main(arguments: list[str]) -> None:
    """Print the document."""
    document = api().openapi()
    json.dump(schemas(document) if "--schemas" in arguments else document, sys.stdout, indent=1)


if __name__ == "__main__":
    main(sys.argv[1:])
