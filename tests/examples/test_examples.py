"""Every documented example runs, without a warning."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SCRIPTS = sorted((ROOT / "examples").glob("*.py"))


def run(code: list[str], folder: Path) -> str:
    done = subprocess.run(
        [sys.executable, "-W", "error", *code], cwd=folder, capture_output=True, text=True, check=False, timeout=300
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_example(script: Path, tmp_path: Path) -> None:
    assert run([str(script)], tmp_path).strip()


def test_flight_settles_into_the_trim(tmp_path: Path) -> None:
    """The last line of the launch is the trimmed flight (in the vehicle's full physics, close to the paper's)."""
    last = run([str(ROOT / "examples" / "fly_the_equations.py")], tmp_path).splitlines()[-1]
    pitch, speed = (float(value) for value in re.findall(r"pitch\s+(\S+) deg\s+speed (\S+)", last)[0])
    assert pitch == pytest.approx(-35.0, abs=1.5)
    assert speed == pytest.approx(0.4, abs=0.01)


def test_python_of_the_readme(tmp_path: Path) -> None:
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"```python\n(.*?)```", readme, re.DOTALL)
    run(["-c", block + "\nassert plant.nstates == 4"], tmp_path)


def test_commands_of_the_readme(tmp_path: Path) -> None:
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    commands = [line.split("#")[0].split() for line in readme.splitlines() if line.startswith("stommel ")]
    assert len(commands) >= 9
    program = str(Path(sys.executable).with_name("stommel"))
    for command in commands:
        done = subprocess.run([program, *command[1:]], cwd=tmp_path, capture_output=True, text=True, check=False)
        assert done.returncode == 0, (command, done.stderr)
