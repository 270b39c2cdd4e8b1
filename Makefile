# Two commands do everything on a fresh machine with Python 3.11 or newer: `make run` and `make test`.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check

.PHONY: help setup run test check format bench docs clean

help:
	@echo "make run     design the paper's glider; the report is build/zju-design.html"
	@echo "make test    everything that CI checks: format, lint, types, contracts, tests"
	@echo "make check   format, lint, types and import contracts only"
	@echo "make bench   every figure by name, also in build/bench.json"
	@echo "make docs    the documentation site, build/docs/index.html"
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
	@touch $@

setup: $(VENV)/test.stamp

run: $(VENV)/run.stamp
	$(BIN)/stommel design zju --output build/zju-design.html

check: $(VENV)/test.stamp
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports

format: $(VENV)/test.stamp
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

test: check
	$(BIN)/python -m pytest --numprocesses auto --dist loadfile

$(VENV)/bench.stamp: $(VENV)/test.stamp
	@$(PIP) install --quiet --constraint constraints.txt --editable '.[bench]' && touch $@ || \
	  echo "make bench: the peers cannot be installed; their figures are skipped" >&2

bench: $(VENV)/bench.stamp
	$(BIN)/python benchmarks/run.py

docs: $(VENV)/test.stamp
	$(BIN)/sphinx-build --fail-on-warning --keep-going --quiet -b html docs build/docs
	@echo "docs: build/docs/index.html"

clean:
	rm -rf $(VENV) build dist .mypy_cache .ruff_cache .pytest_cache .hypothesis .import_linter_cache
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
