"""The page's types are those of the server's document: `make page` and `npm run types` make them anew.

Oracle: openapi-typescript over the document of the present sources.
"""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from stommel.station.web.app import api
from stommel.station.web.document import schemas

PAGE = Path(__file__).resolve().parents[2] / "page"
GENERATOR = PAGE / "node_modules" / "openapi-typescript" / "bin" / "cli.js"
OPTIONS = ["--root-types", "--root-types-no-schema-prefix", "--root-types-keep-casing"]


def test_schema_is_that_of_the_document(tmp_path: Path) -> None:
    if not GENERATOR.exists():
        pytest.skip("the page's packages are not installed: make page")
    script = json.loads((PAGE / "package.json").read_text(encoding="utf-8"))["scripts"]["types"]
    assert all(option in script for option in OPTIONS)
    document, made = tmp_path / "document.json", tmp_path / "schema.d.ts"
    document.write_text(json.dumps(schemas(api().openapi())), encoding="utf-8")
    command = [sys.executable, str(PAGE / "npm.py"), "exec", "--offline", "--", "openapi-typescript", str(document)]
    subprocess.run([*command, *OPTIONS, "--output", str(made)], check=True, capture_output=True, timeout=300)
    kept = (PAGE / "src" / "lib" / "schema.d.ts").read_text(encoding="utf-8")
    assert made.read_text(encoding="utf-8") == kept, "run: python page/npm.py run types"
