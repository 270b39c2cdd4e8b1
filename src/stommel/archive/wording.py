"""Words as any database takes them: no character 0, which PostgreSQL refuses, and no halves of characters."""

from sqlalchemy import Dialect, String, Text
from sqlalchemy.types import TypeDecorator


def storable(words: str) -> str:
    """Words without what a database refuses."""
    return words.replace("\0", "").encode("utf-8", "replace").decode()


class Name(TypeDecorator[str]):
    """Column of short words, made clean when they are written."""

    impl = String
    cache_ok = True
    """A statement with it may be kept compiled, since it has no state of its own."""

    def process_bind_param(self, value: str | None, dialect: Dialect) -> str | None:  # noqa: ARG002 - as SQLAlchemy asks
        """Words on their way to the database."""
        return None if value is None else storable(value)


class Words(Name):
    """Column of words of any length, made clean when they are written."""

    impl = Text
    cache_ok = True
    """A statement with it may be kept compiled, since it has no state of its own."""
