"""`stommel bench`: logs of the buoyancy engine and pressure tests of the hull, one file a verb."""

import typer

from stommel.cli.bench.analyse import analyse
from stommel.cli.bench.fit import fit
from stommel.cli.bench.generate import generate
from stommel.cli.bench.pressure import pressure
from stommel.cli.bench.speed import speed

bench_app = typer.Typer(help="Bench tests: logs of the buoyancy engine, pressure tests of the hull.")
for _verb in (generate, analyse, fit, speed, pressure):
    bench_app.command()(_verb)
