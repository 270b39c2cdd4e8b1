"""The body of every answer that refuses, as the document of the API describes it."""

from pydantic import BaseModel

Told = bool | int | float | str | None


class Refusal(BaseModel):
    """A sentence for people, and the key, the value and what is allowed where there is one."""

    reason: str
    key: str | None
    value: Told
    """As it was asked; of what is not a plain value, its words."""
    allowed: str | None


class RefusalDetail(Refusal):
    """The first thing that is wrong, and all of them where several were looked for."""

    problems: list[Refusal] = []


class Refused(BaseModel):
    """An answer of 400 and more."""

    detail: RefusalDetail
