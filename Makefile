# Two commands do everything on a fresh machine with Python 3.11 or newer: `make run` and `make test`.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check

PAGE := src/stommel/station/built/index.html
PAGE_SOURCES := $(shell find page -name node_modules -prune -o -type f -print)
REPORT := build/zju-design.html
SOURCES := $(shell find src/stommel -path src/stommel/station/built -prune -o -name __pycache__ -prune -o -type f -print)
COMPILED := $(VENV)/compiled.stamp

.PHONY: help setup page page-check types run test check format bench docs dist clean

help:
	@echo "make run     design the paper's glider, launch it in a simulated sea, and serve the page that commands it"
	@echo "make test    everything that CI checks: format, lint, types, contracts, tests"
	@echo "make check   format, lint, types and import contracts only"
	@echo "make bench   every figure by name, also in build/bench.json"
	@echo "make docs    the documentation site, build/docs/index.html"
	@echo "make dist    a release: sdist and wheel in dist/, tried in an environment of its own"
	@echo "make page    the page of the shore station, from page/ into the package"
	@echo "make types   the page's types of what the station answers, from the station's own document"
	@echo "make setup   the environment in .venv that the others make themselves"
	@echo "make clean   remove the environment and everything built"

$(BIN)/python:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
	  { echo "stommel needs Python 3.11 or newer; say which with: make PYTHON=/path/to/python3" >&2; exit 1; }
	$(PYTHON) -m venv $(VENV)

$(VENV)/run.stamp: pyproject.toml constraints.txt | $(BIN)/python
	$(PIP) install --quiet --constraint constraints.txt --editable .
	@touch $@

$(VENV)/test.stamp: $(VENV)/run.stamp
	$(PIP) install --quiet --constraint constraints.txt --editable '.[test,docs]'
	@$(PIP) install --quiet --constraint constraints.txt --editable '.[bench]' || \
	  echo "the peers of the benchmark cannot be installed here: their tests and figures are skipped" >&2
	@touch $@

setup: $(VENV)/test.stamp

$(VENV)/page.stamp: page/npm.py $(VENV)/run.stamp
	@$(BIN)/python page/npm.py --version >/dev/null 2>&1 || \
	  $(PIP) install --quiet --constraint constraints.txt --editable '.[page]'
	@touch $@

page/node_modules/.package-lock.json: page/package-lock.json | $(VENV)/page.stamp
	$(BIN)/python page/npm.py ci --no-audit --no-fund --loglevel=error
	@touch $@

$(PAGE): page/node_modules/.package-lock.json $(PAGE_SOURCES)
	$(BIN)/python page/npm.py run --silent build -- --logLevel warn
	$(BIN)/python page/weight.py
	@touch $@

page: $(PAGE)

types: page/node_modules/.package-lock.json
	$(BIN)/python page/npm.py run --silent types

# the same sources make the same report
$(REPORT): $(VENV)/run.stamp $(SOURCES)
	$(BIN)/stommel design zju --output $@

# each launch is a flight of its own, with an archive of its own
run: $(VENV)/run.stamp $(PAGE) $(REPORT)
	@echo "the design report of the paper's glider: $(REPORT)"
	@echo "launching the glider of that design in a simulated East China Sea, 20 times real time"
	@exec $(BIN)/stommel station --sitl east_china_sea --speed 20 --folder build/flights/$$(date -u +%Y%m%dT%H%M%SZ)

check: $(VENV)/test.stamp
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports

format: $(VENV)/test.stamp
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

page-check: $(PAGE)
	$(BIN)/python page/npm.py run --silent lint
	$(BIN)/python page/npm.py run --silent check
	$(BIN)/python page/npm.py run --silent test

# machine code that most tests run: made once, not by each of several workers side by side
$(COMPILED): $(VENV)/test.stamp $(SOURCES)
	$(BIN)/stommel sitl fly pool_trial --json >/dev/null
	$(BIN)/stommel simulate pool_trial --json >/dev/null
	$(BIN)/stommel design zju --no-report --json >/dev/null
	@touch $@

# none of these uses more than one core
test: $(VENV)/test.stamp
	@$(MAKE) --no-print-directory --jobs=3 check page-check $(COMPILED)
	$(BIN)/python -m pytest --numprocesses auto --dist loadscope --no-loadscope-reorder

bench: $(VENV)/test.stamp $(PAGE)
	$(BIN)/python benchmarks/run.py

docs: $(VENV)/test.stamp
	$(BIN)/sphinx-build --fail-on-warning --keep-going --quiet -b html docs build/docs
	@echo "docs: build/docs/index.html"

dist: $(VENV)/test.stamp $(PAGE)
	rm -rf dist build/release
	$(BIN)/python -m build --no-isolation
	$(BIN)/python -m venv build/release
	build/release/bin/python -m pip --disable-pip-version-check install --quiet --constraint constraints.txt dist/*.whl
	cd build/release && bin/stommel simulate pool_trial --output pool_trial.nc
	@echo "dist: the wheel flew the pool trial; $$(ls dist)"

clean:
	rm -rf $(VENV) build dist page/node_modules src/stommel/station/built .mypy_cache .ruff_cache .pytest_cache .hypothesis .import_linter_cache
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
