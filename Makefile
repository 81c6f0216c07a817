# Everything a fresh Debian or Ubuntu needs beside Python >= 3.11 and make is set up by these targets.
PYTHON ?= python3
VENV   := .venv
BIN    := $(VENV)/bin
# One heap for all threads: with one each, memory that a test has freed stays with its thread.
PYTEST := MALLOC_ARENA_MAX=1 $(BIN)/python -m pytest
# Each worker takes a row of neighbouring modules, and of the rest of another when it is done.
OFFSCREEN := QT_QPA_PLATFORM=offscreen $(PYTEST) -n auto --dist worksteal
# The application after the rest, in workers of its own: those that ran both would keep the memory of both.
run_offscreen = $(OFFSCREEN) -m $(1) --ignore=tests/insole_studio; rest=$$?; \
	$(OFFSCREEN) -m $(1) tests/insole_studio && exit $$rest
READY  := $(VENV)/.ready
SYSTEM := $(VENV)/.system
# What is compiled is kept, whatever the environment says: compiling all tests takes longer than any test.
unexport PYTHONDONTWRITEBYTECODE

SITE   := resources/manual
SCREEN := -screen 0 1920x1200x24
PAGES  := $(wildcard docs/*.py docs/*.js docs/manual/*.md docs/manual/*/* docs/formats/*) CHANGELOG.md

.PHONY: demo pictures test offscreen display test-fast test-without-posix lint types style manual bench package clean
.DEFAULT_GOAL := demo

$(SYSTEM): packaging/linux/system-packages.sh
	bash packaging/linux/system-packages.sh "$(PYTHON)"
	$(PYTHON) -m venv $(VENV)
	touch $@

$(READY): $(SYSTEM) pyproject.toml constraints.txt
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[dev]'
	$(BIN)/python -m compileall -q app insole_core drivers
	touch $@

$(SITE)/.built: $(READY) $(PAGES)
	$(BIN)/python docs/build_manual.py
	touch $@

# Journeys of the tests take some of them on their way.
pictures: $(READY) ## all pictures of the manual, anew, as the window is now
	QT_QPA_PLATFORM=xcb xvfb-run -a -s "$(SCREEN)" $(BIN)/python docs/pictures.py
	for folder in images images/sv; do \
		INSOLE_STUDIO_MANUAL=$(CURDIR)/docs/manual/$$folder QT_QPA_PLATFORM=xcb \
			xvfb-run -a -s "$(SCREEN)" env $(PYTEST) tests/insole_studio/journeys/test_whole_journey.py || exit 1; \
	done

manual: $(SITE)/.built ## the site of the manual, which F1 opens and packages contain

demo: $(READY) manual ## open the application on a recorded session; without a screen do the same off-screen
	$(BIN)/python -m insole_studio.demo

test: $(READY) ## all tests: the window's offscreen, and beside them those that look at real pixels
	$(MAKE) --jobs=2 offscreen display

offscreen: $(READY)
	$(call run_offscreen,"not display")

display: $(READY)
	QT_QPA_PLATFORM=xcb xvfb-run -a -s "$(SCREEN)" env $(PYTEST) -q -m display $$(grep -rl mark.display tests --include='*.py')

test-fast: $(READY) ## the tests to run while working: all but those that take long
	$(call run_offscreen,"not display and not slow")

test-without-posix: $(READY) ## the pure part as on Windows: what only POSIX has is hidden from it
	$(PYTEST) -p tests.without_posix -m "not slow" tests/insole_core

lint: $(READY) ## style, types, architecture, the links of the manual
	$(MAKE) --jobs=2 --output-sync manual types style

types: $(READY)
	$(BIN)/mypy --num-workers 2

style: $(READY)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/lint-imports

bench: $(READY) ## speed and accuracy, side by side with peers; results in benchmarks/results
	$(BIN)/python -m benchmarks

# The environment that is frozen is another one than that of developers: packaging/README.md.
build/package-venv/.ready: pyproject.toml constraints.txt packaging/prepare.py
	$(PYTHON) packaging/prepare.py
	touch $@

package: build/package-venv/.ready ## what users install, as far as this system can build it; in dist
	build/package-venv/bin/python packaging/build.py

clean:
	rm -rf $(VENV) build dist demo-output $(SITE)
