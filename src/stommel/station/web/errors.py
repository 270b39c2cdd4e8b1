"""One shape of every error: a sentence for people, and the key, the value and what is allowed where there is one."""

from typing import Any

from fastapi import HTTPException


def refusal(
    status: int,
    reason: str,
    *,
    key: str | None = None,
    value: Any = None,
    allowed: str | None = None,
    headers: dict[str, str] | None = None,
) -> HTTPException:
    """Error to raise from a route.

    Parameters
    ----------
    status
        HTTP status, 400 to 499; 503 where the station cannot for the moment.
    reason
        Sentence for people: what happened and what to do.
    key, value, allowed
        The field that is to be mended, what it was, and what may stand there.
    """  # fmt: skip
    detail = {"reason": reason, "key": key, "value": value, "allowed": allowed}
    return HTTPException(status, detail, headers)
