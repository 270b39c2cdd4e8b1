"""The built page: its files in memory, compressed once, so that no path leads elsewhere."""

import gzip
import mimetypes
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path, PurePosixPath
from threading import Lock

from starlette.requests import Request
from starlette.responses import Response

BUILT = Path(__file__).parent.parent / "built"
INDEX = "index.html"
FOREVER = "public, max-age=31536000, immutable"
"""Of files whose name holds their hash."""
_ASK_AGAIN = "no-cache"
_COMPRESSIBLE = (".html", ".js", ".css", ".svg", ".json", ".map", ".txt", ".wasm", ".webmanifest")
_SMALLEST = 500
_TYPES = {".js": "text/javascript", ".mjs": "text/javascript", ".webmanifest": "application/manifest+json",
          ".woff2": "font/woff2", ".wasm": "application/wasm"}  # fmt: skip
NOT_BUILT = """<!doctype html>
<html lang="en"><meta charset="utf-8"><title>stommel station</title>
<h1>The station runs; its page is not built yet</h1>
<p>Build it once with <code>make page</code> in the folder of the sources, then load this page again.
A released stommel brings its page along.</p>
<p>The data are there meanwhile: <a href="/api/station">/api/station</a>, <a href="/api/vehicles">/api/vehicles</a>,
<a href="/api/openapi.json">/api/openapi.json</a>.</p>
</html>
"""


@dataclass(frozen=True)
class _File:
    content: bytes
    compressed: bytes | None
    kind: str
    cache: str
    tag: str


class BuiltPage:
    """Serves the files of a folder; a page that is built anew is read anew."""

    def __init__(self, folder: Path = BUILT) -> None:
        self._folder, self._files, self._read_at, self._lock = folder, dict[str, _File](), 0, Lock()

    def answer(self, request: Request, path: str) -> Response | None:
        """The file at a path; None if there is none."""
        name = path.strip("/") or INDEX
        files = self._current()
        if not files and name == INDEX:
            return Response(NOT_BUILT, 503, {"Cache-Control": "no-store"}, "text/html; charset=utf-8")
        file = files.get(name)
        if file is None:
            return None
        headers = {"Cache-Control": file.cache, "ETag": file.tag, "Vary": "Accept-Encoding"}
        if file.tag in request.headers.get("if-none-match", ""):
            return Response(None, 304, headers)
        if file.compressed is not None and "gzip" in request.headers.get("accept-encoding", ""):
            return Response(file.compressed, 200, headers | {"Content-Encoding": "gzip"}, file.kind)
        return Response(file.content, 200, headers, file.kind)

    def _current(self) -> dict[str, _File]:
        try:
            written = (self._folder / INDEX).stat().st_mtime_ns
        except OSError:
            return {}
        with self._lock:
            if written != self._read_at:
                self._files = {
                    path.relative_to(self._folder).as_posix(): _read(path, path.relative_to(self._folder).as_posix())
                    for path in sorted(self._folder.rglob("*"))
                    if path.is_file() and path.suffix not in (".gz", ".br") and not path.name.startswith(".")
                }
                self._read_at = written
            return self._files


def _read(path: Path, name: str) -> _File:
    content = path.read_bytes()
    beside = path.with_name(f"{path.name}.gz")
    compressed = None
    if path.suffix in _COMPRESSIBLE and len(content) >= _SMALLEST:
        compressed = beside.read_bytes() if beside.is_file() else gzip.compress(content, 6, mtime=0)
    kind = _TYPES.get(path.suffix) or mimetypes.guess_type(path.name)[0] or "application/octet-stream"
    if kind.startswith("text/") or kind == "image/svg+xml":
        kind += "; charset=utf-8"
    cache = FOREVER if PurePosixPath(name).parts[0] == "assets" else _ASK_AGAIN
    return _File(content, compressed, kind, cache, f'"{sha256(content).hexdigest()[:20]}"')
