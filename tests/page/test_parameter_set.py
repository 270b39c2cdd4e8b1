"""What waits or was not taken, why a component is not known, and sets of parameters as files."""

from pathlib import Path
from typing import Any

import pytest

from tests.page.manned import told
from tests.page.test_parameters import parameter
from tests.page.waiting import until

expect = pytest.importorskip("playwright.sync_api").expect


@pytest.fixture
def view(page: Any, station: str) -> Any:
    """The parameters of the simulated glider, once all of its components have told theirs."""
    page.goto(f"{station}/#/vehicle/1/parameters")
    for name in ("SURFACE_TIME", "PUMP_FLOW", "CTD_PATIENCE"):
        page.locator(f"[data-parameter='{name}']").wait_for(timeout=240_000)
    return page


def chosen(view: Any, name: str, content: str) -> Any:
    """The dialog that a file opens."""
    view.get_by_label("File of parameters").set_input_files(
        {"name": name, "mimeType": "text/plain", "buffer": content.encode()}
    )
    return view.get_by_role("dialog")


def saved(view: Any, folder: Path) -> str:
    """The file that is saved."""
    with view.expect_download() as found:
        view.get_by_role("button", name="Save as a file").click()
    assert found.value.suggested_filename == "vehicle-1.params"
    found.value.save_as(folder / "saved.params")
    return (folder / "saved.params").read_text(encoding="utf-8")


def lines(text: str) -> dict[tuple[int, str], list[str]]:
    """Columns of each parameter of a file, by component and name."""
    rows = [line.split("\t") for line in text.splitlines() if not line.startswith("#")]
    return {(int(row[1]), row[2]): row for row in rows}


def test_a_set_is_saved_and_what_a_file_changes_is_written_once_confirmed(
    view: Any, station: str, tmp_path: Path, screenshot: Any, serious: Any
) -> None:
    """Oracle: what the station tells that the vehicle holds, before and after."""
    text = saved(view, tmp_path)
    components = told(station, "/vehicles/1/parameters")["components"]
    held = {(one["component"], each["name"]): each["value"] for one in components for each in one["parameters"]}
    assert {key: float(row[3]) for key, row in lines(text).items()} == pytest.approx(held, rel=1e-7)

    row = parameter(station, "SURFACE_TIME")
    wanted = 231.0 if row["value"] != 231.0 else 232.0
    (key,) = [key for key in held if key[1] == "SURFACE_TIME"]
    old = "\t".join(lines(text)[key])
    new = "\t".join([*lines(text)[key][:3], f"{wanted:.0f}", lines(text)[key][4]])
    dialog = chosen(view, "other.params", text.replace(old, new))
    expect(dialog).to_contain_text(f"1 difference; {len(held) - 1} the same")
    expect(dialog.get_by_role("row", name="SURFACE_TIME")).to_contain_text(f"{wanted:.0f} s")
    assert serious() == []
    screenshot("parameters-file")
    assert parameter(station, "SURFACE_TIME")["value"] == row["value"]
    dialog.get_by_role("button", name="Write 1 value").click()
    expect(dialog).to_be_hidden()
    until(view, lambda: parameter(station, "SURFACE_TIME")["value"] == wanted)
    dialog = chosen(view, "other.params", text.replace(old, new))
    expect(dialog).to_contain_text(f"0 differences; {len(held)} the same")


def test_a_bad_file_is_told_by_key_and_value_and_writes_nothing(view: Any, station: str) -> None:
    row = parameter(station, "SURFACE_TIME")
    text = f"1\t1\tSURFACE_TIME\t{row['high'] + 1}\t9\n1\t1\tNOTHING\t1\t9\n"
    dialog = chosen(view, "bad.params", text)
    alert = dialog.get_by_role("alert")
    expect(alert).to_contain_text(f"Line 1: SURFACE_TIME = {row['high'] + 1}: is out of range; allowed is")
    expect(alert).to_contain_text("Line 2: component 1 has told of no parameter NOTHING.")
    expect(dialog.get_by_role("button", name="Write", exact=False)).to_have_count(0)


def test_what_waits_or_was_not_taken_and_why_it_is_not_known_stand_in_the_table(
    view: Any, station: str, screenshot: Any
) -> None:
    """Oracle: an answer that is made up out of the station's own."""
    answer = told(station, "/vehicles/1/parameters")
    first, second, *_ = answer["components"]
    node, pump = second["component"], second["parameters"][0]["name"]
    first |= {"whole": False, "reason": "ended after 180 s without an answer"}
    write = {"component": first["component"], "user": "ada", "t": 1_782_864_000.0, "holds": None}
    answer["writes"] = [
        write | {"ticket": 3, "name": "SURFACE_TIME", "value": 240.0, "state": "waiting", "words": ""},
        write | {"ticket": 2, "name": "SURFACE_TIME", "value": 250.0, "state": "failed", "words": "no answer"},
        write | {"ticket": 1, "component": node, "name": pump, "value": 1e-6, "state": "refused", "words": "no"},
    ]
    answer["refreshing"] = {"done": 3, "of": 9, "seconds_left": 20.0}
    answer["notes"] = ["the set of node 25 is another one than before"]
    view.route("**/api/vehicles/1/parameters", lambda route: route.fulfill(json=answer))
    view.reload()
    expect(view.locator("[data-parameter='SURFACE_TIME'] [data-write='waiting']")).to_contain_text("waits: 240 s")
    refused = view.locator(f"[data-parameter='{pump}'] [data-write='refused']")
    expect(refused).to_contain_text("not taken: 1 ml/s")
    expect(refused).to_have_attribute("title", "ada, 2026-07-01 00:00:00 UTC. no")
    view.get_by_text("1 waits, 1 not taken").wait_for()
    view.get_by_text("not up to date: ended after 180 s without an answer").wait_for()
    view.get_by_text("the set of node 25 is another one than before").wait_for()
    view.get_by_text("reading from the vehicle: 3 of 9, about 20\u202fs left").wait_for()
    screenshot("parameters-waiting")
