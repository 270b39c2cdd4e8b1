"""The command line: one file a verb. Errors that a user can mend are one line each and exit status 2."""

import errno
import os
import sys
from collections.abc import Callable
from typing import NoReturn

from stommel.cli.status import DEFECT, INTERRUPTED, USAGE_ERROR

_NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)
"""Why an answer cannot be written to standard output."""


_LONGEST_LINE = 480
"""Characters of a line of an error, whatever was given."""


def main() -> NoReturn:
    """Run the command line; no traceback reaches a user, unless STOMMEL_TRACEBACK is set."""
    if sys.stdout is None:  # closed by the caller, as with `>&-`
        sys.stdout = open(os.devnull, "w")  # noqa: PTH123, SIM115 - stands until the process ends
    try:
        status = _run()
    except KeyboardInterrupt:  # while modules still load
        status = INTERRUPTED
    except Exception as error:  # noqa: BLE001 - told as one line; nothing else may reach a user
        status = _defect(error)
    sys.exit(status)


def _run() -> int:
    import typer

    from stommel.cli.app import app
    from stommel.errors import StommelError

    try:
        status = app(standalone_mode=False)
    except StommelError as error:
        return _fail(str(error), USAGE_ERROR)
    except typer.TyperException as error:
        return _fail(_usage_message(error), USAGE_ERROR)
    except (KeyboardInterrupt, typer.Abort):
        return INTERRUPTED
    except BrokenPipeError:
        # the reader of our output has gone, as with `| head`; keep Python from complaining at exit
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except OSError as error:
        if error.errno not in _NO_ROOM:
            raise
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return _fail(f"the answer cannot be written: {error.strerror}", USAGE_ERROR)
    return status if isinstance(status, int) else 0


def _defect(error: Exception) -> int:
    if os.environ.get("STOMMEL_TRACEBACK"):
        raise error
    what = f"{type(error).__name__}: {error}".replace("\n", " ")
    return _fail(f"this is a defect of stommel, please report it (STOMMEL_TRACEBACK=1 shows where): {what}", DEFECT)


def _usage_message(error: Exception) -> str:
    """Return the sentence of a usage error, with the option it is about."""
    write: Callable[[], str] | None = getattr(error, "format_message", None)
    return write() if write is not None else str(error)


def _fail(message: str, status: int) -> int:
    from stommel.errors import one_line

    for line in message.splitlines():
        print(f"error: {one_line(line, _LONGEST_LINE)}", file=sys.stderr)  # noqa: T201 - this is the command line
    return status
