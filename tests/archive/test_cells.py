"""Cells are what the samples of each come to, whatever came late, twice or again: oracle is a search."""

from collections.abc import Iterator
from itertools import count

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sqlalchemy import select

from stommel.archive import Archive, Batch
from stommel.archive.cells import LEVELS
from stommel.archive.schema import channels

T = 1_700_000_000

Sample = tuple[str, float, float]


@pytest.fixture(scope="module")
def shared(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Archive]:
    with Archive.open(str(tmp_path_factory.mktemp("cells") / "archive.sqlite")) as opened:
        yield opened


samples = st.tuples(
    st.sampled_from(["a", "b", "c"]),
    st.one_of(st.integers(0, 400), st.integers(3500, 3800), st.integers(0, 10**6)).map(lambda t: T + t / 2),
    st.integers(-5, 5).map(float),
)
batches = st.lists(st.lists(samples, max_size=30), min_size=1, max_size=6)
_vehicles = count(1)


def check_cells(archive: Archive, vehicle: int, given: list[list[Sample]]) -> None:
    last = {(key, round(t * 1e6)): value for batch in given for key, t, value in batch}
    with archive.reading() as connection:
        keys = {row.id: row.key for row in connection.execute(select(channels))}
        for level in LEVELS:
            expected: dict[tuple[str, int], list[tuple[int, float]]] = {}
            for (key, t_us), value in sorted(last.items()):
                expected.setdefault((key, t_us // level.width_us), []).append((t_us, value))
            table = level.table
            found = connection.execute(select(table).where(table.c.vehicle_id == vehicle)).all()
            assert {(keys[row.channel_id], row[2]) for row in found} == expected.keys()
            for row in found:
                members = expected[keys[row.channel_id], row[2]]
                low = min(members, key=lambda point: (point[1], point[0]))
                high = min(members, key=lambda point: (-point[1], point[0]))
                total = sum(value for _, value in members)
                assert row[3:] == (len(members), total, *members[0], *members[-1], *low, *high)


@given(batches)
@settings(max_examples=80, deadline=None)
def test_cells_follow_their_samples(shared: Archive, given: list[list[Sample]]) -> None:
    vehicle = next(_vehicles)
    for batch in given:
        shared.store(vehicle, Batch(samples=batch))
    check_cells(shared, vehicle, given)


def test_cells_follow_their_samples_in_both_databases(archive: Archive) -> None:
    def piece(begin: int, end: int, value: float) -> list[Sample]:
        return [(key, T + t / 2, value + t % 7) for key in "ab" for t in range(begin, end)]

    given = [
        piece(0, 200, 1.0),
        piece(200, 300, 0.0),
        piece(100, 150, 50.0),
        piece(700, 701, 2.0),
        piece(400, 500, 1.0),
    ]
    given.append([("a", T + 60.0, -9.0), ("a", T + 60.0, -8.0)])
    for batch in given:
        archive.store(1, Batch(samples=batch))
    check_cells(archive, 1, given)
