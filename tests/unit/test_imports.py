"""What a run imports: what its deck and its options need, and nothing else."""

import json
import subprocess
import sys

import pytest

PLAIN = """\
UNITS    mm kN bar C
MATERIAL STEEL  E=203GPa NU=0.3 ALPHA=12e-6 DENSITY=7850
SECTION  P      OD=273.1 WALL=9.27
OPERATE  T1=150 P1=12 TREF=20
ANCHOR   10
PIPE     10 20  DX=6000
SUPPORT  20     +Y MU=0.3
PIPE     20 30  DX=6000
BEND     30     R=381
PIPE     30 40  DZ=6000
ANCHOR   40
"""
# Dear modules of the standard library that no run needs.
SHUNNED = (
    *("argparse", "asyncio", "concurrent.futures", "difflib", "email.message", "http.client"),
    *("importlib.metadata", "importlib.resources", "logging", "multiprocessing", "sqlite3"),
    *("subprocess", "tempfile", "unittest", "urllib.request", "xml.etree"),
)
RUN = """\
import sys
before = set(sys.modules)  # of the interpreter, its site and the importer of an editable package
from trunnion.cli import main
try:
    main(sys.argv[1:])
except SystemExit as stop:
    import json
    print(json.dumps([stop.code, sorted(set(sys.modules) - before)]))
"""


def imported(folder, deck, *options):
    """Modules that a run of a deck imports in a process of its own."""
    (folder / "a.inp").write_text(deck)
    command = [sys.executable, "-c", RUN, "run", "a.inp", *options]
    ran = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True)
    code, modules = json.loads(ran.stdout.splitlines()[-1])
    assert code == 0, ran.stdout + ran.stderr
    return modules


def foreign(modules):
    """Packages that are neither Python's own nor ours."""
    roots = {name.partition(".")[0] for name in modules}
    return {r for r in roots if r not in sys.stdlib_module_names and r != "trunnion"}


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    return imported(tmp_path_factory.mktemp("plain"), PLAIN)


def test_a_plain_run_imports_click_and_numpy_only(plain):
    assert foreign(plain) == {"click", "numpy"}


def test_a_plain_run_imports_no_dear_module_of_python(plain):
    assert [name for name in SHUNNED if name in plain] == []


def test_a_plain_run_imports_nothing_of_modes_spectra_and_hdf5(plain):
    parts = ("solver.modes", "solver.eigen", "solver.spectrum", "cases.dynamics", "report.hdf5")
    assert [part for part in parts if f"trunnion.{part}" in plain] == []


@pytest.mark.parametrize(
    ("deck", "options", "needs"),
    [
        (PLAIN.replace("203GPa", "29443ksi"), (), "pint"),
        (PLAIN.replace("OD=273.1 WALL=9.27", "NPS=10 SCH=40"), (), "fluids.piping"),
        (PLAIN, ("--h5",), "h5py"),
        (PLAIN, ("--xlsx",), "xlsxwriter"),
        (PLAIN, ("--png",), "matplotlib.figure"),
        (PLAIN, ("--vtu",), "pyevtk.hl"),
        (PLAIN + "CASE OPE = W + T1\nMODES 2 ABOUT=OPE\n", (), "scipy.sparse, threadpoolctl"),
    ],
    ids=["unit", "size", "hdf5", "excel", "png", "vtk", "modes"],
)
def test_what_a_deck_needs_is_imported_and_no_more(tmp_path, plain, deck, options, needs):
    found = foreign(imported(tmp_path, deck, *options)) - foreign(plain)
    script = f"import sys, {needs}; print(*sys.modules)"
    alone = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    brought = foreign(alone.stdout.split())  # pint, for one, imports scipy where it is installed
    assert needs.partition(".")[0] in found
    assert found <= brought, f"more than {needs} brings"
