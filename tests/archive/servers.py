"""A PostgreSQL server of the tests' own, in a temporary folder, reached through a socket only."""

import os
import pwd
import shutil
import signal
import subprocess
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any


def programs() -> Path | None:
    """Folder of initdb and postgres; None where they are missing, or nobody may run them."""
    found = shutil.which("postgres")
    folders = (
        [Path(found).resolve().parent] if found else sorted(Path("/usr/lib/postgresql").glob("*/bin"), reverse=True)
    )
    if os.geteuid() == 0 and not _other_user():
        return None
    return next((folder for folder in folders if (folder / "initdb").exists()), None)


def _other_user() -> str | None:
    """Somebody who is not root, as whom PostgreSQL runs."""
    names = {entry.pw_name for entry in pwd.getpwall()}
    return next((name for name in ("postgres", "nobody") if name in names), None)


@contextmanager
def postgres() -> Iterator[str]:
    """Run a server; gives the address of its database `postgres`."""
    binaries = programs()
    assert binaries is not None
    as_user: dict[str, Any] = {}
    folder = Path(tempfile.mkdtemp(prefix="pg"))
    if os.geteuid() == 0:
        user = _other_user()
        assert user is not None
        as_user = {"user": user, "group": pwd.getpwnam(user).pw_gid, "extra_groups": []}
        shutil.chown(folder, user)
    quiet: dict[str, Any] = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "cwd": folder}
    data = folder / "data"
    try:
        make = [str(binaries / "initdb"), "-D", str(data), "-U", "keeper", "-A", "trust", "-E", "UTF8", "--no-sync"]
        subprocess.run([*make, "--no-locale"], check=True, **quiet, **as_user)
        options = ["-c", "listen_addresses=", "-c", "fsync=off", "-k", str(folder)]
        server = subprocess.Popen([str(binaries / "postgres"), "-D", str(data), *options], **quiet, **as_user)
        try:
            _wait_for(binaries, folder, server)
            yield f"postgresql+psycopg://keeper@/postgres?host={folder}"
        finally:
            server.send_signal(signal.SIGQUIT)  # at once; nobody needs its data
            server.wait(30)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _wait_for(binaries: Path, folder: Path, server: "subprocess.Popen[bytes]") -> None:
    until = time.monotonic() + 60
    while subprocess.run([str(binaries / "pg_isready"), "-q", "-h", str(folder)], check=False).returncode != 0:
        assert server.poll() is None, "PostgreSQL ended by itself"
        assert time.monotonic() < until, "PostgreSQL does not start"
        time.sleep(0.1)
