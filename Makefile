# make book   build the book and say where to open it
# make check  check style and the model, and one page of each kind: a minute, while working
# make test   run the tests: library, chapters, pages in a browser; those of `make check` first
# make audit  run them all, at night and before a release: all engines, rows broken on purpose, toy data
# make lab    open the chapters in JupyterLab
# make kit    build the teacher's kit: notebooks for students, slides, the key, a bank of questions
# make pdf    print the whole book as one PDF, _build/book.pdf (with a browser)
# make data   remake all that ships, where something changed (hours; .venv/bin/python -m reproduce --list says more)
# make bench  measure what everything costs, beside named peers (half an hour; a quiet machine)
# Each sets up its own environment in .venv (the benchmarks' peers: in .bench), once.

PYTHON ?= python3
# Threads that wait for each other spin, and stand still as soon as the machine has other work
export OMP_NUM_THREADS = 1
export OPENBLAS_NUM_THREADS = 1
# Else every worker of the tests translates all modules anew
export PYTHONDONTWRITEBYTECODE =
# Where pip.conf says `user = true`, pip would refuse to install into an environment
export PIP_USER = 0
BIN    := .venv/bin
READY  := .venv/.ready
BUILT  := _build/.built
BUILD  := $(BIN)/jupyter-book build -W -n --keep-going .
PAGE   := _build/html/index.html
LAYOUT := .venv/share/jupyter/lab/workspaces/book-9271.jupyterlab-workspace
ROOMS  := book vmc_lib page reproduce
# One file saved since the book was built, if any: no list of prerequisites, where a name may hold no blank or colon
NEWER  := $(shell find _config.yml _toc.yml $(ROOMS) -type f -newer $(BUILT) -not -path '*/.*' -not -path '*/__pycache__/*' 2>/dev/null | head -n 1)

# What goes wrong most is asked first, and a suite that is red ends soon
FIRST  := $(addprefix tests/,arm motor cerebellum where what test_loop.py test_camera.py test_boxes.py \
  test_statistics.py page/demos/test_drags.py show/test_plots_in_browser.py page/arm/test_numbers.py)
PYTEST := $(BIN)/pytest -n auto --dist worksteal --maxfail=10 --nbmake-timeout=3600

PEERED := selective_search cuts simulators crbm planning loop scaling

# Locked, each file by its checksum. The library comes second, and torch, whose build (CPU, CUDA) differs
# from machine to machine: pip takes no file without a checksum beside those that have one.
define install
$(call pip,$(1)) --quiet --require-hashes -r constraints.txt
$(call pip,$(1)) --quiet --no-build-isolation -r requirements.txt -e .
endef
pip = $(if $(UV),uv pip install --python $(1)/python,$(1)/pip install)
UV := $(shell command -v uv)

.PHONY: book check test audit lab kit pdf data bench lock clean changed
.DEFAULT_GOAL := book

book: $(BUILT)
	@at=$$($(BIN)/python -c 'from pathlib import Path; print(Path("$(PAGE)").absolute().as_uri())') && \
	echo "The book is at $$at" && \
	if [ -n "$$DISPLAY$$WAYLAND_DISPLAY" ] || [ "$$(uname)" = Darwin ]; then \
	  $(BIN)/python -m webbrowser -t "$$at"; fi

check: $(READY)
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/codespell
	$(PYTEST) $(FIRST)

test: check $(BUILT)
	$(BIN)/python -m tools.browser
	$(BIN)/python -m tests.engines
	$(PYTEST) $(FIRST:%=--ignore=%) --nbmake tests book

audit: $(BUILT)
	$(BIN)/python -m tools.browser
	$(BIN)/python -m tests.engines
	$(PYTEST) -m "" --nbmake tests book --cov --cov-fail-under=97

lab: $(READY) $(LAYOUT)
	@mkdir -p .venv/etc/ipython && cp .binder/ipython_kernel_config.py .venv/etc/ipython
	$(BIN)/jupyter lab --LabApp.app_settings_dir=.binder \
	  --LabApp.workspaces_dir=$(dir $(LAYOUT)) --LabApp.default_url=/lab/workspaces/book

$(LAYOUT): | $(READY)  # at first the project's folders and chapter 1, then what the reader leaves open
	@mkdir -p $(@D) && cp .binder/workspace.json $@

kit: $(BUILT)
	$(BIN)/python -m kit

pdf: $(BUILT)
	$(BIN)/python -m tools.browser
	$(BIN)/python -m kit.pdf

data: $(READY)
	$(BIN)/python -m reproduce

bench: $(READY) .bench/.ready
	for name in $(PEERED); do .bench/bin/python -m tools.bench.$$name || exit 1; done
	for name in book in_page seat live; do $(BIN)/python -m tools.bench.$$name || exit 1; done

.bench/.ready: requirements.txt constraints.txt tools/bench/requirements.txt
	$(PYTHON) -m venv .bench
	$(call install,.bench/bin)
	.bench/bin/pip uninstall --quiet --yes opencv-python-headless
	.bench/bin/pip install --quiet -r tools/bench/requirements.txt
	@touch $@

$(BUILT): $(READY) $(if $(NEWER),changed)
	@mkdir -p _build && rm -f _build/.failed && touch _build/.begun
	$(BUILD) || { cat _build/.failed 2>/dev/null; exit 1; }
	@mv _build/.begun $@  # of the time of its beginning: what was saved since is newer

$(READY): requirements.txt constraints.txt pyproject.toml
	@$(PYTHON) tools/supported.py
	@$(PYTHON) -m venv .venv || { echo "Python's venv is missing: sudo apt install python3-venv"; exit 1; }
	$(call install,$(BIN))
	@touch $@

lock:  # for every system and every Python from 3.11 on
	@$(PYTHON) -m venv _build/uv && _build/uv/bin/pip install --quiet uv==0.13.9
	_build/uv/bin/uv pip compile --quiet --universal --python-version 3.11 --generate-hashes \
	  --no-strip-extras --no-annotate --custom-compile-command "make lock" -o constraints.txt requirements.txt
	sed -E -i.old '/^(torch|triton|cuda-|nvidia-)/,/[^\\]$$/d' constraints.txt && rm constraints.txt.old

clean:
	rm -rf _build
