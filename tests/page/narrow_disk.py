"""The station's program on a disk that is full while a file is there: SQLite itself refuses then what needs room.

`python -m tests.page.narrow_disk FILE station ...`
"""

import sys
from pathlib import Path

from sqlalchemy import Connection, Engine, event

from stommel.cli import main

LEAST_PAGES, MOST_PAGES = 1, 4_294_967_294
"""Of a database: it is never made smaller than it is."""


def narrow(full: Path) -> None:
    """Let every database have no more room while the file is there."""

    def begin(connection: Connection) -> None:
        pages = LEAST_PAGES if full.exists() else MOST_PAGES
        connection.exec_driver_sql(f"PRAGMA max_page_count = {pages}")

    event.listen(Engine, "begin", begin)


if __name__ == "__main__":
    narrow(Path(sys.argv.pop(1)))
    main()
