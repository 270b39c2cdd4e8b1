"""Studies as their users run them: any number of workers, killed and started again, on a cluster."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from tests.studies.conftest import UNIFORM, Write, run, start

HYPERCUBE = 'kind = "latin_hypercube"\nruns = 24\nseed = 7\n' + UNIFORM


def finished(folder: Path, name: str) -> dict[str, int]:
    return {path.name: path.stat().st_mtime_ns for path in folder.glob(f"{name}.runs/[0-9]*/[0-9]*.json")}


def wait_for_runs(folder: Path, name: str, count: int, process: subprocess.Popen[str]) -> None:
    end = time.monotonic() + 240.0
    while len(finished(folder, name)) < count:
        assert process.poll() is None, process.communicate()
        assert time.monotonic() < end
        time.sleep(0.02)


def test_same_bytes_on_one_and_two_workers_killed_and_interrupted(folder: Path, write: Write) -> None:
    study = write(HYPERCUBE)
    one = run(folder, study, "--workers", 1, "--output", "one.nc")
    assert (one["flown"], one["kept"], one["failed"]) == (24, 0, [])
    expected = (folder / "one.nc").read_bytes()

    process = start(folder, study, "--workers", 2, "--output", "two.nc")
    wait_for_runs(folder, "two.nc", 3, process)
    process.send_signal(signal.SIGKILL)
    process.communicate()
    killed = finished(folder, "two.nc")
    assert 3 <= len(killed) < 24
    assert not (folder / "two.nc").exists()

    process = start(folder, study, "--workers", 2, "--output", "two.nc")
    wait_for_runs(folder, "two.nc", len(killed) + 3, process)
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=60)
    interrupted = finished(folder, "two.nc")
    assert process.returncode == 130
    assert f"{len(interrupted)} of 24 runs are kept" in err
    assert len(interrupted) < 24

    two = run(folder, study, "--workers", 2, "--output", "two.nc")
    assert (two["flown"], two["kept"]) == (24 - len(interrupted), len(interrupted))
    last = finished(folder, "two.nc")
    assert all(last[name] == stamp for name, stamp in (killed | interrupted).items())
    assert (folder / "two.nc").read_bytes() == expected

    result = xr.load_dataset(folder / "one.nc")
    assert result.sizes["run"] == 24
    assert set(result.outcome.values) == {"time over"}
    assert len(np.unique(result.seed)) == 24
    # steeper flight makes more dives, and moves the mass farther in each: what was asked for was flown
    assert float(xr.corr(result.pitch_deg, result.energy_wh_pitch_drive)) > 0.9

    study.write_text(study.read_text().replace("to = 45", "to = 44"))
    process = start(folder, study, "--output", "two.nc")
    _, err = process.communicate(timeout=60)
    assert process.returncode == 2
    assert "differs in: parameters" in err
    assert "--restart" in err


def test_sweep_in_zarr_with_a_run_that_fails(folder: Path, write: Write) -> None:
    study = write(
        'kind = "sweep"\noutputs = ["dives", "distance_made_good_km"]\nseed = 3\n'
        '[[parameters]]\nkey = "ocean.current_north_m_s"\nfrom = 0.0\nto = 0.2\nsteps = 2\n'
        '[[parameters]]\nkey = "mission.dives.ballast_ml"\nname = "drive"\nvalues = [150, 200, 5000]\n'
    )
    done = run(folder, study, "--workers", 1, "--output", "sweep.zarr")
    assert [failure["run"] for failure in done["failed"]] == [2, 5]
    assert "the engine needs" in done["failed"][0]["reason"]
    result = xr.open_zarr(folder / "sweep.zarr").load()
    assert result.dives.dims == ("current_north_m_s", "drive")
    assert result.drive.values == pytest.approx([150.0, 200.0, 5000.0])
    assert np.isnan(result.dives.sel(drive=5000)).all()
    assert (result.failure.sel(drive=150) == "").all()
    further = result.distance_made_good_km.sel(drive=150).values
    assert further[1] - further[0] == pytest.approx(0.2 * 0.04 * 86.4, rel=0.1)
    assert "days" not in result
    first = {path.name: path.read_bytes() for path in (folder / "sweep.zarr").rglob("*") if path.is_file()}
    again = run(folder, study, "--workers", 1, "--output", "sweep.zarr")
    assert again["kept"] == 6
    assert first == {path.name: path.read_bytes() for path in (folder / "sweep.zarr").rglob("*") if path.is_file()}


@contextmanager
def dask(*arguments: object, folder: Path) -> Iterator[subprocess.Popen[bytes]]:
    program = Path(sys.executable).with_name("dask")
    process = subprocess.Popen(
        [program, *map(str, arguments)],
        cwd=folder,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    try:
        yield process
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()


def test_on_a_dask_cluster_that_loses_a_worker(folder: Path, write: Write) -> None:
    pytest.importorskip("distributed", reason="needs the extra cluster")
    study = write(HYPERCUBE)
    run(folder, study, "--workers", 1, "--output", "here.nc")
    file = folder / "scheduler.json"
    worker = ("worker", "--scheduler-file", file, "--nthreads", 1, "--no-dashboard", "--host", "127.0.0.1")
    scheduler = ("scheduler", "--scheduler-file", file, "--host", "127.0.0.1", "--port", 0, "--no-dashboard")
    with (
        dask(*scheduler, folder=folder),
        dask(*worker, "--name", "stays", folder=folder),
        dask(*worker, "--name", "goes", folder=folder) as goes,
    ):
        end = time.monotonic() + 60.0
        while not file.exists():
            assert time.monotonic() < end
            time.sleep(0.05)
        import json

        address = json.loads(file.read_text())["address"]
        process = start(folder, study, "--scheduler", address, "--output", "there.nc", "--json")
        wait_for_runs(folder, "there.nc", 4, process)
        os.killpg(goes.pid, signal.SIGKILL)
        before = len(finished(folder, "there.nc"))
        out, err = process.communicate(timeout=240)
        assert process.returncode == 0, err
    assert before < 24
    assert json.loads(out)["flown"] == 24
    assert (folder / "there.nc").read_bytes() == (folder / "here.nc").read_bytes()


def test_any_field_of_vehicle_mission_sensors_and_ocean(folder: Path, write: Write) -> None:
    """Each value reaches its run: the result shows what it does."""
    study = write(
        'kind = "sweep"\nsame_noise = true\n'
        + "".join(
            f'[[parameters]]\nkey = "{key}"\nvalues = {values}\n'
            for key, values in {
                "mission.leak.rate_ml_min": "[0, 200]",
                "mission.sampling.every_s": "[10, 20]",
                "vehicle.hydrodynamics.drag_kg_m": "[2.5, 3.5]",
                "ocean.blend_km": "[10]",
                "mission.seed": "[1, 2]",
                "mission.physics": '["full", "paper"]',
            }.items()
        )
    )
    run(folder, study, "--workers", 1, "--output", "r.nc")
    result = xr.load_dataset(folder / "r.nc")
    assert result.dives.dims == ("rate_ml_min", "every_s", "drag_kg_m", "blend_km", "mission_seed", "physics")
    assert (result.failure == "").all()
    assert (result.outcome.sel(rate_ml_min=200) == "aborted, waiting at the surface").all()
    assert (result.outcome.sel(rate_ml_min=0) == "time over").all()
    tight = result.sel(rate_ml_min=0, blend_km=10)
    assert (tight.flown_speed_m_s.sel(drag_kg_m=3.5) < 0.95 * tight.flown_speed_m_s.sel(drag_kg_m=2.5)).all()
    assert (
        tight.distance_through_water_km.sel(drag_kg_m=3.5) < tight.distance_through_water_km.sel(drag_kg_m=2.5)
    ).all()
    assert (tight.seed.sel(mission_seed=2) == 2).all()
    assert (tight.reckoning_error_m_mean.sel(mission_seed=1) != tight.reckoning_error_m_mean.sel(mission_seed=2)).all()
    assert tight.ctd_samples.sel(every_s=10).values == pytest.approx(
        2.0 * tight.ctd_samples.sel(every_s=20).values, abs=9
    )


def test_numbers_of_a_profile_can_be_changed(folder: Path, write: Write) -> None:
    (folder / "water.csv").write_text("depth_m,temperature_c,salinity_psu\n0,28,33.5\n50,26,34\n200,15,34.6\n")
    mission = folder / "hop.toml"
    mission.write_text(mission.read_text().replace('name = "uniform"', 'file = "water.csv"'))
    study = write('kind = "sweep"\n[[parameters]]\nkey = "ocean.current_east_m_s"\nvalues = [0.0, 0.2]\n')
    done = run(folder, study, "--workers", 1, "--output", "r.nc")
    assert done["failed"] == []
    result = xr.load_dataset(folder / "r.nc")
    assert float(result.distance_over_ground_km[1]) > float(result.distance_over_ground_km[0]) + 0.1
