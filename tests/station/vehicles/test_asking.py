"""Asking a line's thread: whoever waits is told what was done, in a sentence."""

import time
from pathlib import Path

import pytest

from stommel.link.shore.shore_end import ShoreEnd
from stommel.station.vehicles import asking
from stommel.station.vehicles.asking import ask
from stommel.station.vehicles.opening import LateError, VehicleError
from tests.station.stations import station
from tests.support.ports import free_port


def slow(_end: ShoreEnd, _t: float) -> None:
    time.sleep(0.5)


def test_what_takes_long_is_told_apart_from_what_is_not_done(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(asking, "ANSWER_WITHIN", 0.15)
    with (
        station(tmp_path, f"tcp:127.0.0.1:{free_port()}") as found,
        pytest.raises(LateError, match="what has become of it"),
    ):
        ask(found.vehicles[1], slow)


def test_what_waits_when_the_station_ends_is_told_so(tmp_path: Path) -> None:
    with station(tmp_path, f"tcp:127.0.0.1:{free_port()}", start=False) as found:
        line = found.vehicles[1]
        put = line._requests.put_nowait

        def last(request: object) -> None:
            put(request)  # type: ignore[arg-type]
            line._finish()

        line._requests.put_nowait = last  # type: ignore[assignment, method-assign]
        with pytest.raises(VehicleError, match="station ends"):
            ask(line, slow)
