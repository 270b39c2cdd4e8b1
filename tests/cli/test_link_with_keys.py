"""`stommel sitl fly --link --key`: a signed line from end to end, as the guide's page has it. Oracle: what is shown."""

import json
import re
import subprocess
import time
from pathlib import Path

from stommel.link.signing.key_file import KeyFile
from tests.cli.afloat_link import new_key
from tests.clients.afloat import scenario_in
from tests.support.command import PROGRAM, Command, run_here

STARTS_WITHIN = 600.0
"""The loop is compiled first, where no cache has it [s]."""


def test_shore_and_flight_with_copies_of_one_key(tmp_path: Path) -> None:
    new_key(tmp_path, "vehicle.key")
    KeyFile(tmp_path / "shore.key").write(KeyFile(tmp_path / "vehicle.key").read())
    new_key(tmp_path, "other.key")
    told = tmp_path / "told.txt"
    flight = [PROGRAM, "sitl", "fly", scenario_in(tmp_path), "--speed", "1", "--no-live"]
    flight += ["--link", "tcp-listen:127.0.0.1:0", "--key", "vehicle.key"]
    with told.open("wb") as out:
        process = subprocess.Popen(list(map(str, flight)), stdout=out, stderr=subprocess.STDOUT, cwd=tmp_path)
    try:
        until = time.monotonic() + STARTS_WITHIN
        while not (found := re.search(r"(tcp:\S+)", told.read_text())):
            assert time.monotonic() < until, told.read_text()
            assert process.poll() is None, told.read_text()
            time.sleep(0.1)
        line = ("--to", found[1], "--within", "60", "--seconds", "2", "--json")
        status = run_here(tmp_path, "link", "status", "--key", "shore.key", "--state", "s", *line)
        assert status.status == 0, status.err
        assert json.loads(status.out)["signing"] == "signing"
        wrong = ("--key", "other.key", "--state", "o", "--to", found[1], "--within", "5")
        stranger = run_here(tmp_path, "link", "status", *wrong)
        assert (stranger.status, len(stranger.err.splitlines())) == (2, 1)
        assert "wrongly signed" in stranger.err
    finally:
        process.terminate()
        process.wait(120.0)


def test_a_key_without_a_link_is_refused(stommel: Command, tmp_path: Path) -> None:
    new_key(tmp_path, "vehicle.key")
    found = stommel("sitl", "fly", "pool_trial", "--key", "vehicle.key")
    assert (found.status, found.out) == (2, "")
    assert "--key: is of use only with --link" in found.err
