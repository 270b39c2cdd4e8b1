"""Asking a line's thread: whoever waits is told what was done, in a sentence."""

from concurrent.futures import Future
from pathlib import Path
from threading import Event
from typing import Any

import pytest

from stommel.link.shore.shore_end import ShoreEnd
from stommel.station.vehicles import asking
from stommel.station.vehicles.asking import ask
from stommel.station.vehicles.opening import LateError, VehicleError
from tests.station.stations import station
from tests.support.ports import port_of_nobody
from tests.support.waiting import WITHIN


def test_what_takes_long_is_told_apart_from_what_is_not_done(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    begun, is_told = Event(), Event()

    def slow(_end: ShoreEnd, _t: float) -> None:
        begun.set()
        is_told.wait(WITHIN)

    with port_of_nobody() as port, station(tmp_path, f"tcp:127.0.0.1:{port}") as found:
        line = found.vehicles[1]
        given = line.ask

        def ask_and_see_it_begin(function: Any) -> "Future[Any]":
            future = given(function)
            assert begun.wait(WITHIN)
            return future

        monkeypatch.setattr(asking, "ANSWER_WITHIN", 0.05)
        monkeypatch.setattr(line, "ask", ask_and_see_it_begin)
        try:
            with pytest.raises(LateError, match="what has become of it"):
                ask(line, slow)
        finally:
            is_told.set()


def test_what_waits_when_the_station_ends_is_told_so(tmp_path: Path) -> None:
    with port_of_nobody() as port, station(tmp_path, f"tcp:127.0.0.1:{port}", start=False) as found:
        line = found.vehicles[1]
        put = line._requests.put_nowait

        def last(request: object) -> None:
            put(request)  # type: ignore[arg-type]
            line._finish()

        line._requests.put_nowait = last  # type: ignore[assignment, method-assign]
        with pytest.raises(VehicleError, match="station ends"):
            ask(line, lambda _end, _t: None)
