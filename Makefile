# Each of these works on a fresh clone: what is missing is installed first (.ci/setup).
#   make demo     solve two piping systems, reports in demo/
#   make test     every test                        (make test ARGS="-k friction -x")
#   make lint     ruff, mypy, fortitude
#   make stress   thousands of extreme scenes    (make stress N=20000; goes on where it stopped)
#   make bench    the rack lines of benchmarks/     (make bench NODES="50 200" CASES=fric1)
BIN := .venv/bin
READY := .venv/.ready

# BLAS threads fight each other and change last digits.
export OPENBLAS_NUM_THREADS := 1
export OMP_NUM_THREADS := 1
# Meson, when a changed meson.build makes it run again, looks for numpy-config on PATH.
export PATH := $(CURDIR)/$(BIN):$(PATH)

DEMO := b313_s302 hot_header
NODES := 50 200 1000
CASES := lin gap fric1 fric10
RACKS := tests/data
ARGS :=

N := 20000

.PHONY: demo test stress lint bench debug-test build clean

demo: build
	@mkdir -p demo
	@set -e; for deck in $(DEMO); do $(BIN)/trunnion run models/$$deck.inp -o demo; done
	@printf '\nThe reports to read, each ending with its certificate:\n'
	@printf '  demo/%s.out\n' $(DEMO)
	@printf 'The same numbers for programs, in SI units:\n'
	@printf '  demo/%s.json\n' $(DEMO)

test: build
	@$(BIN)/pytest $(ARGS)

stress: build
	@$(BIN)/python tests/stress/long.py $(N) build/stress

lint: $(READY)
	@failed=0; for check in "ruff check ." "ruff format --check ." mypy "fortitude check fortran"; do \
	    $(BIN)/$$check || failed=1; \
	done; exit $$failed

bench: build
	@mkdir -p build/bench
	@set -e; for n in $(NODES); do for case in $(CASES); do \
	    $(BIN)/python benchmarks/rack.py $(RACKS)/rack_$$n.json.gz $$case \
	        -o build/bench/rack_$${n}_$$case.json; \
	done; done

# The debug build keeps its own directory; only what the Fortran tests need is built in it.
debug-test: $(READY)
	@test -f build/debug/build.ninja || $(BIN)/meson setup build/debug --buildtype=debug --werror -Db_lto=false \
	    -Db_sanitize=address,undefined
	@$(BIN)/meson test -C build/debug --print-errorlogs

# The editable package would rebuild itself on import; here it is done once, before anything runs.
# Its importer reads bytecode but never writes any: without compileall every run compiles anew.
build: $(READY)
	@log=$$($(BIN)/ninja -C build/editable 2>&1) || { printf '%s\n' "$$log"; exit 1; }
	@$(BIN)/python -m compileall -q python/trunnion

$(READY): pyproject.toml meson.build .ci/setup
	@.ci/setup

clean:
	rm -rf .venv build demo
