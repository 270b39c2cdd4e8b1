"""Finds texts by their words, whatever their case and order."""

from sqlalchemy import ColumnElement, and_, func, or_

MOST_WORDS = 10


def has_words(search: str, *columns: ColumnElement[str]) -> ColumnElement[bool]:
    """Whether each of the words is in one of the columns; further words than the first ten are passed over."""
    return and_(True, *(or_(*(_has(column, word) for column in columns)) for word in search.split()[:MOST_WORDS]))


def _has(column: ColumnElement[str], word: str) -> ColumnElement[bool]:
    return func.coalesce(column, "").icontains(word, autoescape=True)
