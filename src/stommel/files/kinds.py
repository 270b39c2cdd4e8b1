"""Dates, flags and names of files, each as itself: 20260701 is a number and no date, 1 and "yes" are not true."""

from datetime import date, datetime
from typing import Annotated, Any, Literal

from pydantic import Field, PlainValidator
from pydantic_core import PydanticCustomError

OWN_WORDS = "own_words"
"""Kind of an error of pydantic whose words are ours; they say what is allowed."""

Flag = Annotated[bool, Field(strict=True)]
"""true or false."""


def _first_format(value: Any) -> Literal[1]:
    if type(value) is not int or value != 1:  # 1.0 and true are equal to it
        raise PydanticCustomError(OWN_WORDS, "must be 1")
    return 1


def _moment(value: Any) -> datetime:
    """Take a date of the file, or ISO 8601 text; a number of seconds or days is none."""
    if isinstance(value, datetime):
        return value
    if isinstance(value, date):
        return datetime(value.year, value.month, value.day)
    if isinstance(value, str):
        try:
            return datetime.fromisoformat(value.strip())
        except ValueError:
            pass
    raise PydanticCustomError(OWN_WORDS, "must be a date with a time and a time zone, such as 2026-07-01T12:00:00Z")


def _names(value: Any) -> str | tuple[str, ...]:
    """Take one name, or a list of them."""
    if isinstance(value, str):
        return value
    if isinstance(value, list | tuple) and value and all(isinstance(name, str) for name in value):
        return tuple(value)
    raise PydanticCustomError(OWN_WORDS, "must be text, the name of a file or a pattern, or a list of such names")


Format = Annotated[Literal[1], PlainValidator(_first_format)]
"""Version of a file's layout."""
Moment = Annotated[datetime, PlainValidator(_moment)]
"""A date with a time, written as TOML writes it or as ISO 8601 text."""
FileNames = Annotated[str | tuple[str, ...], PlainValidator(_names)]
"""One name of a file, or a list of names."""
