"""The disk of the archive is full: a person is told, with what to do; nothing is lost; an abort goes out all the same.

Oracle: SQLite, which refuses by itself; the vehicle, which has said and heard what it has; the archive afterwards.
"""

from typing import Any

from stommel.link.commands.table import command_named
from tests.page.manned import told
from tests.page.quay import Quay
from tests.page.waiting import becomes, until

REASON = "the disk is full; free some room there, nothing that was stored is lost"
SAID = 200
NOTE = "written while there was no room; " * 280
"""Longer than what is left of a page of the database."""


def say(quay: Quay, depths: range) -> None:
    """Let the vehicle tell depths, more than fits into the pages that a database has left."""
    for depth in depths:
        quay.vehicle.say("GLIDER_STATE", time_boot_ms=0, depth=0.25 * depth, executive=2, phase=0, dive=8, alarms=0)


def test_a_full_disk_is_told_with_what_to_do_and_an_abort_goes_out(page: Any, quay: Quay, screenshot: Any) -> None:
    page.goto(f"{quay.address}/#/vehicle/1/link")
    page.get_by_text("vehicle 1 is heard").wait_for()
    kept = len(depths(quay))
    with quay.full_disk():
        say(quay, range(SAID))
        alert = page.get_by_role("alert").filter(has_text=REASON)
        alert.get_by_text("frames wait in memory").wait_for()
        screenshot("disk-full-link")

        page.goto(f"{quay.address}/#/fleet")
        told_of = page.get_by_role("region", name="Alarms of the station")
        told_of.get_by_text(REASON).wait_for()
        page.get_by_role("button", name="Alarms: 1 open").wait_for()
        screenshot("disk-full-fleet")

        page.goto(f"{quay.address}/#/vehicle/1/log")
        note = page.get_by_role("textbox", name="Note")
        note.fill(NOTE)
        note.press("Control+Enter")
        page.get_by_role("alert").filter(has_text=REASON).first.wait_for()
        assert note.input_value() == NOTE, "what was typed is not lost"

        page.get_by_role("button", name="Abort", exact=True).click()
        page.get_by_role("button", name="Abort now").click()
        page.get_by_text("is on its way").wait_for()
        until(page, lambda: command_named("abort").number in quay.vehicle.port.numbers)

    note.press("Control+Enter")
    page.locator("li", has_text=NOTE[:40]).first.wait_for()
    page.goto(f"{quay.address}/#/vehicle/1/commands")
    page.locator("tr[data-command][data-state='done']", has_text="abort").first.wait_for()
    page.goto(f"{quay.address}/#/fleet")
    page.get_by_role("button", name="Alarms: none open").wait_for()
    assert told_of.get_by_text(REASON).count() == 0
    becomes(page, lambda: len(depths(quay)) - kept, SAID)


def depths(quay: Quay) -> list[float]:
    """Frames of the state of the vehicle that the archive has."""
    rows = told(quay.address, "/vehicles/1/frames?message=GLIDER_STATE&limit=500")
    return [row["t"] for row in rows]
