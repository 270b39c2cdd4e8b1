"""Alarms, limits, notes, layers and replays ask both databases the same. Oracle: what was written."""

from stommel.archive import Archive, Batch
from stommel.station.alarms.alarm import Alarm
from stommel.station.alarms.history import History
from stommel.station.alarms.limit_table import LimitTable
from stommel.station.alarms.limits import Limit
from stommel.station.layers.layers import Layers
from stommel.station.logbook.feed import page_of
from stommel.station.logbook.notes import Notes
from stommel.station.replay.reading import channel_keys, samples_between, texts_between, values_at

T0 = 1_700_000_000.0


def test_alarms_are_added_once_cleared_and_acknowledged(archive: Archive) -> None:
    archive.know(1, "Zhong", "zju")
    history = History(archive)
    raised = Alarm(None, 1, "limit:depth_m:high", "Depth greater than 200 m", "critical", T0, 203.0)
    own = Alarm(None, None, "alerts_failing", "Alerts do not go out", "warning", T0 + 1.0)
    number, other = history.add(raised), history.add(own)
    assert history.add(raised) == number
    assert history.add(own) == other
    assert [alarm.id for alarm in history.open_alarms()] == [number, other]
    history.acknowledge(number, "ana", "seen", T0 + 5.0)
    history.clear(number, T0 + 9.0)
    assert history.alarm(number) == Alarm(
        number, 1, raised.key, raised.words, "critical", T0, 203.0, T0 + 9.0, T0 + 5.0, "ana", "seen"
    )
    assert [alarm.id for alarm in history.listed()] == [other, number]
    assert [alarm.id for alarm in history.listed(before=other)] == [number]
    assert [alarm.id for alarm in history.listed(vehicle=1, is_open=False, is_acknowledged=True)] == [number]
    assert history.add(raised) not in (number, other)


def test_limits_are_put_and_taken_away(archive: Archive) -> None:
    archive.know(1, "Zhong", "zju")
    table, limit = LimitTable(archive), Limit(channel="depth_m", high=200.0)
    table.add_new(1, [limit], "vehicle file")
    table.put(1, limit.model_copy(update={"high": 100.0}), "ana")
    table.add_new(1, [limit], "vehicle file")
    assert [found.high for found in table.limits_of(1)] == [100.0]
    table.remove(1, "depth_m", "ana")
    table.add_new(1, [limit], "vehicle file")
    assert table.limits_of(1) == []


def test_notes_are_found_and_paged(archive: Archive) -> None:
    archive.know(1, "Zhong", "zju")
    notes = Notes(archive)
    made = [notes.add(1, T0 + n // 2, "ana", f"Note {n} at 100%") for n in range(5)]
    assert notes.listed(vehicle=1, search="NOTE 100%") == made[::-1]
    assert notes.listed(search="note_") == []
    assert notes.listed(before=made[2].id) == made[1::-1]
    page = page_of(archive, 1, limit=3, search="note")
    rest = page_of(archive, 1, limit=3, search="note", before=page.next)
    assert [entry.id for entry in (*page.entries, *rest.entries)] == [str(note.id) for note in made[::-1]]
    assert rest.next is None


def test_layers_come_back_as_they_were(archive: Archive) -> None:
    layers = Layers(archive)
    made = layers.add_geojson("Wreck", {"type": "Point", "coordinates": [122, 30]})
    assert layers.listed() == [made]
    assert layers.image(made.id) is None
    assert layers.remove(made.id)
    assert layers.listed() == []


def test_the_past_is_read_in_order(archive: Archive) -> None:
    archive.know(1, "Zhong", "zju")
    samples = [(key, T0 + n, float(n)) for n in range(10) for key in ("depth_m", "pitch_deg")]
    archive.store(1, Batch(samples=samples, texts=[(T0 + 3.0, 4, "hello")]))
    with archive.reading() as connection:
        known = channel_keys(connection, 1)
        found, reached = samples_between(connection, 1, known, T0 + 2.0, T0 + 5.0)
        assert sorted(found) == sorted(sample for sample in samples if T0 + 2.0 < sample[1] <= T0 + 5.0)
        assert [t for _, t, _ in found] == sorted(t for _, t, _ in found)
        assert reached == T0 + 5.0
        assert values_at(connection, 1, known, T0 + 4.5) == dict.fromkeys(("depth_m", "pitch_deg"), (T0 + 4.0, 4.0))
        assert texts_between(connection, 1, T0, T0 + 10.0) == [(T0 + 3.0, 4, "hello")]
