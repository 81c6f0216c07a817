# Everything a fresh Debian or Ubuntu needs beside Python >= 3.11 and make is set up by these targets.
PYTHON ?= python3
VENV   := .venv
BIN    := $(VENV)/bin
READY  := $(VENV)/.ready
SYSTEM := $(VENV)/.system

.PHONY: demo test lint bench clean
.DEFAULT_GOAL := demo

$(SYSTEM): packaging/linux/system-packages.sh
	bash packaging/linux/system-packages.sh "$(PYTHON)"
	$(PYTHON) -m venv $(VENV)
	touch $@

$(READY): $(SYSTEM) pyproject.toml constraints.txt
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[dev]'
	touch $@

demo: $(READY) ## open the application on a recorded session; without a screen do the same off-screen
	$(BIN)/python -m insole_studio.demo

test: $(READY) ## all tests: the window's offscreen, then those that look at real pixels, under Xvfb
	QT_QPA_PLATFORM=offscreen $(BIN)/python -m pytest -n auto --dist loadfile -m "not display"
	QT_QPA_PLATFORM=xcb xvfb-run -a -s "-screen 0 1920x1200x24" $(BIN)/python -m pytest -m display

lint: $(READY) ## style, types, architecture
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports

bench: $(READY) ## speed and accuracy, side by side with peers; results in benchmarks/results
	$(BIN)/python -m benchmarks

clean:
	rm -rf $(VENV) build dist demo-output
