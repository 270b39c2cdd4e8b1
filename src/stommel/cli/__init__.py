"""The command line: one file a verb. Errors that a user can mend are one line each and exit status 2."""

import os
import sys

USAGE_ERROR, DEFECT, INTERRUPTED = 2, 1, 130


def main() -> None:
    """Run the command line; no traceback reaches a user, unless STOMMEL_TRACEBACK is set."""
    from stommel.cli.app import app
    from stommel.errors import StommelError

    try:
        app()
    except StommelError as error:
        for line in str(error).splitlines():
            print(f"error: {line}", file=sys.stderr)  # noqa: T201 - this is the command line
        sys.exit(USAGE_ERROR)
    except KeyboardInterrupt:
        sys.exit(INTERRUPTED)
    except BrokenPipeError:
        # the reader of our output has gone, as with `| head`; keep Python from complaining at exit
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(0)
    except Exception as error:
        if os.environ.get("STOMMEL_TRACEBACK"):
            raise
        print(  # noqa: T201 - this is the command line
            f"error: this is a defect of stommel, please report it: {type(error).__name__}: {error} "
            "(set STOMMEL_TRACEBACK=1 to see where)",
            file=sys.stderr,
        )
        sys.exit(DEFECT)
