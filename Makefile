# make book   build the book and say where to open it
# make test   run every test: library, chapters, pages in a browser
# make lab    open the chapters in JupyterLab
# make bench  measure what everything costs, beside named peers (half an hour; a quiet machine)
# Each sets up its own environment in .venv (the benchmarks' peers: in .bench), once.

PYTHON ?= python3
# Threads that wait for each other spin, and stand still as soon as the machine has other work
export OMP_NUM_THREADS = 1
export OPENBLAS_NUM_THREADS = 1
BIN    := .venv/bin
READY  := .venv/.ready
BUILT  := _build/.built
BUILD  := $(BIN)/jupyter-book build -W -n --keep-going .
INPUTS := _config.yml _toc.yml $(shell find book vmc_lib arm_in_page reproduce -type f -not -path '*/.*' -not -name '*.pyc')

PEERED := selective_search simulators crbm planning loop scaling

.PHONY: book test lab bench lock clean
.DEFAULT_GOAL := book

book: $(BUILT)
	@echo "The book is at file://$(CURDIR)/_build/html/index.html"
	@if [ -n "$$DISPLAY$$WAYLAND_DISPLAY" ] || [ "$$(uname)" = Darwin ]; then \
	  $(BIN)/python -m webbrowser -t "file://$(CURDIR)/_build/html/index.html"; fi

test: $(BUILT)
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/python -m tests.browser
	$(BIN)/pytest -n auto --dist worksteal --nbmake --nbmake-timeout=3600 tests book

lab: $(READY)
	$(BIN)/jupyter lab book/01_loop.ipynb

bench: $(READY) .bench/.ready
	for name in $(PEERED); do .bench/bin/python -m bench.$$name || exit 1; done
	for name in book in_page seat; do $(BIN)/python -m bench.$$name || exit 1; done

.bench/.ready: requirements.txt constraints.txt bench/requirements.txt
	$(PYTHON) -m venv .bench
	.bench/bin/pip install --quiet -r requirements.txt -c constraints.txt
	.bench/bin/pip uninstall --quiet --yes opencv-python-headless
	.bench/bin/pip install --quiet -r bench/requirements.txt
	.bench/bin/pip install --quiet --no-deps -e .
	@touch $@

$(BUILT): $(READY) $(INPUTS)
	@rm -f _build/.failed
	$(BUILD) || { cat _build/.failed; exit 1; }
	@touch $@

$(READY): requirements.txt constraints.txt pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info[:2] < (3, 11))' || \
	  { echo "Python 3.11 or newer is needed: make PYTHON=python3.11"; exit 1; }
	@$(PYTHON) -m venv .venv || { echo "Python's venv is missing: sudo apt install python3-venv"; exit 1; }
	$(BIN)/pip install --quiet -r requirements.txt -c constraints.txt
	$(BIN)/pip install --quiet --no-deps -e .
	@touch $@

lock: $(READY)  # torch stays out: its build (CPU, CUDA) differs from machine to machine
	@echo "# Every package of the environment, locked. Remake it with: make lock" > constraints.txt
	$(BIN)/pip freeze --exclude-editable | grep '==' | grep -v '^torch==' >> constraints.txt

clean:
	rm -rf _build
