"""The command as its user waits for it: a whole process, import and all."""

import json
import subprocess
import sys
from pathlib import Path

from figures.registry import Measurement, figure
from figures.timing import seconds, summary

ARGUMENTS = ("trim", "zju", "--speed", "0.4", "--pitch", "-35", "--json")
REPEATS = 5


@figure(unit="s", bar=1.0)
def cli_trim_s() -> Measurement:
    """Measure one trim on the command line, from the second run on [s]."""
    command = [str(Path(sys.executable).with_name("stommel")), *ARGUMENTS]

    def run() -> str:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout

    json.loads(run())  # fills the cache, and is an answer
    detail = summary(seconds(run, REPEATS), 1.0)
    return Measurement(detail["min"], detail | {"command": " ".join(("stommel", *ARGUMENTS))})
