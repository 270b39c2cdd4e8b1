"""The command line: one file a verb. Errors that a user can mend are one line each and exit status 2."""

import errno
import os
import sys
from typing import NoReturn

from stommel.cli.status import CLOSED_PIPE, DEFECT, INTERRUPTED, USAGE_ERROR

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
        sys.stdout.flush()  # a short answer leaves only now
    except BrokenPipeError:
        status = _closed_pipe()
    except KeyboardInterrupt:  # while modules still load
        status = INTERRUPTED
    except Exception as error:  # noqa: BLE001 - told as one line; nothing else may reach a user
        status = _defect(error)
    sys.exit(status)


def _run() -> int:
    import typer

    from stommel.cli.app import app
    from stommel.cli.completion import INSTALL, SHOW, completion_answer
    from stommel.cli.usage import usage_message
    from stommel.errors import StommelError

    try:
        option = next((word for word in sys.argv[1:2] if word in (INSTALL, SHOW)), None)
        if option is not None:
            typer.echo(completion_answer(option, lambda: app(standalone_mode=False)))
            return 0
        status = app(standalone_mode=False)
    except StommelError as error:
        return _fail(str(error), USAGE_ERROR)
    except typer.TyperException as error:
        return _fail(usage_message(error), USAGE_ERROR)
    except (KeyboardInterrupt, typer.Abort):
        return INTERRUPTED
    except SystemExit as end:
        # typer makes this of a closed pipe
        if isinstance(end.__context__, BrokenPipeError):
            return _closed_pipe()
        raise
    except OSError as error:
        if error.errno not in _NO_ROOM:
            raise
        _forget_output()
        return _fail(f"the answer cannot be written: {error.strerror}", USAGE_ERROR)
    return status if isinstance(status, int) else 0


def _closed_pipe() -> int:
    """End as programs do whose reader has gone, as with `| head`: quietly."""
    _forget_output()
    return CLOSED_PIPE


def _forget_output() -> None:
    """Keep Python from complaining at its end about what it cannot write."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.__stdout__.fileno() if sys.__stdout__ is not None else 1)


def _defect(error: Exception) -> int:
    if os.environ.get("STOMMEL_TRACEBACK"):
        raise error
    what = f"{type(error).__name__}: {error}".replace("\n", " ")
    return _fail(f"this is a defect of stommel, please report it (STOMMEL_TRACEBACK=1 shows where): {what}", DEFECT)


def _fail(message: str, status: int) -> int:
    from stommel.errors import one_line

    for line in message.splitlines():
        print(f"error: {one_line(line, _LONGEST_LINE)}", file=sys.stderr)  # noqa: T201 - this is the command line
    return status
