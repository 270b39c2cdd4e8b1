"""The options that typer gives every command, to complete words in a shell: answered in one line, or refused in one."""

from collections.abc import Callable
from contextlib import redirect_stderr, redirect_stdout
from io import StringIO
from typing import Any

from stommel.errors import StommelError

INSTALL, SHOW = "--install-completion", "--show-completion"


class CompletionError(StommelError):
    """Completion of words cannot be installed or shown."""


def completion_answer(option: str, run: Callable[[], Any]) -> str:
    """What there is to say of INSTALL or SHOW, which `run` carries out: a line, or the script that was asked for.

    Raises
    ------
    CompletionError
        The shell is not known, or its files cannot be read or written.
    """
    said = StringIO()
    try:
        with redirect_stdout(said), redirect_stderr(said):
            run()
    except SystemExit as end:
        if end.code:
            raise _unknown_shell(option) from None
        text = said.getvalue().rstrip("\n")
        return text if option == SHOW else f"{text.splitlines()[0]}; it works from the next start of the shell"
    except OSError as error:
        raise CompletionError(f"{option}: {error.filename}: {error.strerror}") from None
    except UnicodeDecodeError:
        raise CompletionError(f"{option}: the file with which the shell begins is not UTF-8 text") from None
    raise _unknown_shell(option)


def _unknown_shell(option: str) -> CompletionError:
    return CompletionError(f"{option}: the shell in use must be bash, zsh, fish or PowerShell")
