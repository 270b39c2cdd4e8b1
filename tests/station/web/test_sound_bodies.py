"""Bodies that JSON allows and no archive, page or number takes: refused with a sentence before any route sees them."""

import httpx
import pytest

from stommel.station.web.guards.bodies import unsound


@pytest.mark.parametrize(
    ("body", "words"),
    [
        (b'{"words": "\\ud800"}', "half a character"), (b'{"words": "a\\u0000b"}', "control character"),
        (b'{"words": "\\u0007"}', "control character"), (b'{"\\uDfff": 1}', "half a character"),
        (b'[[{"a": ["\\ud83d"]}]]', "half a character"), (b'{"value": NaN}', "NaN is no number"),
        (b'{"value": -Infinity}', "-Infinity is no number"), (b'{"words": "\xff"}', "not UTF-8"),
        ('{"words": "x"}'.encode("utf-16"), "not UTF-8"),
    ],
)  # fmt: skip
def test_what_nobody_can_keep(quay: httpx.Client, body: bytes, words: str) -> None:
    assert words in (unsound(body) or "")
    answer = quay.post("/api/notes", content=body, headers={"Content-Type": "application/json"})
    assert answer.status_code == 422
    assert words in answer.json()["detail"]["reason"]


@pytest.mark.parametrize(
    "body",
    [
        '{"words": "\\ud83d\\ude00 and 😀"}'.encode(), b'{"words": "NaN and Infinity as words"}', b"{}", b"null",
        b'{"words": "line\\nand\\ttab\\r"}', b'{"words": "\\u00e9"}', b"", b"{", b"[" * 100_000,
    ],
    ids=lambda body: repr(body[:20]),
)  # fmt: skip
def test_what_a_route_may_judge_itself(body: bytes) -> None:
    assert unsound(body) is None


def test_a_note_in_any_script_of_the_world_comes_back(local: httpx.Client) -> None:
    words = "Låg strøm; 海流 0.3 m/s 😀\nsecond line"
    assert local.post("/api/notes", json={"vehicle": 1, "words": words}).status_code in (200, 201)
    assert [row["words"] for row in local.get("/api/notes?vehicle=1").json()] == [words]


@pytest.mark.parametrize(
    ("kind", "body", "words"),
    [
        ("application/x-www-form-urlencoded", b'{"words": "x"}', "the body is not marked as JSON"),
        ("application/json", b"null", "the body must be an object"), ("application/json", b"[]", "must be an object"),
        ("application/json", b'{"words": "  "}', "words = '  ': must not be blank"),
    ],
)  # fmt: skip
def test_a_body_of_another_kind_is_told_what_is_wanted(quay: httpx.Client, kind: str, body: bytes, words: str) -> None:
    """A script that forgets the header of its body is told so."""
    answer = quay.post("/api/notes", content=body, headers={"Content-Type": kind})
    assert answer.status_code == 422
    assert words in answer.json()["detail"]["reason"]
