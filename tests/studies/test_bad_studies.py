"""A study that cannot be run is refused with one line that says why, before anything is flown."""

import resource
import subprocess
from pathlib import Path

import pytest

from tests.studies.conftest import UNIFORM, Write, refused, run
from tests.support.command import PROGRAM

SWEEP = 'kind = "sweep"\n[[parameters]]\n'


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            SWEEP + 'key = "mission.dives.depht_m"\nvalues = [1]',
            ["mission.dives.depht_m", "did you mean mission.dives.depth_m"],
        ),
        (SWEEP + 'key = "vehicle.mass"\nvalues = [1]', ["'vehicle.mass'", "zju.toml has no such number"]),
        (SWEEP + 'key = "ocean.current_m_s"\nvalues = [1]', ["'ocean.current_m_s'", "current_east_m_s"]),
        (SWEEP + 'key = "sensors.gps_noise"\nvalues = [1]', ["did you mean sensors.gps_noise_m"]),
        (SWEEP + 'key = "dives.depth_m"\nvalues = [1]', ["parameters.0.key", "dives.depth_m"]),
        (SWEEP + 'key = "mission.dives.depth_m"\nvalues = []', ["values = []", "at least one value"]),
        (SWEEP + 'key = "mission.dives.depth_m"\nvalues = [40, "deep"]', ["values", "all numbers"]),
        (SWEEP + 'key = "mission.dives.pitch_deg"\nvalues = [35, 70]', ["mission.dives.pitch_deg = 70", "60"]),
        (SWEEP + 'key = "mission.dives.depth_m"\nfrom = 1\nto = 2', ["from, to and steps"]),
        (SWEEP + 'key = "mission.dives.depth_m"\nvalue = [1]', ["value", "did you mean values"]),
        ('kind = "sweep"', ["[parameters] is missing"]),
        ('kind = "monte_carlo"\n' + UNIFORM, ["runs is missing"]),
        ('kind = "monte_carlo"\nruns = -3\n' + UNIFORM, ["runs = -3", "between 1 and 1000000"]),
        ('kind = "sobol"\nruns = 12\n' + UNIFORM, ["runs = 12", "power of 2", "16"]),
        ('kind = "guess"\nruns = 3\n' + UNIFORM, ["kind = 'guess'", "latin_hypercube"]),
        ('kind = "monte_carlo"\nruns = 3\n' + UNIFORM.replace("uniform", "cauchy"), ["'cauchy'", "lognormal"]),
        ('kind = "monte_carlo"\nruns = 3\n' + UNIFORM.replace("to = 45", ""), ["needs from and to"]),
        ('kind = "monte_carlo"\nruns = 3\n' + UNIFORM.replace("to = 45", "to = 2"), ["from must be less than to"]),
        (
            'kind = "monte_carlo"\nruns = 3\n' + UNIFORM.replace("pitch_deg", "per_surfacing"),
            ["mission.dives.per_surfacing", "is a whole number", "sweep"],
        ),
        (
            SWEEP + 'key = "mission.dives.per_surfacing"\nfrom = 1\nto = 2\nsteps = 3',
            ["mission.dives.per_surfacing", "is a whole number"],
        ),
        (SWEEP + 'key = "mission.seed"\nname = "seed"\nvalues = [1, 2]', ["name = 'seed'", "is taken"]),
        (SWEEP + 'key = "mission.ctd.cell_shares"\nvalues = [0]', ["did you mean mission.ctd.cell_share"]),
        (SWEEP + 'key = "ocean.blend_kn"\nvalues = [1]', ["did you mean ocean.blend_km"]),
        ("kind = ", ["is not valid TOML"]),
    ],
)
def test_refused_with_one_line(folder: Path, write: Write, text: str, words: list[str]) -> None:
    from stommel.errors import FileError
    from stommel.studies.study import load_study

    with pytest.raises(FileError) as caught:
        load_study(write(text))
    message = str(caught.value)
    assert "\n" not in message
    assert message.startswith(str(folder / "study.toml"))
    for word in words:
        assert word in message


def test_refused_by_the_command(folder: Path, write: Write) -> None:
    study = write('kind = "monte_carlo"\nruns = 3\n' + UNIFORM)
    assert "must end with .nc or .zarr" in refused(folder, study, "--output", "result.csv")
    assert "--workers = 0: must be between 1 and 1024" in refused(folder, study, "--workers", 0)
    assert "missing.toml: cannot be read: No such file" in refused(folder, "missing.toml")
    nobody = refused(folder, study, "--scheduler", "nonsense://1")
    assert "--scheduler nonsense://1: must look like tcp://host:8786" in nobody
    assert not (folder / "study.nc").exists()


def test_scheduler_that_does_not_answer(folder: Path, write: Write) -> None:
    import threading

    pytest.importorskip("distributed", reason="needs the extra cluster")
    from stommel.studies.errors import StudyError
    from stommel.studies.running import fly_on_cluster
    from stommel.studies.study import load_study

    study = load_study(write('kind = "monte_carlo"\nruns = 3\n' + UNIFORM))
    flights = fly_on_cluster(
        study.kit, list(enumerate(study.values)), "tcp://127.0.0.1:1", threading.Event(), patience_s=1.0
    )
    with pytest.raises(StudyError, match=r"--scheduler tcp://127\.0\.0\.1:1: cannot be reached"):
        next(flights)


@pytest.mark.parametrize("scheme", ["tcp", "tls"])
def test_what_answers_and_is_no_scheduler_is_one_line(folder: Path, write: Write, scheme: str) -> None:
    """A web server's port by mistake: no traceback of Dask, at once or at the end of the process."""
    import socket
    import threading

    pytest.importorskip("distributed", reason="needs the extra cluster")

    def answer(end: socket.socket) -> None:
        with end:
            end.recv(100)
            end.sendall(b"HTTP/1.1 400 Bad Request\r\n\r\n" * 40)

    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]

        def serve() -> None:
            while True:
                try:
                    threading.Thread(target=answer, args=(server.accept()[0],), daemon=True).start()
                except OSError:
                    return

        threading.Thread(target=serve, daemon=True).start()
        study = write('kind = "monte_carlo"\nruns = 1\n' + UNIFORM)
        address = f"{scheme}://127.0.0.1:{port}"
        done = subprocess.run(
            [PROGRAM, "study", study, "--scheduler", address], cwd=folder, capture_output=True, text=True, check=False,
            timeout=120,
        )  # fmt: skip
        server.shutdown(socket.SHUT_RDWR)
    assert (done.returncode, done.stdout) == (2, "")
    assert len(done.stderr.splitlines()) == 1, done.stderr
    assert done.stderr.startswith(f"error: --scheduler {address}: cannot be reached: ")


def test_unknown_output_is_found_with_the_first_run(folder: Path, write: Write) -> None:
    study = write('kind = "monte_carlo"\nruns = 1\noutputs = ["fuel"]\n' + UNIFORM)
    message = refused(folder, study, "--workers", 1)
    assert "'fuel'" in message
    assert "the summary of a mission has no such number; there are: days" in message


def limited(folder: Path, most_bytes: int, *arguments: object) -> str:
    """One line of a study whose files may not grow beyond a size: the same calls fail as on a full disk."""
    done = subprocess.run(
        [PROGRAM, "study", *map(str, arguments)],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (most_bytes, most_bytes)),
    )
    assert done.returncode == 2, done.stderr
    assert len(done.stderr.strip().splitlines()) == 1, done.stderr
    return done.stderr


def test_full_disk_leaves_nothing_half_written_and_the_study_goes_on(folder: Path, write: Write) -> None:
    study = write('kind = "monte_carlo"\nruns = 4\n' + UNIFORM)
    run(folder, study, "--workers", 1, "--output", "whole.nc")
    for name in ("full.nc", "full.zarr"):
        # room for a few records, not for one
        error = limited(folder, 600, study, "--workers", 1, "--output", name)
        assert f"{name}.runs/0000/0000000.json: cannot be written: File too large" in error
        assert not (folder / name).exists()
        assert not list((folder / f"{name}.runs").glob("*/*"))
        # room for the records, not for the result
        error = limited(folder, 4000, study, "--workers", 1, "--output", name)
        assert f"{name}: cannot be written: " in error
        assert not (folder / name).exists()
        assert len(list((folder / f"{name}.runs").glob("*/*.json"))) == 4
        done = run(folder, study, "--workers", 1, "--output", name)
        assert (done["flown"], done["kept"]) == (0, 4)
        assert not [path for path in folder.iterdir() if path.name.startswith(".")]
    assert (folder / "full.nc").read_bytes() == (folder / "whole.nc").read_bytes()


def test_unwritable_folder(folder: Path, write: Write) -> None:
    study = write('kind = "monte_carlo"\nruns = 3\n' + UNIFORM)
    assert "--output hop.toml/r.nc: cannot be written: Not a directory" in refused(
        folder, study, "--output", "hop.toml/r.nc"
    )
