"""`stommel link` and the simulated glider, where files stand in the way.

Oracle: the bytes that the vehicle holds, and what the disk has afterwards.
"""

from pathlib import Path

from tests.clients.afloat import afloat
from tests.support.command import run_here


def test_orders_are_downloaded_over_others_and_not_beside_them(tmp_path: Path) -> None:
    (tmp_path / "aboard.toml").write_text("other orders")
    with afloat(tmp_path) as vehicle:
        line = ("--to", f"tcp:127.0.0.1:{vehicle.port}", "--unsigned", "--state", "state", "--within", 60)
        found = run_here(tmp_path, "link", "mission", "download", "aboard.toml", "--force", *line, "--json")
        held = vehicle.orders_text
    assert found.status == 0, found.err
    assert found.json["written"] == ["aboard.toml"]
    assert (tmp_path / "aboard.toml").read_bytes() == held
    assert sorted(path.name for path in tmp_path.glob("aboard*")) == ["aboard.toml"]
