"""The archive: one database that many threads read and one at a time writes."""

import threading
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Self

from sqlalchemy import URL, Connection, Engine, select
from sqlalchemy.exc import IntegrityError

from stommel.archive import migrating
from stommel.archive.address import address_of, file_of, shown
from stommel.archive.connecting import WRITING, engine_of
from stommel.archive.curves import ChannelReader
from stommel.archive.errors import ArchiveBusyError, ArchiveFullError, ArchiveRequestError, telling
from stommel.archive.latest import latest_values
from stommel.archive.readers import StoredFrame, kept_messages, stored_ctd, stored_dives, stored_frames, stored_texts
from stommel.archive.rows import Batch, CtdRow, DiveRow, TextRow
from stommel.archive.schema import channels, vehicles
from stommel.archive.series import Series, read_series, window_of
from stommel.archive.sifting import Sifted, sift_batch
from stommel.archive.storing import write_batch
from stommel.archive.times import GREATEST_TIME
from stommel.archive.upserting import insert_rows


class Archive:
    """An open archive, made by `open`.

    Whatever writes is one transaction, on the disk when the call returns, or not there at all. Every method may be
    called from any thread.

    Raises
    ------
    ArchiveError
        By every method, if the database fails; `ArchiveBusyError` and `ArchiveFullError` may pass by themselves.
    """

    def __init__(self, url: URL, engine: Engine, busy_timeout_s: float) -> None:
        self.url = url
        self.name = shown(url)
        self.engine = engine
        self._busy_timeout = busy_timeout_s
        self._one_writer = threading.Lock()
        self._numbers: dict[str, int] = {}
        self.before_writing: Callable[[], None] = _nothing
        """Called in each transaction that writes, before anything is written; what it raises forbids it."""

    @classmethod
    def open(cls, url: str, *, busy_timeout_s: float = 5.0) -> Self:
        """Open the archive at an address, or make it; an older one is brought up to date.

        Parameters
        ----------
        url
            sqlite:///FILE, or postgresql+psycopg://USER@HOST/DATABASE; a bare path is a file of SQLite.
        busy_timeout_s
            How long to wait for another that writes.

        Raises
        ------
        ArchiveRequestError
            The address is none.
        ArchiveBrokenError
            What is there is damaged, or no archive; it is left as it is.
        ArchiveError
            It cannot be opened, or a newer version wrote it.
        """
        address = address_of(url)
        file = file_of(address)
        if file is not None:
            migrating.require_ours(file)
            _make_folder(file)
        archive = cls(address, engine_of(address, busy_timeout_s), busy_timeout_s)
        try:
            with archive.writing() as connection:
                migrating.migrate(connection, archive.name)
        except BaseException:
            archive.close()
            raise
        return archive

    def close(self) -> None:
        """Give back all connections."""
        self.engine.dispose()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @contextmanager
    def reading(self) -> Iterator[Connection]:
        """A connection that sees the archive as it is now, unchanged until the end."""
        with telling(self.name), self.engine.connect() as connection:
            yield connection

    @contextmanager
    def writing(self) -> Iterator[Connection]:
        """A connection that alone may write; committed at the end, or rolled back if anything is raised."""
        if not self._one_writer.acquire(timeout=self._busy_timeout):
            raise ArchiveBusyError(f"{self.name}: the archive is busy writing; try again in a moment")
        try:
            with telling(self.name), self.engine.connect() as connection:
                connection.execution_options(**{WRITING: True})
                with connection.begin():
                    self.before_writing()
                    yield connection
        finally:
            self._one_writer.release()

    @property
    def is_written(self) -> bool:
        """Whether somebody here writes just now: what can wait until later waits, so that no reader does."""
        return self._one_writer.locked()

    def know(self, vehicle: int, name: str, model: str) -> None:
        """Note a vehicle, or its new name; `model` is the name of its vehicle file, or empty."""
        row = {"name": name, "model": model}
        with self.writing() as connection:
            there = connection.execute(vehicles.update().where(vehicles.c.id == vehicle).values(row)).rowcount
            if not there:
                connection.execute(vehicles.insert().values(id=vehicle, added_us=round(time.time() * 1e6), **row))

    def vehicles(self) -> dict[int, str]:
        """Names of the vehicles that are known, by their numbers."""
        with self.reading() as connection:
            rows = connection.execute(select(vehicles.c.id, vehicles.c.name).order_by(vehicles.c.id))
            return {row.id: row.name for row in rows}

    def store(self, vehicle: int, batch: Batch) -> None:
        """Write what a vehicle sent, all of it or nothing; a sample at a known time replaces what was there.

        Samples that are no number up to 1e290 are left out, as those of a time that is none; their frames are kept.

        Raises
        ------
        ArchiveRequestError
            A time of a frame, a text, a dive or a CTD sample is not from 1970 to 2100.
        """
        added: dict[str, int] = {}
        with self.writing() as connection:
            write_batch(connection, vehicle, batch, lambda keys: self._numbers_of(connection, keys, added))
        self._numbers.update(added)

    def store_sound(self, vehicle: int, batch: Batch) -> Sifted:
        """As `store`, but a row that no archive takes is left out and told, so that it holds nothing else up."""
        try:
            self.store(vehicle, batch)
        except (ArchiveRequestError, IntegrityError):
            with self.writing() as connection:  # numbers of channels are not remembered: what is left out has none
                return sift_batch(
                    connection, vehicle, batch, lambda keys: self._numbers_of(connection, keys, {}), self.name
                )
        return Sifted(batch)

    def latest(self, vehicle: int) -> dict[str, tuple[float, float]]:
        """Time and value of the newest sample of each channel, by its key."""
        with self.reading() as connection:
            return latest_values(connection, vehicle)

    def series(
        self,
        vehicle: int,
        key: str,
        begin: float,
        end: float,
        points: int = 2000,
        method: str = "minmax",
        period: float | None = None,
        turn: float | None = None,
    ) -> Series:
        """The samples of a channel from `begin` to `end`, reduced to about `points`, gaps as NaN.

        Parameters
        ----------
        vehicle, key
            A channel that is not there has no samples.
        begin, end
            Both among the range [s since 1970].
        points
            How many at most, beside those that mark gaps.
        method
            'minmax' keeps the lowest and highest of each bucket, 'lttb' the shape, 'raw' everything.
        period
            Usual time between samples [s]; taken from the samples if left out.
        turn
            After which values begin anew, such as 360 of a heading; they do not if left out.

        Raises
        ------
        ArchiveRequestError
            A value is none that is allowed, or there is too much for 'raw'.
        """
        window = window_of(begin, end, points, method, period, turn)
        with self.reading() as connection:
            number = connection.execute(select(channels.c.id).where(channels.c.key == key)).scalar()
            return read_series(ChannelReader(connection, vehicle, -1 if number is None else number, key), window)

    def frames(
        self, vehicle: int, *, before: int | None = None, limit: int = 100, message: int | None = None
    ) -> list[StoredFrame]:
        """The newest frames of a vehicle, newest first: at most `limit`, below the number `before`, of one message."""
        with self.reading() as connection:
            return stored_frames(connection, vehicle, before=before, limit=limit, message=message)

    def messages(self, vehicle: int) -> list[int]:
        """Numbers of the messages of which a vehicle has frames."""
        with self.reading() as connection:
            return kept_messages(connection, vehicle)

    def texts(
        self, vehicle: int, *, begin: float = 0.0, end: float = GREATEST_TIME, limit: int = 1000
    ) -> list[TextRow]:
        """The newest texts of a vehicle in a range [s since 1970], at most `limit`, in order of time."""
        with self.reading() as connection:
            return stored_texts(connection, vehicle, begin=begin, end=end, limit=limit)

    def dives(self, vehicle: int, *, begin: float = 0.0, end: float = GREATEST_TIME) -> list[DiveRow]:
        """The dives of a vehicle that touch a range [s since 1970], in order of their numbers."""
        with self.reading() as connection:
            return stored_dives(connection, vehicle, begin=begin, end=end)

    def ctd(self, vehicle: int, *, begin: float = 0.0, end: float = GREATEST_TIME) -> list[CtdRow]:
        """The CTD samples of a vehicle in a range [s since 1970], in order of time."""
        with self.reading() as connection:
            return list(stored_ctd(connection, vehicle, begin=begin, end=end))

    def _numbers_of(self, connection: Connection, keys: set[str], added: dict[str, int]) -> Mapping[str, int]:
        """Numbers of channels; new ones go to `added`, as they are only there once they are committed."""
        new = sorted(keys - self._numbers.keys())
        if not new:
            return self._numbers
        insert_rows(connection, channels, ("key",), [(key,) for key in new], "keep")
        found = connection.execute(select(channels.c.key, channels.c.id).where(channels.c.key.in_(new)))
        for key, number in found:
            added[key] = number
        return {**self._numbers, **added}


def _nothing() -> None:
    """Before writing, where one may always write."""


def _make_folder(file: Path) -> None:
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ArchiveFullError(
            f"{file}: its folder cannot be made: {error.strerror or error}; name another place"
        ) from error
