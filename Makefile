# make run       set up .venv if need be and run the first plan
# make test      the whole check: ruff, mypy, every test, the wheel and the editable install
# make fast      the inner loop: the same without what is slow, under 20 seconds
# make test-all  the suite under every supported Python that this machine has
# make bench     measure, beside hand-written Python and other libraries; one table
# make clean     remove what the other targets made

SHELL := /bin/sh
VENV := .venv
BIN := $(VENV)/bin
SUPPORTED := 3.14 3.13 3.12 3.11
FITS := import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 11))
NUMBER := import sys, venv, ensurepip; print("%d.%d" % sys.version_info[:2])

# The first Python on the PATH that works, is new enough and can make a virtual environment.
PYTHON ?= $(shell for candidate in $(SUPPORTED:%=python%) python3 python; do \
	$$candidate -c '$(FITS)' 2>/dev/null && { echo $$candidate; break; }; done)

# Where a Python may be: by its name on the PATH, or among pyenv's versions.
EVERY_PYTHON = $(foreach version,$(SUPPORTED),python$(version) $(wildcard $(HOME)/.pyenv/versions/$(version).*/bin/python))

.PHONY: run test fast test-all check bench clean

run: $(VENV)/.ready
	@$(BIN)/esl run plans/esl/01-widget.esl

test: check
	$(BIN)/python -m pytest -n auto

fast: check
	$(BIN)/python -m pytest -n auto -q -m "not slow"

check: $(VENV)/.ready-dev
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

test-all:
	@failed=; seen=; \
	for python in $(EVERY_PYTHON); do \
	    version=$$($$python -c '$(NUMBER)' 2>/dev/null) || continue; \
	    case " $$seen " in *" $$version "*) continue;; esac; \
	    seen="$$seen $$version"; \
	    echo "== Python $$version"; \
	    $(MAKE) --no-print-directory VENV=.venv/$$version PYTHON=$$python .venv/$$version/.ready-dev && \
	        .venv/$$version/bin/python -m pytest -n auto -q || failed="$$failed $$version"; \
	done; \
	echo "Pythons tried:$$seen"; \
	if [ -n "$$failed" ]; then echo "failed under:$$failed"; exit 1; fi

bench: $(VENV)/.ready-dev
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[bench]'
	-@$(BIN)/python -m tests.benchmarks

$(VENV)/.ready: pyproject.toml
	@test -n "$(PYTHON)" || { echo "eslang needs Python 3.11 or newer, with its venv module"; exit 1; }
	@test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable .
	@touch $@

$(VENV)/.ready-dev: pyproject.toml $(VENV)/.ready
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[dev]'
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[gym]' 2>/dev/null \
	  || echo "Gymnasium does not install here: what needs it is not tested"
	@touch $@

clean:
	rm -rf $(VENV) build dist .ruff_cache .hypothesis
	find eslang tests -name __pycache__ -type d -prune -exec rm -rf {} +
