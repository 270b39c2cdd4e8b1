"""What a browser finds at the door: who asks, one shape of errors, strict headers, the page."""

import httpx


def test_at_the_station_itself_nobody_logs_in(quay: httpx.Client) -> None:
    told = quay.get("/api/station").json()
    assert told["user"] == {"name": "local", "role": "admin"}
    assert told["login_required"] is False
    assert told["name"] == "Pier 3"


def test_elsewhere_a_stranger_sees_the_name_and_no_more(address: str) -> None:
    told = httpx.get(f"{address}/api/station").json()
    assert (told["user"], told["login_required"]) == (None, True)
    answer = httpx.get(f"{address}/api/audit")
    assert answer.status_code == 401
    assert answer.json()["detail"]["reason"] == "log in first"


def test_every_answer_has_strict_headers(quay: httpx.Client) -> None:
    for path in ("/", "/api/station", "/api/nothing", "/nothing"):
        headers = quay.get(path).headers
        policy = headers["content-security-policy"]
        assert "script-src 'self';" in policy
        assert "frame-ancestors 'none'" in policy
        assert headers["x-content-type-options"] == "nosniff"
        assert headers["referrer-policy"] == "no-referrer"
        assert "access-control-allow-origin" not in headers
    assert quay.get("/api/station").headers["cache-control"] == "no-store"


def test_errors_have_one_shape(quay: httpx.Client) -> None:
    for answer in (
        quay.get("/api/nothing"), quay.post("/api/station"), quay.get("/api/audit?limit=0"),
        quay.post("/api/users", json={"name": "x"}), quay.post("/api/users", content=b"{"),
        quay.get("/api/vehicles/2/holder"), quay.get("/api/vehicles/abc/holder"), quay.put("/api/nothing"),
        quay.post("/api/users", content=b"{}", headers={"content-type": "application/json; charset=latin-1"}),
    ):  # fmt: skip
        assert 400 <= answer.status_code < 500
        assert {"reason", "key", "value", "allowed"} <= set(answer.json()["detail"]), answer.text
    assert quay.get("/api/nothing").status_code == 404
    assert quay.post("/api/station").status_code == 405
    assert quay.post("/api/station").headers["allow"] == "GET"


def test_an_error_names_key_value_and_what_is_allowed(quay: httpx.Client) -> None:
    detail = quay.get("/api/audit?limit=5000").json()["detail"]
    assert detail["key"] == "limit"
    assert detail["value"] == "5000"
    assert "1000" in detail["allowed"]
    assert "limit" in detail["reason"]
