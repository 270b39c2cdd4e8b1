"""The command, as in tests/cli."""

from tests.cli.conftest import stommel

__all__ = ["stommel"]
