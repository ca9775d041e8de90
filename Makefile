# Each of these works on a fresh clone: what is missing is installed first (.ci/setup).
#   make demo     solve two piping systems, reports in demo/
#   make test     every test                        (make test ARGS="-k friction -x")
#   make lint     ruff, mypy, fortitude
#   make docs     the site of docs/, in build/docs (needs no network; warnings are errors)
#   make stress   thousands of extreme scenes    (make stress N=20000; goes on where it stopped)
#   make gallery  pictures of docs/gallery.md, by the commands that stand in it
#   make bench    time, error and memory, peers, sweeps: tables and pictures in build/bench
#                 (bench-quick, bench-docs, bench-million, bench-peers; OUT=folder ONLY="racks whole")
BIN := .venv/bin
READY := .venv/.ready

# BLAS threads fight each other and change last digits.
export OPENBLAS_NUM_THREADS := 1
export OMP_NUM_THREADS := 1
# Meson, when a changed meson.build makes it run again, looks for numpy-config on PATH.
export PATH := $(CURDIR)/$(BIN):$(PATH)

DEMO := b313_s302 hot_header
OUT := build/bench
ONLY :=
ARGS :=
N := 20000

.PHONY: demo test docs verification-record stress gallery lint debug-test build clean
.PHONY: bench bench-quick bench-docs bench-million bench-peers

demo: build
	@mkdir -p demo
	@set -e; for deck in $(DEMO); do $(BIN)/trunnion run models/$$deck.inp -o demo; done
	@printf '\nThe reports to read, each ending with its certificate:\n'
	@printf '  demo/%s.out\n' $(DEMO)
	@printf 'The same numbers for programs, in SI units:\n'
	@printf '  demo/%s.json\n' $(DEMO)

test: build
	@$(BIN)/pytest $(ARGS)

docs: build
	@$(BIN)/python -m sphinx -q -W --keep-going -b html -d build/doctrees docs build/docs
	@echo build/docs/index.html

# docs/verification.md, from what the tests find
verification-record: build
	@VERIFICATION_RECORD=write $(BIN)/pytest -q tests/verification

stress: build
	@$(BIN)/python tests/stress/long.py $(N) build/stress

gallery: build
	@$(BIN)/python docs/gallery.py

lint: $(READY)
	@failed=0; for check in "ruff check ." "ruff format --check ." mypy "fortitude check fortran"; do \
	    $(BIN)/$$check || failed=1; \
	done; exit $$failed

# OUT=docs/benchmarks refreshes docs/benchmarks.md and the README, too.
BENCH = $(BIN)/python benchmarks/bench.py $(if $(filter docs/benchmarks,$(OUT)),--docs,-o $(OUT))
bench-docs: OUT := docs/benchmarks

bench bench-docs: build
	@$(BENCH) $(if $(ONLY),--only $(ONLY))

bench-quick: build
	@$(BENCH) --scope quick $(if $(ONLY),--only $(ONLY))

bench-million: build
	@$(BENCH) --only million

bench-peers: build
	@$(BIN)/pip install --quiet --disable-pip-version-check --no-build-isolation \
	    --config-settings=build-dir=build/editable --editable '.[peers]'

# The debug build keeps its own directory; only what the Fortran tests need is built in it.
debug-test: $(READY)
	@test -f build/debug/build.ninja || $(BIN)/meson setup build/debug --buildtype=debug --werror -Db_lto=false \
	    -Db_sanitize=address,undefined
	@$(BIN)/meson test -C build/debug --print-errorlogs

# The editable package would rebuild itself on import; here it is done once, before anything runs.
# Its importer reads bytecode but never writes any: without compileall every run compiles anew.
build: $(READY)
	@test -f build/editable/build.ninja || .ci/setup
	@log=$$($(BIN)/ninja -C build/editable 2>&1) || { printf '%s\n' "$$log"; exit 1; }
	@$(BIN)/python -m compileall -q python/trunnion

$(READY): pyproject.toml meson.build .ci/setup
	@.ci/setup

clean:
	rm -rf .venv build demo
