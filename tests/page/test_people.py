"""People on the page, against a real station at which one logs in."""

from typing import Any

from tests.page.manned import PASSWORD, kind, sign_in, status
from tests.page.waiting import PATIENCE_S, becomes


def test_a_wrong_password_is_told_and_the_right_one_lets_in(page: Any, manned: str) -> None:
    page.goto(f"{manned}/#/people")
    page.get_by_label("Name").fill("ling")
    page.get_by_label("Password").fill("not this one")
    page.get_by_role("button", name="Sign in").click()
    page.get_by_role("alert").wait_for()
    page.get_by_label("Password").fill(PASSWORD)
    page.get_by_role("button", name="Sign in").click()
    page.get_by_text("Signed in as ling").wait_for()
    page.get_by_text("Users and the audit log are for admins").wait_for()
    assert page.get_by_role("button", name="Add a person…").count() == 0


def test_an_admin_adds_somebody_who_can_sign_in_and_is_kept_out_again(
    page: Any, browser: Any, manned: str, screenshot: Any
) -> None:
    from playwright.sync_api import expect

    sign_in(page, manned, "ada", "people")
    page.get_by_role("button", name="Add a person…").click()
    dialog = page.get_by_role("dialog", name="Add a person")
    dialog.get_by_label("Name").fill("nora")
    dialog.get_by_label("First password").fill("short")
    dialog.get_by_label("Role").select_option("viewer")
    dialog.get_by_role("button", name="Add").click()
    expect(dialog.get_by_role("alert")).to_contain_text("10 to 200 characters")
    expect(dialog.get_by_label("Name")).to_have_value("nora")  # nothing typed is lost
    dialog.get_by_label("First password").fill(PASSWORD)
    dialog.get_by_role("button", name="Add").click()
    page.locator("[data-user='nora']").wait_for()
    other = browser.new_context()
    other.set_default_timeout(1e3 * PATIENCE_S)
    tab = other.new_page()
    sign_in(tab, manned, "nora", "people")
    tab.get_by_text("Signed in as nora").wait_for()
    page.get_by_label("nora may sign in").uncheck()
    page.get_by_text("nora is kept out").wait_for()
    tab.reload()
    tab.get_by_role("button", name="Sign in").wait_for()
    other.close()
    page.get_by_role("button", name="Read again").click()
    page.get_by_role("region", name="Audit log").get_by_text("add user").first.wait_for()
    assert PASSWORD not in page.content()
    screenshot("people")


def test_a_token_is_shown_once_works_and_is_refused_once_removed(page: Any, manned: str) -> None:
    """Oracle: what the API answers to whoever shows the token."""
    sign_in(page, manned, "ling", "people")
    page.get_by_role("button", name="Make a token…").click()
    dialog = page.get_by_role("dialog", name="Make a token")
    becomes(page, dialog.get_by_label("Role").locator("option").all_inner_texts, ["viewer", "pilot"])
    dialog.get_by_label("What it is for").fill("nightly download")
    dialog.get_by_role("button", name="Make it").click()
    secret = page.locator("[data-secret]").inner_text()
    assert status(manned, "/vehicles", secret) == 200
    page.get_by_role("button", name="I have it").click()
    page.locator("[data-secret]").wait_for(state="detached")
    page.reload()
    page.locator("[data-token]", has_text="nightly download").wait_for()
    assert secret not in page.content()
    page.get_by_role("button", name="Remove token nightly download").click()
    page.get_by_role("dialog").get_by_role("button", name="Remove", exact=True).click()
    page.get_by_text("is removed").wait_for()
    assert status(manned, "/vehicles", secret) == 401


def test_an_expired_session_asks_to_sign_in_and_what_was_typed_is_there_again(page: Any, manned: str) -> None:
    """Issue: nothing is lost."""
    from playwright.sync_api import expect

    sign_in(page, manned, "max", "vehicle/1/commands")
    kind(page, "radio-time").click()
    page.get_by_label("time, s").fill("777")
    page.context.clear_cookies()
    page.reload()
    page.get_by_label("Name").fill("max")
    page.get_by_label("Password").fill(PASSWORD)
    page.get_by_role("button", name="Sign in").click()
    expect(page.get_by_label("time, s")).to_have_value("777")
