"""What has had no last word, in the top bar, on the strip, at the abort; and the last word. Oracle: what was given."""

from typing import Any

from tests.page.manned import told
from tests.page.past import Past
from tests.page.waiting import until

STATES = {"in progress": 3, "done": 10}
SHORE = {"target_system": 255, "target_component": 190}


def answer(past: Past, id: str, state: str, words: str) -> None:
    """The vehicle says what became of a command."""
    number = STATES[state]
    past.speaker.say(
        "GLIDER_COMMAND_STATUS", id=int(id, 16), state=number, percent=255, words=words.encode(), asking=0, **SHORE
    )


def test_an_abort_is_followed_from_every_view_to_its_last_word(
    page: Any, past: Past, screenshot: Any, serious: Any
) -> None:
    from playwright.sync_api import expect

    page.goto(f"{past.address}/#/fleet")
    page.get_by_role("button", name="Abort", exact=True).click()
    page.get_by_role("button", name="Abort now").click()
    state = page.locator("[data-abort-state]")
    expect(state).to_contain_text("Abort")
    strip = page.get_by_role("article", name="vehicle 1")
    expect(strip.get_by_role("link", name="1 command", exact=True)).to_be_visible()
    expect(page.get_by_role("banner").get_by_role("link", name="1 command", exact=True)).to_be_visible()
    expect(page.locator("[data-abort-state='sent']")).to_be_visible()
    screenshot("abort-waits")
    assert serious() == []
    id = told(past.address, "/vehicles/1")["waiting"]["abort"]["id"]

    page.reload()
    expect(state).to_have_text("Abort sent, waits for contact")
    page.get_by_role("button", name="Abort", exact=True).click()
    expect(page.get_by_role("dialog")).to_contain_text("An abort was given at")
    page.get_by_role("button", name="Do not abort").click()
    answer(past, id, "in progress", "comes up")
    expect(state).to_have_text("Abort is aboard")
    answer(past, id, "done", "at the surface")
    state.wait_for(state="detached")
    notice = page.get_by_text("Abort of vehicle 1: done; at the surface.")
    expect(notice).to_be_visible()
    expect(page.get_by_role("link", name="1 command", exact=True)).to_have_count(0)
    screenshot("abort-done")


def test_the_last_word_that_came_while_the_page_was_away_is_told(page: Any, past: Past) -> None:
    """The socket is lost before the answer comes, and is back after it."""
    from playwright.sync_api import expect

    sockets, away = list[Any](), list[bool]()

    def opened(socket: Any) -> None:
        if away:
            socket.close(code=1001)
        else:
            socket.connect_to_server()
            sockets.append(socket)

    page.route_web_socket("**/api/live", opened)
    page.goto(f"{past.address}/#/vehicle/1/plots")
    page.get_by_role("button", name="Abort", exact=True).click()
    page.get_by_role("button", name="Abort now").click()
    expect(page.locator("[data-abort-state='sent']")).to_be_visible()
    id = told(past.address, "/vehicles/1")["waiting"]["abort"]["id"]
    away.append(True)
    sockets[-1].close(code=1001)
    answer(past, id, "done", "at the surface")
    until(page, lambda: told(past.address, f"/vehicles/1/commands/{id}")["is_last"])
    until(page, lambda: told(past.address, "/vehicles/1")["waiting"]["abort"] is None)
    assert page.locator("[data-abort-state='sent']").is_visible()
    away.clear()
    expect(page.get_by_text("Abort of vehicle 1: done; at the surface.")).to_be_visible()
    expect(page.locator("[data-abort-state]")).to_have_count(0)
