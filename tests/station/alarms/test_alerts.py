"""Alerts to people who are away: which, when, and that they arrive; receivers on this machine are the oracle."""

import email
import hashlib
import hmac
import json
import re
import time
from collections.abc import Sequence
from dataclasses import replace
from email import policy
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from stommel.station.alarms.alarm import Alarm
from stommel.station.alarms.alert_policy import Alert, AlertPolicy
from stommel.station.alarms.alert_settings import AlertSettings, EmailSettings, WebhookSettings
from stommel.station.alarms.alert_words import Sender, subject, text
from stommel.station.alarms.alerts import Alerts
from stommel.station.alarms.delivery import MOST_WAITING, OLDEST_S, Courier, DeliveryError
from stommel.station.alarms.waiting_alerts import WaitingAlerts
from stommel.station.alarms.webhook_way import SIGNATURE, WebhookWay
from tests.station.alarms.receivers import MailReceiver, certificate_in, mail_server, web_server
from tests.station.stations import station
from tests.support.ports import port_of_nobody
from tests.support.waiting import until

T0 = 1_700_000_000.0
DEEP = Alarm(1, 1, "limit:depth_m:high", "Depth greater than 200 m", "critical", T0, 203.0)
SENDER = Sender("Test station", lambda number: f"Zhong {number}", "https://station.example.org/")


def kinds(alerts: Sequence[Alert]) -> list[tuple[str, int]]:
    return [(alert.kind, alert.times) for alert in alerts]


# which and when


def test_what_is_less_than_asked_for_is_told_to_nobody() -> None:
    policy = AlertPolicy(AlertSettings(least_severity="critical"))
    assert policy.take(replace(DEEP, severity="warning"), 0.0) == []
    assert kinds(policy.take(DEEP, 0.0)) == [("raised", 1)]


def test_a_flapping_alarm_is_told_once_and_then_counted() -> None:
    policy = AlertPolicy(AlertSettings(quiet_s=900.0))
    told = []
    for n in range(600):
        t = float(n)
        told += policy.take(DEEP, t) + policy.take(replace(DEEP, cleared=T0 + n), t) + policy.look(t)
    assert kinds(told) == [("raised", 1), ("cleared", 1)]
    assert policy.look(899.0) == []
    assert kinds(policy.look(900.0)) == [("repeated", 599)]
    assert policy.look(1800.0) == []
    assert kinds(policy.take(DEEP, 1801.0)) == [("raised", 1)]


@given(st.lists(st.tuples(st.floats(0.0, 600.0), st.booleans()), max_size=80), st.floats(1.0, 2000.0))
def test_no_alarm_floods_and_none_is_forgotten(steps: list[tuple[float, bool]], quiet: float) -> None:
    """At most two messages for each quiet time that was begun, and every raising is counted in one."""
    policy = AlertPolicy(AlertSettings(quiet_s=quiet))
    t, raised, alerts = 0.0, 0, []
    for pause, is_raised in steps:
        t += pause
        alerts += policy.look(t)
        raised += is_raised
        alerts += policy.take(DEEP if is_raised else replace(DEEP, cleared=T0), t)
    alerts += policy.look(t + quiet + 1.0)
    assert sum(alert.times for alert in alerts if alert.kind != "cleared") == raised
    told = sum(alert.kind != "cleared" for alert in alerts)
    assert told <= (t + quiet + 1.0) / quiet + 1.0


def test_words_are_one_line_each_whatever_an_alarm_is_called() -> None:
    nasty = replace(DEEP, words="Depth\r\nBcc: all@example.org\x00 " + 500 * "x")
    alerts = [Alert("raised", nasty), Alert("cleared", replace(DEEP, severity="notice", cleared=T0 + 60.0))]
    assert "\n" not in subject(alerts, SENDER)
    assert subject(alerts[1:], SENDER) == "[Test station] Over: Depth greater than 200 m (Zhong 1)"
    lines = text(alerts, SENDER).splitlines()
    assert len(lines) == 4
    assert lines[1] == "Over: Depth greater than 200 m (Zhong 1), 2023-11-14 22:13:20 UTC to 2023-11-14 22:14:20 UTC"
    assert lines[3] == "Page of the station: https://station.example.org/"


# settings

EMAIL: dict[str, Any] = {"host": "localhost", "sender": "station@example.org", "recipients": ["pilot@example.org"]}


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"email": {**EMAIL, "recipients": []}}, "at least 1 item"),
        ({"email": {**EMAIL, "recipients": ["pilot"]}}, "must be an e-mail address"),
        ({"email": {**EMAIL, "recipients": ["a@b\nBcc: c@d"]}}, "must be an e-mail address"),
        ({"email": {**EMAIL, "host": "mail.example.org", "tls": "none"}}, "on this machine only, not mail.example.org"),
        ({"email": {**EMAIL, "user": "me"}}, "go together"),
        ({"email": {**EMAIL, "port": 70000}}, "less than or equal to 65535"),
        ({"webhooks": [{"url": "http://example.org/x"}]}, "must begin with https://"),
        ({"webhooks": [{"url": "file:///etc/passwd"}]}, "must be an address"),
        ({"webhooks": [{"url": "https://a:b@example.org/"}]}, "must be an address"),
        ({"webhooks": [{"url": "https://[::1"}]}, "must be an address"),
        ({"quiet_s": -1}, "greater than or equal to 0"),
        ({"least_severity": "awful"}, "'notice', 'warning' or 'critical'"),
        ({"colour": "red"}, "Extra inputs"),
    ],
)
def test_settings_that_cannot_be_are_refused(settings: dict[str, Any], words: str) -> None:
    with pytest.raises(ValidationError, match=words):
        AlertSettings.model_validate(settings)


# that they arrive


class Reports:
    """What the station hears of its ways."""

    def __init__(self) -> None:
        self.told: list[str] = []

    def __call__(self, way: str, reason: str) -> None:
        if not self.told or self.told[-1] != reason:
            self.told.append(reason)


def email_settings(port: int, tmp_path: Path, **rest: Any) -> AlertSettings:
    return AlertSettings(email=EmailSettings(**{**EMAIL, "port": port, **rest}))


@pytest.mark.parametrize("tls", ["starttls", "tls"])
def test_an_e_mail_goes_out_encrypted_with_a_login(tls: str, tmp_path: Path) -> None:
    certificate, receiver, reports = certificate_in(tmp_path), MailReceiver(), Reports()
    password = tmp_path / "password"
    password.write_text("secret word\n")
    options: dict[str, Any] = {"authenticator": receiver.login, "auth_required": True, "auth_require_tls": True}
    if tls == "tls":
        options |= {"ssl_context": certificate.server(), "auth_require_tls": False, "auth_required": False}
    else:
        options |= {"tls_context": certificate.server(), "require_starttls": True}
    with mail_server(receiver, **options) as port:
        settings = email_settings(
            port, tmp_path, tls=tls, user="station", password_file=password, ca_file=certificate.certificate
        )
        alerts = Alerts(settings, SENDER, reports)
        alerts.start()
        alerts.take(DEEP)
        until(lambda: receiver.mails)
        alerts.stop()
    mail = email.message_from_bytes(receiver.mails[0], policy=policy.default)
    assert mail["Subject"] == "[Test station] Critical: Depth greater than 200 m (Zhong 1)"
    assert mail["To"] == "pilot@example.org"
    assert "2023-11-14 22:13:20 UTC" in mail.get_content()
    assert receiver.users == ["station"]
    assert receiver.tls == [True] or tls == "tls"
    assert reports.told == [""]


def test_a_mail_server_whose_certificate_nobody_knows_is_told_nothing(tmp_path: Path) -> None:
    certificate, receiver = certificate_in(tmp_path), MailReceiver()
    with mail_server(receiver, tls_context=certificate.server()) as port:
        (tried,) = Alerts(email_settings(port, tmp_path), SENDER, Reports()).test("ana")
    assert not tried.sent
    assert "certificate" in tried.reason.lower()
    assert receiver.mails == []


def test_a_mail_server_that_fails_is_tried_again_and_told_of(tmp_path: Path) -> None:
    receiver, reports = MailReceiver(refusals=2), Reports()
    with mail_server(receiver) as port:
        alerts = Alerts(email_settings(port, tmp_path, tls="none"), SENDER, reports, waits=[0.01])
        alerts.start()
        alerts.take(DEEP)
        until(lambda: receiver.mails)
        until(lambda: reports.told[-1:] == [""])
        alerts.stop()
    assert len(receiver.mails) == 1
    assert reports.told == ["e-mail through localhost: answers 451 the disk is full", ""]


def test_one_recipient_whom_the_server_does_not_know_floods_nobody(tmp_path: Path) -> None:
    receiver, reports = MailReceiver(), Reports()
    receiver.unknown = {"gone@example.org"}
    with mail_server(receiver) as port:
        recipients = ("pilot@example.org", "gone@example.org")
        settings = email_settings(port, tmp_path, tls="none", recipients=recipients)
        alerts = Alerts(settings, SENDER, reports, waits=[0.01])
        alerts.start()
        alerts.take(DEEP)
        until(lambda: reports.told)
        time.sleep(0.3)
        alerts.take(replace(DEEP, cleared=T0 + 1.0))
        until(lambda: len(receiver.mails) > 1)
        alerts.stop()
    subjects = [email.message_from_bytes(mail, policy=policy.default)["Subject"] for mail in receiver.mails]
    assert len(set(subjects)) == len(subjects) == 2
    assert reports.told == ["e-mail through localhost: refuses gone@example.org; the others were told"]


def test_nobody_at_the_port_is_a_sentence(tmp_path: Path) -> None:
    with port_of_nobody() as port:
        (tried,) = Alerts(email_settings(port, tmp_path, tls="none"), SENDER, Reports()).test("ana")
    assert tried.reason.startswith("e-mail through localhost: ")
    assert "refused" in tried.reason


def test_a_webhook_is_told_and_can_know_by_the_signature_who_told(tmp_path: Path) -> None:
    """Oracle: RFC 2104 by the standard library, over the bytes that came."""
    secret = tmp_path / "secret"
    secret.write_text("abc\n")
    with web_server() as server:
        hook = WebhookSettings(url=f"http://127.0.0.1:{server.server_port}/alarms?a=1", secret_file=secret)
        alerts = Alerts(AlertSettings(webhooks=(hook,)), SENDER, Reports())
        alerts.start()
        alerts.take(DEEP)
        until(lambda: server.requests)
        alerts.stop()
    path, headers, body = server.requests[0]
    assert path == "/alarms?a=1"
    assert headers[SIGNATURE] == "sha256=" + hmac.digest(b"abc", body, hashlib.sha256).hex()
    told = json.loads(body)
    assert told["station"] == "Test station"
    assert [(one["kind"], one["alarm"]["key"]) for one in told["alerts"]] == [("raised", "limit:depth_m:high")]


def test_a_webhook_follows_nobody_elsewhere() -> None:
    with web_server(307, 302) as server:
        alerts = Alerts(
            AlertSettings(webhooks=(WebhookSettings(url=f"http://127.0.0.1:{server.server_port}/a"),)),
            SENDER,
            Reports(),
        )
        tried = [alerts.test("ana")[0], alerts.test("ana")[0]]
    assert [one.reason for one in tried] == [
        f"webhook at 127.0.0.1: answers {status}; it leads elsewhere, which is not followed" for status in (307, 302)
    ]
    assert [path for path, _, _ in server.requests] == ["/a", "/a"]


def test_a_webhook_over_tls_needs_a_certificate_that_is_known(tmp_path: Path) -> None:
    certificate = certificate_in(tmp_path)
    with web_server(context=certificate.server()) as server:
        url = f"https://localhost:{server.server_port}/"
        known = WebhookSettings(url=url, ca_file=certificate.certificate)
        tried = Alerts(AlertSettings(webhooks=(known, WebhookSettings(url=url))), SENDER, Reports()).test("ana")
    assert [one.sent for one in tried] == [True, False]
    assert "certificate" in tried[1].reason.lower()


def test_a_secret_that_is_not_there_is_named(tmp_path: Path) -> None:
    hook = WebhookSettings(url="http://127.0.0.1:9/", secret_file=tmp_path / "secret")
    (tried,) = Alerts(AlertSettings(webhooks=(hook,)), SENDER, Reports()).test("ana")
    assert f"{tmp_path / 'secret'}: the secret cannot be read" in tried.reason


class DeadWay:
    """Never brings anything."""

    name = file = "dead"

    def __init__(self) -> None:
        self.tries = 0

    def send(self, alerts: Sequence[Alert]) -> None:
        self.tries += 1
        raise DeliveryError("dead: no")


def test_a_way_that_is_dead_holds_a_bounded_queue_and_nobody_up() -> None:
    way, reports = DeadWay(), Reports()
    courier = Courier(way, reports, waits=[0.001])
    courier.start()
    for _ in range(3 * MOST_WAITING):
        courier.put([Alert("raised", DEEP)])
    until(lambda: way.tries > 3)
    assert courier.dropped == 2 * MOST_WAITING
    courier.stop()
    assert reports.told == ["dead: no"]


# over a restart


def hook_of(server: Any) -> AlertSettings:
    return AlertSettings(webhooks=(WebhookSettings(url=f"http://127.0.0.1:{server.server_port}/alarms"),))


def told_by(server: Any) -> list[list[tuple[str, str]]]:
    """Kind and key of each alert of each request."""
    bodies = [json.loads(body) for _, _, body in server.requests]
    return [[(one["kind"], one["alarm"]["key"]) for one in body["alerts"]] for body in bodies]


@pytest.mark.parametrize("is_killed", [False, True], ids=["stopped", "killed"])
def test_an_alert_that_waits_when_the_station_ends_goes_out_after_it_is_started_anew(
    tmp_path: Path, is_killed: bool
) -> None:
    with web_server(503) as server:
        before = Alerts(hook_of(server), SENDER, Reports(), waits=[3600.0], folder=tmp_path / "alerts")
        before.start()
        before.take(DEEP)
        until(lambda: server.requests)
        if not is_killed:
            before.stop()
        after = Alerts(hook_of(server), SENDER, Reports(), folder=tmp_path / "alerts")
        after.start()
        until(lambda: len(server.requests) == 2)
        after.stop()
        again = Alerts(hook_of(server), SENDER, Reports(), folder=tmp_path / "alerts")
        again.start()
        again.take(replace(DEEP, key="leak"))
        until(lambda: len(server.requests) == 3)
        again.stop()
        if is_killed:
            before.stop()
    deep = [("raised", "limit:depth_m:high")]
    assert told_by(server) == [deep, deep, [("raised", "leak")]], "once more, and not again"


def test_an_alert_that_waited_says_how_late_it_is_and_one_of_yesterday_is_not_told(tmp_path: Path) -> None:
    now = time.time()
    old, late = replace(DEEP, key="old"), replace(DEEP, key="late")
    waited = [Alert("raised", old, 1, now - OLDEST_S - 60.0), Alert("raised", late, 1, now - 7200.0)]
    with web_server() as server:
        settings = hook_of(server)
        way = WebhookWay(settings.webhooks[0], SENDER)
        WaitingAlerts(tmp_path, way.file).write(waited)
        alerts = Alerts(settings, SENDER, Reports(), folder=tmp_path)
        alerts.start()
        until(lambda: server.requests)
        alerts.stop()
    assert told_by(server) == [[("raised", "late")]]
    told = json.loads(server.requests[0][2])
    assert re.search(r"; told 12\d min late, it did not go out before", told["text"])
    assert told["alerts"][0]["since"] == waited[1].since
    assert WaitingAlerts(tmp_path, way.file).read() == []


@pytest.mark.parametrize("content", [b"", b"garbage", b"{}"])
def test_a_damaged_file_of_alerts_stops_no_new_ones(tmp_path: Path, content: bytes) -> None:
    with web_server() as server:
        settings = hook_of(server)
        (tmp_path / WebhookWay(settings.webhooks[0], SENDER).file).write_bytes(content)
        alerts = Alerts(settings, SENDER, Reports(), folder=tmp_path)
        alerts.start()
        alerts.take(DEEP)
        until(lambda: server.requests)
        alerts.stop()
    assert told_by(server) == [[("raised", "limit:depth_m:high")]]


def test_two_webhooks_of_one_host_have_files_of_their_own_that_tell_no_secret(tmp_path: Path) -> None:
    files = {WebhookWay(WebhookSettings(url=f"https://example.org/{name}"), SENDER).file for name in ("s3cret", "b")}
    assert len(files) == 2
    assert not any("s3cret" in file for file in files)


def test_a_station_keeps_its_alerts_in_its_folder(tmp_path: Path) -> None:
    with web_server(*[503] * 100) as server:
        hooks = {"webhooks": [{"url": f"http://127.0.0.1:{server.server_port}/a"}]}
        with station(tmp_path, "tcp:127.0.0.1:9", alerts=hooks) as found:
            found.alarms.alerts.take(DEEP)
            until(lambda: server.requests)
        (file,) = (tmp_path / "alerts").iterdir()
        assert DEEP in [alert.alarm for alert in WaitingAlerts(tmp_path / "alerts", file.name).read()]
