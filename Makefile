# make demo   set everything up, move the line follower, show what was made
# make check  run the tests that need neither a compiler nor a simulator, a browser or another Python, in a process for each core
# make test   set everything up (system packages too, where this may) and run what a pull request needs
# make test-all  every test: every board, 300 kills, every adapter on every microcontroller, by hand (not in CI)
# make lint   ruff and mypy, in an environment of its own
# make bench  the figures of the README and others, measured, in one table
# make ratios  the cheap figures of the benchmark: ratios and counts that hold on any machine
# make fuzz  damaged and large inputs, odd environments, by hand (not in CI)
# make evaluate  the paper's claims, row by row: what was got, and the verdict (python -m tests.evaluation --help)
# make faults    faults and harmless rewritings in the migrated case studies, and what `verify` notices of them, by hand (not in CI)
# make mutants   small changes of the product's own code, and how many of them `make check` notices, by hand (not in CI)
# make adapters  each adapter compiled alone for every microcontroller, each one broken on purpose, and whole programs of each family, by hand (not in CI)
# make readme  the output, excerpts and pictures of README.md and docs/tutorial.md
# make rules  the tables of docs/reference/rules.md, plug-ins.md, corpus-schema.md and wiring.md, from the rules' data and the code
# make floor-plan  the picture of rooms and imports in docs/architecture.md, from the code
# make pyecore  what is leant on in pyecore without a promise, and whether it holds in other versions, by hand (not in CI)
# make corpus-check  a small corpus run through all steps that need no simulator, compared with the results that are kept
# make corpus  the programs and drawings of other people that the ground-truth tests read, fetched from their repositories
# make docs  the documentation as a site in out/site, built offline, with its links checked
# make wheel  build the sdist and from it the wheel, install it in a clean environment, use it from another folder

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
# Nothing here reads or writes the data of the person who runs it: history, imported libraries, parts and platforms.
export ROBOSMI_HOME := $(CURDIR)/out/data
unexport ROBOSMI_HISTORY
# Where .ci/npm-packages puts the simulator avr8js.
export ROBOSMI_NPM := $(CURDIR)/.npm
.PHONY: corpus-check docs floor-plan demo check test test-all lint bench ratios evaluate fuzz faults mutants adapters pyecore corpus wheel readme rules metamodels system-packages npm-packages clean

$(VENV)/.ready: pyproject.toml
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --upgrade pip
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[test]'
	touch $@

demo: $(VENV)/.ready
	$(BIN)/robosmi migrate docs/examples/line_follower/line_follower.c -o out/line_follower
	@echo; echo "--- out/line_follower/line_follower/line_follower.ino ---"; cat out/line_follower/line_follower/line_follower.ino

system-packages:
	@sh .ci/system-packages

npm-packages: system-packages
	@sh .ci/npm-packages

PYTEST := $(BIN)/python -m pytest -n auto --dist worksteal
check: $(VENV)/.ready
	$(PYTEST) --tier check

test: $(VENV)/.ready system-packages npm-packages
	$(PYTEST) --tier test

test-all: $(VENV)/.ready system-packages npm-packages
	$(PYTEST) --tier all

lint:
	@sh .ci/lint

bench: $(VENV)/.ready
	$(BIN)/python -m tests.bench

ratios: $(VENV)/.ready
	$(BIN)/python -m tests.bench --ratios

evaluate: $(VENV)/.ready
	$(BIN)/python -m tests.evaluation

fuzz: $(VENV)/.ready
	$(BIN)/python -m tests.fuzz.hardware
	$(BIN)/python -m tests.fuzz.drawings
	$(BIN)/python -m tests.fuzz.xmi
	$(BIN)/python -m tests.fuzz.metamodels
	$(BIN)/python -m tests.fuzz.c_source
	$(BIN)/python -m tests.fuzz.precompiled
	$(BIN)/python -m tests.fuzz.quoting
	$(BIN)/python -m tests.fuzz.history
	$(BIN)/python -m tests.fuzz.edits
	$(BIN)/python -m tests.fuzz.two_views
	$(BIN)/python -m tests.fuzz.valid_c
	$(BIN)/python -m tests.fuzz.widths
	$(BIN)/python -m tests.fuzz.growth
	$(BIN)/python -m tests.fuzz.environments
	$(BIN)/python -m tests.fuzz.runs
	$(BIN)/python -m tests.fuzz.interrupts
	$(BIN)/python -m tests.fuzz.native
	$(BIN)/python -m tests.fuzz.pins

adapters: $(VENV)/.ready system-packages
	$(BIN)/python -m tests.adapters.alone
	$(BIN)/python -m tests.adapters.pico
	$(BIN)/python -m tests.adapters.boards
	$(BIN)/python -m tests.adapters.mutants
	$(BIN)/python -m tests.families

faults: $(VENV)/.ready system-packages npm-packages
	$(BIN)/python -m tests.faults
	$(BIN)/python -m tests.faults --rewritings

mutants: $(VENV)/.ready
	$(BIN)/python -m tests.mutants

corpus: $(VENV)/.ready
	$(BIN)/python -m tests.corpus.fetch out

corpus-check: $(VENV)/.ready
	$(BIN)/python -m tests.corpus_runs.check

pyecore: $(VENV)/.ready
	$(BIN)/python -m tests.model.pyecore_contract 0.14.0 0.15.2

wheel:
	@PYTHON=$(PYTHON) sh .ci/wheel

rules: $(VENV)/.ready
	$(BIN)/python -m tests.rules_page
	$(BIN)/python -m tests.plug_ins_page
	$(BIN)/python -m tests.corpus_schema_page
	$(BIN)/python -m tests.wiring_page

floor-plan: $(VENV)/.ready
	$(BIN)/python -m tests.floor_plan

docs: $(VENV)/.ready
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[docs]'
	$(BIN)/python -m tests.site_pages out/site

readme: $(VENV)/.ready
	$(BIN)/python tests/readme_tour.py

metamodels: $(VENV)/.ready
	$(BIN)/python -m robosmi.model.generator.codegen
	$(BIN)/python -m robosmi.model.diagram

clean:
	rm -rf $(VENV) .npm .venv-lint .venv-wheel build dist out *.egg-info
