"""Missions given while the vehicle is out of reach: seen, corrected, taken back. Oracle: what the station says."""

import re
from typing import Any

from tests.page.manned import told
from tests.page.past import Past


def upload(page: Any, name: str, expires: str) -> Any:
    """The open dialog that hands a plan of this name over."""
    page.get_by_label("Name of the plan").fill(name)
    page.get_by_role("button", name="Upload…").click()
    dialog = page.get_by_role("dialog", name="Upload")
    dialog.get_by_label("Expires after").select_option(label=expires)
    return dialog


def hand_over(page: Any, dialog: Any) -> None:
    dialog.get_by_role("button", name="Upload", exact=True).click()
    dialog.wait_for(state="detached")


def test_a_mission_that_waits_is_corrected_and_taken_back(page: Any, past: Past, screenshot: Any, serious: Any) -> None:
    from playwright.sync_api import expect

    page.goto(f"{past.address}/#/vehicle/1/plan")
    page.locator("[data-place='waypoints.3']").wait_for()
    dialog = upload(page, "First try", "3 days")
    expect(dialog).to_contain_text("is not in contact. The mission waits")
    expect(dialog).to_contain_text("If it does not have the mission after 3 days, it is not sent any more")
    screenshot("upload-waits")
    hand_over(page, dialog)
    waits = page.get_by_role("region", name="On its way")
    expect(waits).to_contain_text("First try")
    expect(waits).to_contain_text(re.compile(r"expires in (2 d 23|3 d 0) h; then it is not sent"))
    first = told(past.address, "/vehicles/1/mission")["upload"]
    assert (first["name"], first["state"]) == ("First try", "waiting")

    dialog = upload(page, "Corrected", "1 day")
    expect(dialog).to_contain_text("“First try” of local, given at")
    hand_over(page, dialog)
    expect(waits).to_contain_text("Corrected")
    expect(waits).to_contain_text(re.compile(r"expires in 23 h \d\d min"))
    expect(page.locator(f"[data-mission='{first['id']}']")).to_have_attribute("data-state", "superseded")
    screenshot("mission-waits")
    assert serious() == []

    second = told(past.address, "/vehicles/1/mission")["upload"]
    assert second["name"] == "Corrected"
    waits.get_by_role("button", name="Take back").click()
    waits.wait_for(state="detached")
    expect(page.locator(f"[data-mission='{second['id']}']")).to_have_attribute("data-state", "cancelled")
    expect(page.locator(f"[data-mission='{second['id']}']")).to_contain_text("taken back by local")
    assert told(past.address, "/vehicles/1/mission")["upload"] is None
