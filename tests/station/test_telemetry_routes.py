"""Downloads of telemetry. Oracle: samples that are put into the archive, at times that the channels do not share."""

import csv
import io
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from stommel.archive import Archive, Batch
from stommel.station import telemetry
from stommel.station.telemetry import telemetry_pieces
from tests.station.client import Client
from tests.station.stations import station

BEGIN = 1_782_864_000.0
SILENT = "tcp:127.0.0.1:9"
"""Nobody listens at the port `discard`."""
DEPTHS = {BEGIN + 2.0 * k: 0.25 * k for k in range(1000)}
PITCHES = {BEGIN + 3.0 * k: -20.0 + 0.01 * k for k in range(600)}
PHASES = {BEGIN + 7.0 + 100.0 * k: float(k % 4) for k in range(10)}
PLACES = {BEGIN + 60.0 * k: 28.0 + 1e-4 * k for k in range(40)}


@pytest.fixture(scope="module")
def archive_and_client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Archive, Client]]:
    with station(tmp_path_factory.mktemp("station"), SILENT, start=False) as made:
        told = {"depth_m": DEPTHS, "pitch_deg": PITCHES, "phase": PHASES, "latitude_deg": PLACES}
        samples = [(key, t, value) for key, values in told.items() for t, value in values.items()]
        made.archive.store(1, Batch(samples=[*samples, *(("longitude_deg", t, 126.0) for t in PLACES)]))
        yield made.archive, Client(made)


@pytest.fixture(scope="module")
def client(archive_and_client: tuple[Archive, Client]) -> Client:
    return archive_and_client[1]


def test_csv_is_every_sample_of_the_channels_and_the_time_that_are_asked_for(client: Client) -> None:
    query = {"channels": "pitch_deg,depth_m", "begin": BEGIN + 100.0, "end": BEGIN + 1000.0}
    answer = client.request("GET", "/vehicles/1/telemetry.csv", params=query)
    assert 'filename="vehicle-1-telemetry.csv"' in answer.headers["content-disposition"]
    rows = list(csv.DictReader(io.StringIO(answer.text)))
    for key, told in (("depth_m", DEPTHS), ("pitch_deg", PITCHES)):
        found = [(row["time [UTC]"], float(row["value"])) for row in rows if row["channel"] == key]
        wanted = {t: value for t, value in told.items() if BEGIN + 100.0 <= t <= BEGIN + 1000.0}
        assert [value for _, value in found] == list(wanted.values())
        assert found[0][0] == f"{np.datetime64(round(1e3 * min(wanted)), 'ms')}Z"
    assert {row["channel"] for row in rows} == {"depth_m", "pitch_deg"}


def test_all_channels_are_given_where_none_is_named(client: Client) -> None:
    rows = list(csv.DictReader(io.StringIO(client.request("GET", "/vehicles/1/telemetry.csv").text)))
    assert len(rows) == 1000 + 600 + 10 + 2 * 40
    assert [*dict.fromkeys(row["channel"] for row in rows)] == [
        "depth_m", "latitude_deg", "longitude_deg", "phase", "pitch_deg",
    ]  # fmt: skip


def test_netcdf_is_a_cf_trajectory_with_each_sample_at_its_time(client: Client, tmp_path: Path) -> None:
    query = {"channels": "depth_m,pitch_deg,phase,roll_deg"}
    (tmp_path / "told.nc").write_bytes(client.request("GET", "/vehicles/1/telemetry.nc", params=query).content)
    with xr.open_dataset(tmp_path / "told.nc", decode_times=False) as found:
        assert (found.attrs["featureType"], found.attrs["Conventions"]) == ("trajectory", "CF-1.10")
        time = found["time"].values
        assert time.tolist() == sorted({*DEPTHS, *PITCHES, *PHASES})
        for key, told in (("depth_m", DEPTHS), ("pitch_deg", PITCHES), ("phase", PHASES)):
            there = np.isfinite(found[key].values)
            assert dict(zip(time[there].tolist(), found[key].values[there].tolist(), strict=True)) == told
        assert np.isnan(found["roll_deg"].values).all()
        assert found["latitude"].values == pytest.approx(np.interp(time, list(PLACES), list(PLACES.values())), abs=1e-5)
        assert (found["depth_m"].attrs["standard_name"], found["depth_m"].attrs["units"]) == ("depth", "m")
        assert found["pitch_deg"].attrs["units"] == "degree"
        meanings = found["phase"].attrs["flag_meanings"].split()
        assert meanings[found["phase"].attrs["flag_values"].tolist().index(1.0)] == "descent"


def test_an_empty_window_is_an_empty_file(client: Client, tmp_path: Path) -> None:
    query = {"channels": "depth_m", "end": 6.0}
    assert client.request("GET", "/vehicles/1/telemetry.csv", params=query).text == "time [UTC],channel,value\n"
    (tmp_path / "empty.nc").write_bytes(client.request("GET", "/vehicles/1/telemetry.nc", params=query).content)
    with xr.open_dataset(tmp_path / "empty.nc") as found:
        assert found.sizes["obs"] == found["depth_m"].size == 0


def test_pieces_are_bounded_and_come_in_order(
    archive_and_client: tuple[Archive, Client], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(telemetry, "ROWS", 16)
    pieces = list(telemetry_pieces(archive_and_client[0], 1, ["depth_m", "pitch_deg"], BEGIN, BEGIN + 1000.0, 50))
    assert max(piece.sizes["obs"] for piece in pieces) <= 16
    times = np.concatenate([piece["time"].values for piece in pieces])
    assert times.tolist() == sorted({t for t in (*DEPTHS, *PITCHES) if t <= BEGIN + 1000.0})


@pytest.mark.parametrize("ending", ["csv", "nc"])
@pytest.mark.parametrize(
    "query", [{"channels": "gold"}, {"channels": ","}, {"begin": 2.0, "end": 1.0}, {"begin": "nan"}, {"end": 1e30}]
)
def test_wrong_questions_are_refused(client: Client, ending: str, query: dict[str, object]) -> None:
    assert client.refused("GET", f"/vehicles/1/telemetry.{ending}", 422, params=query)["reason"]
    assert client.refused("GET", f"/vehicles/2/telemetry.{ending}", 404)["key"] == "vehicle"
