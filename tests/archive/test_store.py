"""What is stored is there, whole, in both databases; what is not stored is not there at all."""

import math
import threading

import pytest
from sqlalchemy import func, select

from stommel.archive import Archive, ArchiveRequestError, Batch, CtdRow, DiveRow, FrameRow, TextRow
from stommel.archive.columns import metadata
from stommel.archive.readers import frames_between
from stommel.archive.schema import channels, frames, samples, vehicles
from tests.archive.every_sample import every_sample

T = 1_700_000_000.0


def frame(k: int, message: int = 30) -> FrameRow:
    return FrameRow(T + k / 2, "in" if k % 2 else "out", 1, 1, message, k % 256, k % 3 == 0, bytes([0xFD, k % 256]))


def rows_of_all_tables(archive: Archive) -> dict[str, int]:
    with archive.reading() as connection:
        return {
            name: connection.execute(select(func.count()).select_from(table)).scalar_one()
            for name, table in metadata.tables.items()
        }


def test_everything_of_a_batch_is_read_as_it_was_given(archive: Archive) -> None:
    frame_rows = [frame(k) for k in range(5)]
    dives = [DiveRow(1, T, T + 100.5, 30.1, 122.2, 30.2, 122.3, 81.5, 0.1, -0.2, 1234.5), DiveRow(2, T + 101)]
    ctd = [CtdRow(T + 0.25, 1, 10.5, 18.25, 4.5), CtdRow(T + 1.25, None, None, 18.0, None)]
    texts = [(T + 3, 6, "below"), (T + 2, 4, "leak? ' \" ünïcode")]
    archive.store(7, Batch(frame_rows, [("depth_m", T, 1.5), ("pitch_deg", T, -30.0)], texts, dives, ctd))
    assert [stored.row for stored in reversed(archive.frames(7))] == frame_rows
    assert archive.latest(7) == {"depth_m": (T, 1.5), "pitch_deg": (T, -30.0)}
    assert archive.texts(7) == [TextRow(T + 2, 4, "leak? ' \" ünïcode"), TextRow(T + 3, 6, "below")]
    assert archive.dives(7) == dives
    assert archive.ctd(7) == ctd


def test_vehicles_are_kept_apart(archive: Archive) -> None:
    archive.store(1, Batch([frame(1)], [("depth_m", T, 1.0)]))
    archive.store(2, Batch([frame(2)], [("depth_m", T, 2.0)]))
    assert archive.latest(1) == {"depth_m": (T, 1.0)}
    assert archive.latest(2) == {"depth_m": (T, 2.0)}
    assert [stored.row for stored in archive.frames(2)] == [frame(2)]
    assert archive.latest(3) == {}


def test_a_vehicle_keeps_its_name_while_it_sends(archive: Archive) -> None:
    archive.store(3, Batch(samples=[("depth_m", T, 1.0)]))
    archive.know(3, "Kelp", "zju")
    archive.store(3, Batch(samples=[("depth_m", T + 1, 1.0)]))
    with archive.reading() as connection:
        rows = connection.execute(select(vehicles.c.id, vehicles.c.name, vehicles.c.model)).all()
    assert rows == [(3, "Kelp", "zju")]


def test_a_sample_at_a_known_time_is_replaced(archive: Archive) -> None:
    archive.store(1, Batch(samples=[("depth_m", T, 1.0), ("depth_m", T + 1, 9.0), ("depth_m", T, 2.0)]))
    archive.store(1, Batch(samples=[("depth_m", T + 1, 3.0)]))
    assert every_sample(archive, 1, T, T + 5) == [("depth_m", T, 2.0), ("depth_m", T + 1, 3.0)]


def test_a_dive_is_completed_by_a_later_row(archive: Archive) -> None:
    archive.store(1, Batch(dives=[DiveRow(4, T)]))
    archive.store(1, Batch(dives=[DiveRow(4, T, greatest_depth_m=3.0), DiveRow(4, T, T + 9, greatest_depth_m=80.0)]))
    assert archive.dives(1) == [DiveRow(4, T, T + 9, greatest_depth_m=80.0)]
    assert archive.dives(1, begin=T + 10) == []


def test_dives_of_a_new_mission_replace_none_of_the_one_before(archive: Archive) -> None:
    """A vehicle counts the dives of each mission from 1."""
    first = [DiveRow(1, T, T + 9, greatest_depth_m=80.0), DiveRow(2, T + 10, T + 19)]
    archive.store(1, Batch(dives=first))
    archive.store(1, Batch(dives=[DiveRow(1, T + 30, T + 39, greatest_depth_m=20.0)]))
    assert archive.dives(1) == [*first, DiveRow(1, T + 30, T + 39, greatest_depth_m=20.0)]


def test_numbers_that_are_none_are_left_out_and_their_frame_kept(archive: Archive) -> None:
    bad = [("a", T, math.nan), ("a", T + 1, math.inf), ("a", math.nan, 1.0), ("a", -1.0, 1.0), ("a", 1e18, 1.0)]
    archive.store(1, Batch([frame(1)], [*bad, ("a", T + 2, 5.0)]))
    assert archive.latest(1) == {"a": (T + 2, 5.0)}
    assert len(archive.frames(1)) == 1


@pytest.mark.parametrize(
    "bad",
    [
        Batch([frame(1)._replace(t=math.nan)], [("a", T, 1.0)]),
        Batch([frame(1)], [("a", T, 1.0)], dives=[DiveRow(1, T, 5e12)]),
        Batch([frame(1)], [("a", T, 1.0)], ctd=[CtdRow(-1.0, 1, 1.0, 1.0, 1.0)]),
        Batch([frame(1)], [("a", T, 1.0)], texts=[(math.inf, 1, "x")]),
    ],
    ids=["frame", "dive", "ctd", "text"],
)
def test_a_batch_with_a_time_that_is_none_leaves_nothing_behind(archive: Archive, bad: Batch) -> None:
    before = rows_of_all_tables(archive)
    with pytest.raises(ArchiveRequestError, match="allowed are 0 to 4102444800"):
        archive.store(1, bad)
    assert rows_of_all_tables(archive) == before


def test_a_channel_of_a_batch_that_failed_can_be_stored_afterwards(archive: Archive) -> None:
    """Numbers of channels are remembered; those of a batch that was rolled back are not in the database."""
    with pytest.raises(ArchiveRequestError):
        archive.store(1, Batch(samples=[("new", T, 1.0)], texts=[(math.nan, 1, "x")]))
    archive.store(1, Batch(samples=[("other", T, 2.0)]))
    archive.store(1, Batch(samples=[("new", T, 1.0)]))
    assert archive.latest(1) == {"new": (T, 1.0), "other": (T, 2.0)}


def test_frames_are_listed_newest_first_page_by_page(archive: Archive) -> None:
    archive.store(1, Batch([frame(k, message=30 + k % 2) for k in range(10)]))
    newest = archive.frames(1, limit=4)
    assert [stored.row.sequence for stored in newest] == [9, 8, 7, 6]
    older = archive.frames(1, before=newest[-1].number, limit=4)
    assert [stored.row.sequence for stored in older] == [5, 4, 3, 2]
    assert [stored.row.sequence for stored in archive.frames(1, message=31)] == [9, 7, 5, 3, 1]
    for limit in (0, 10_001):
        with pytest.raises(ArchiveRequestError, match="allowed are 1 to 10000"):
            archive.frames(1, limit=limit)


def test_frames_of_a_range_come_in_order_of_time(archive: Archive) -> None:
    archive.store(1, Batch([frame(k) for k in (3, 1, 2, 8)]))
    with archive.reading() as connection:
        found = [stored.row.sequence for stored in frames_between(connection, 1, T, T + 2)]
    assert found == [1, 2, 3]


def test_words_that_a_database_does_not_take_are_stored_without_them(archive: Archive) -> None:
    archive.store(1, Batch(texts=[(T, 6, "a\0b"), (T + 1, 6, "half \ud800")]))
    assert [row.words for row in archive.texts(1)] == ["ab", "half ?"]


def test_the_greatest_numbers_of_a_radio_message_fit(archive: Archive) -> None:
    row = FrameRow(T, "in", 255, 255, 0xFFFFFF, 255, True, bytes(280))
    archive.store(1, Batch([row], dives=[DiveRow(0xFFFFFFFF, T)], ctd=[CtdRow(T, 0xFFFFFFFF, 1e38, -1e38, 1e-45)]))
    assert archive.dives(1) == [DiveRow(0xFFFFFFFF, T)]
    assert archive.ctd(1) == [CtdRow(T, 0xFFFFFFFF, 1e38, -1e38, 1e-45)]
    assert archive.frames(1)[0].row == row


def test_texts_are_the_newest_of_their_range(archive: Archive) -> None:
    archive.store(1, Batch(texts=[(T + k, 6, f"text {k}") for k in range(10)]))
    assert [row.words for row in archive.texts(1, end=T + 5, limit=2)] == ["text 4", "text 5"]


def test_many_threads_store_and_read_at_once(archive: Archive) -> None:
    failures: list[BaseException] = []

    def work(number: int) -> None:
        try:
            for k in range(20):
                archive.store(number, Batch([frame(k)], [(f"c{k}", T + k, float(k))]))
                assert archive.latest(number)[f"c{k}"] == (T + k, float(k))
        except BaseException as error:  # noqa: BLE001 - told below, in the thread of the test
            failures.append(error)

    threads = [threading.Thread(target=work, args=(number,)) for number in range(1, 6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert failures == []
    counted = rows_of_all_tables(archive)
    assert (counted["frames"], counted["samples"], counted["channels"]) == (100, 100, 20)


def test_nothing_is_read_of_what_is_still_being_written(archive: Archive) -> None:
    with archive.writing() as connection:
        connection.execute(channels.insert().values(key="x"))
        with archive.reading() as other:
            assert other.execute(select(func.count()).select_from(channels)).scalar_one() == 0


def test_an_exception_in_the_middle_of_writing_rolls_back(archive: Archive) -> None:
    def fail() -> None:
        with archive.writing() as connection:
            connection.execute(channels.insert().values(key="x"))
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        fail()
    assert rows_of_all_tables(archive)["channels"] == 0


def test_the_vehicle_of_a_frame_must_be_there(archive: Archive) -> None:
    from sqlalchemy.exc import IntegrityError

    archive.store(1, Batch([frame(1)]))
    with pytest.raises(IntegrityError), archive.writing() as connection:
        connection.execute(frames.update().values(vehicle_id=99))
    with archive.reading() as connection:
        assert connection.execute(select(func.count()).select_from(samples)).scalar_one() == 0
