"""How the command answers at its doors: options that are nearly right, readers that go, completion of words."""

import os
import subprocess
from pathlib import Path

import pytest

from tests.cli.test_bad_input import refused
from tests.support.command import PROGRAM, Command


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("trim", "zju", "--physics", "papr"), "--physics = 'papr': must be one of 'paper', 'full'; did you mean pa"),
        (("simulate", "pool_trial", "--seed", "1.5"), "--seed = 1.5: must be a whole number"),
        (("simulate", "pool_trial", "--seed", "-1"), "--seed = -1: must be between 0 and"),
        (("study", "x.toml", "--workers", "two"), "--workers = two: must be a whole number"),
        (("trim", "zju", "--speed", "fast", "--pitch", "-35"), "--speed = fast: must be a number"),
        (("trim", "zjuu", "--speed", "0.4", "--pitch", "-35"), "nor a file; did you mean zju? built-in: "),
        (("vehicle", "show", "Slocom"), "did you mean slocum?"),
        (("simulate", "pool_trail"), "nor a shipped mission; did you mean pool_trial? shipped: "),
        (("engine", "zju", "--engine", "slocum-1000"), "did you mean slocum-1000m?"),
        (("ocean", "show", "est_china_sea"), "did you mean east_china_sea? analytic: "),
        (("ocean", "show", "still", "--outside", "hodl"), "did you mean hold?"),
        (
            ("ocean", "show", "still", "--outside", "climatology", "--climatology", "two_layers"),
            "did you mean two_layer?",
        ),
        (("ocean", "show", "gyre", "--set", "speed=1"), "did you mean speed_m_s?"),
        (("ocean", "show", "gyre", "--set", "speed_m_s=fast"), "speed_m_s = 'fast': must be a number"),
        (("ocean", "show", "x.nc", "--name", "temprature=T"), "did you mean temperature?"),
        (("ocean", "show", "x.nc", "--unit", "salt=psu"), "units: unknown key salt"),
        (("root-locus", "zju", "--over", "wing.lift_per_rad_kg", "--from", "1", "--to", "2"), "wing.lift_per_rad_kg_m"),
        (("hull", "zju", "--material", "alumnia"), "did you mean alumina?"),
    ],
)  # fmt: skip
def test_what_was_meant_is_asked_for(stommel: Command, arguments: tuple[str, ...], sentence: str) -> None:
    refused(stommel(*arguments), sentence)


READ_BY_NOBODY = [
    ("vehicles",), ("vehicles", "--json"), ("ocean", "list"), ("ocean", "list", "--json"), ("ocean", "show", "still"),
    ("vehicle", "show", "zju"), ("vehicle", "show", "zju", "--toml"), ("vehicle", "check", "zju"), ("--help",),
    ("--version",), ("trim", "zju", "--speed", "0.4", "--pitch", "-35", "--json"), ("simulate", "--list"),
    ("hull", "zju"), ("modes", "zju", "--speed", "0.4", "--pitch", "-35"),
]  # fmt: skip


@pytest.mark.parametrize("arguments", READ_BY_NOBODY, ids=" ".join)
def test_a_closed_pipe_ends_quietly(arguments: tuple[str, ...]) -> None:
    """Oracle: what a shell says of a program that SIGPIPE ended, 128 + 13; nothing on the error stream."""
    reader, writer = os.pipe()
    os.close(reader)
    done = subprocess.run(
        [PROGRAM, *arguments], stdout=writer, stderr=subprocess.PIPE, text=True, check=False, timeout=300
    )
    os.close(writer)
    assert (done.returncode, done.stderr) == (141, "")


def completed(home: Path, option: str) -> subprocess.CompletedProcess[str]:
    """Ask under a shell, whose name is what completion is installed for."""
    return subprocess.run(
        ["bash", "-c", f'"{PROGRAM}" {option}; exit $?'], capture_output=True, text=True, check=False, timeout=60,
        env=os.environ | {"HOME": str(home)},
    )  # fmt: skip


def test_completion_is_installed_in_one_line(tmp_path: Path) -> None:
    done = completed(tmp_path, "--install-completion")
    assert (done.returncode, done.stderr) == (0, "")
    assert len(done.stdout.splitlines()) == 1
    assert len(list((tmp_path / ".bash_completions").iterdir())) == 1


def test_completion_that_cannot_be_installed_is_one_line(tmp_path: Path) -> None:
    (tmp_path / ".bash_completions").write_text("in the way")
    done = completed(tmp_path, "--install-completion")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == f"error: --install-completion: {tmp_path / '.bash_completions'}: File exists\n"
    (tmp_path / ".bashrc").write_bytes(b"\xff")
    assert "is not UTF-8 text" in completed(tmp_path, "--install-completion").stderr


def test_completion_of_a_verb_is_no_option(stommel: Command) -> None:
    refused(stommel("vehicles", "--install-completion"), "No such option: --install-completion")
