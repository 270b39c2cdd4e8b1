"""Oracle: two dives through water of a known density that are put into the archive; gsw beside the answers."""

import csv
import io
from collections.abc import Iterator
from pathlib import Path

import gsw
import numpy as np
import pytest
import xarray as xr
from pyproj import Geod

from stommel.archive.rows import Batch, CtdRow, DiveRow
from tests.station.client import Client
from tests.station.stations import station

BEGIN = 1_782_864_000.0
SECOND = 1_782_867_000.000003
"""Begin of the second dive: 50 min after the first, and a little."""
WGS84 = Geod(ellps="WGS84")
SILENT = "tcp:127.0.0.1:9"
"""Nobody listens at the port `discard`."""


def dive_rows(dive: int, begin: float, depth: float) -> list[CtdRow]:
    """Down and up at 0.1 dbar/s, a sample each 5 s; warm above 30 dbar, cold below."""
    p = np.concatenate([np.arange(0.0, depth, 0.5), np.arange(depth, 0.0, -0.5)])
    return [
        CtdRow(begin + 5.0 * k, dive, float(pressure), 25.0 if pressure < 30.0 else 15.0, 5.2 if pressure < 30 else 4.2)
        for k, pressure in enumerate(p)
    ]


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Client]:
    with station(tmp_path_factory.mktemp("station"), SILENT, start=False) as made:
        first, second = dive_rows(1, BEGIN, 60.0), dive_rows(2, BEGIN + 3000.0, 40.0)
        times = np.arange(BEGIN - 100.0, BEGIN + 5000.0, 50.0)
        track = [("latitude_deg", t, 28.0 + (t - BEGIN) * 1e-5) for t in times]
        track += [("longitude_deg", t, (179.998 + (t - BEGIN) * 1e-6 + 180.0) % 360.0 - 180.0) for t in times]
        dives = [
            DiveRow(1, BEGIN, BEGIN + 1200.0, 28.0, 126.0, 28.01, 126.0, 59.7, 0.1, -0.2, 900.0),
            DiveRow(2, SECOND),
        ]
        made.archive.store(1, Batch(samples=track, dives=dives, ctd=first + second))
        yield Client(made)


def test_dives_as_they_were_told(client: Client) -> None:
    first, second = client.get("/vehicles/1/dives")
    assert (first["dive"], first["t_begin"], first["t_end"]) == (1, BEGIN, BEGIN + 1200.0)
    assert (first["greatest_depth_m"], first["current_east_m_s"], first["energy_j"]) == (59.7, -0.2, 900.0)
    assert second["t_end"] is None
    assert client.get("/vehicles/1/dives", begin=BEGIN + 1.0)[0]["dive"] == 2


def test_a_dive_tells_how_far_it_came_on_the_ellipsoid(client: Client) -> None:
    first, second = client.get("/vehicles/1/dives")
    assert first["distance_m"] == pytest.approx(WGS84.inv(126.0, 28.0, 126.0, 28.01)[2])
    assert second["distance_m"] is None


def test_a_time_that_was_told_finds_what_it_was_told_of(client: Client) -> None:
    """This begin times 1e-6 is a number that is before it: an end that the dive is not before."""
    dive = client.get("/vehicles/1/dives")[1]
    assert dive["t_begin"] == SECOND
    assert client.get("/vehicles/1/dives", begin=SECOND, end=SECOND) == [dive]


def test_each_dive_has_a_profile_down_and_one_up(client: Client) -> None:
    found = client.get("/vehicles/1/profiles")
    told = [(row["number"], row["direction"], row["dive"]) for row in found]
    assert told == [(1, 1, 1), (2, -1, 1), (3, 1, 2), (4, -1, 2)]
    assert found[0]["greatest_depth_m"] == pytest.approx(-gsw.z_from_p(60.0, 28.0), abs=0.6)
    assert found[2]["latitude"] == pytest.approx(28.0 + 3200.0e-5, abs=2e-4)


def test_a_profile_keeps_its_number_in_a_window(client: Client) -> None:
    assert [row["number"] for row in client.get("/vehicles/1/profiles", begin=BEGIN + 2000.0)] == [3, 4]


def test_positions_go_over_the_date_line_and_not_round_the_world(client: Client) -> None:
    found = client.get("/vehicles/1/profiles")
    assert all(abs(abs(row["longitude"]) - 180.0) < 0.01 for row in found)


def test_values_of_a_profile_are_those_of_teos_10(client: Client) -> None:
    found = client.get("/vehicles/1/profiles/3")
    values = {name: np.array(column, dtype=float) for name, column in found["values"].items()}
    S_P = gsw.SP_from_C(10.0 * values["conductivity"], values["temperature"], values["pressure"])
    S_A = gsw.SA_from_SP(S_P, values["pressure"], values["longitude"], values["latitude"])
    assert values["absolute_salinity"] == pytest.approx(S_A, abs=1e-9)
    assert values["density"] == pytest.approx(
        gsw.rho(S_A, gsw.CT_from_t(S_A, values["temperature"], values["pressure"]), values["pressure"]), abs=1e-6
    )
    assert found["units"]["density"] == "kg m-3"
    assert client.refused("GET", "/vehicles/1/profiles/9", 404)["key"] == "number"


def test_a_section_shows_the_layers(client: Client) -> None:
    found = client.get("/vehicles/1/section", variable="temperature", cell_m=5.0)
    assert len(found["values"]) == len(found["profiles"]) == 4
    assert [row["profile_number"] for row in found["profiles"]] == [1, 2, 3, 4]
    depth = np.array(found["depth_m"])
    for column in found["values"]:
        values = np.array([np.nan if value is None else value for value in column])
        assert values[(depth < 25.0) & np.isfinite(values)] == pytest.approx(25.0)
        assert values[(depth > 35.0) & np.isfinite(values)] == pytest.approx(15.0)
    assert np.isnan([np.nan if value is None else value for value in found["values"][2]][-1])  # 40 m, not 60


def test_a_section_tells_how_far_along_the_track_and_of_how_many_samples(client: Client) -> None:
    """Oracles: geodesics through the mean places of the profiles, over the date line; the samples of each profile."""
    found = client.get("/vehicles/1/section", variable="temperature", cell_m=5.0)
    lines = client.get("/vehicles/1/profiles")
    places = [(row["longitude"], row["latitude"]) for row in lines]
    for k, column in enumerate(found["profiles"]):
        assert column["distance"] == pytest.approx(WGS84.line_length(*zip(*places[: k + 1], strict=True)), abs=1e-6)
    assert 0.0 < found["profiles"][-1]["distance"] < 5000.0  # it swam 0.0375 degrees to the north, at most
    for line, counts, means in zip(lines, found["samples"], found["values"], strict=True):
        assert sum(counts) == pytest.approx(line["samples"], abs=1)  # the last of one may be the first of the next
        assert [count > 0 for count in counts] == [mean is not None for mean in means]


def test_a_ts_diagram_has_two_water_masses_and_lines_between(client: Client) -> None:
    found = client.get("/vehicles/1/ts")
    assert set(np.round(found["conservative_temperature"])) == {15.0, 25.0}
    assert len(found["absolute_salinity"]) == found["samples"] > 300
    assert len(found["lines"]) >= 4


@pytest.mark.parametrize(
    ("path", "query"),
    [
        ("section", {"variable": "gold"}), ("section", {"cell_m": 0.01}), ("section", {"cell_m": "nan"}),
        ("ts", {"begin": -1}), ("profiles", {"end": 1e30}), ("profiles/0", {}), ("profiles/x", {}),
        *((path, {"begin": 2.0, "end": 1.0}) for path in ("dives", "profiles", "section", "ts", "data.csv", "data.nc")),
    ],
)  # fmt: skip
def test_wrong_questions_are_refused(client: Client, path: str, query: dict[str, object]) -> None:
    assert client.refused("GET", f"/vehicles/1/{path}", 422, params=query)["reason"]


def test_no_vehicle_no_data(client: Client) -> None:
    for path in ("dives", "profiles", "section", "ts", "data.csv", "data.nc"):
        assert client.refused("GET", f"/vehicles/2/{path}", 404)["key"] == "vehicle"


def test_csv_and_netcdf_hold_the_same(client: Client, tmp_path: Path) -> None:
    answer = client.request("GET", "/vehicles/1/data.csv", params={"begin": BEGIN, "end": BEGIN + 2000.0})
    assert 'filename="vehicle-1.csv"' in answer.headers["content-disposition"]
    rows = list(csv.DictReader(io.StringIO(answer.text)))
    (tmp_path / "data.nc").write_bytes(
        client.request("GET", "/vehicles/1/data.nc", params={"begin": BEGIN, "end": BEGIN + 2000.0}).content
    )
    with xr.open_dataset(tmp_path / "data.nc") as found:
        assert found.attrs["featureType"] == "trajectory"
        assert found.sizes["obs"] == len(rows) == 240
        pressure = [float(row["pressure [dbar]"]) for row in rows]
        assert found["pressure"].values == pytest.approx(pressure)
        assert str(found["time"].values[1]).startswith(rows[1]["time [UTC]"].removesuffix("Z"))


def test_an_empty_window_is_an_empty_file(client: Client, tmp_path: Path) -> None:
    rows = client.request("GET", "/vehicles/1/data.csv", params={"begin": 5.0, "end": 6.0}).text.splitlines()
    assert len(rows) == 1
    (tmp_path / "empty.nc").write_bytes(client.request("GET", "/vehicles/1/data.nc", params={"end": 6.0}).content)
    with xr.open_dataset(tmp_path / "empty.nc") as found:
        assert found.sizes["obs"] == 0
    assert client.get("/vehicles/1/ts", end=6.0)["samples"] == 0
    assert client.get("/vehicles/1/section", end=6.0)["profiles"] == []
