"""The files that a run writes when it is asked: what each needs, and who makes it."""

from collections.abc import Callable, Mapping
from importlib import import_module
from pathlib import Path

from trunnion.arrays import Results
from trunnion.frozen import frozen
from trunnion.model import Model

Files = dict[Path, bytes]


@frozen
class Output:
    """One format: the module that makes it, the packages that this needs, the extra with them."""

    module: str
    packages: tuple[str, ...] = ()
    extra: str = ""


OUTPUTS: Mapping[str, Output] = {
    "h5": Output("trunnion.report.hdf5", ("h5py",), "hdf5"),
    "xlsx": Output("trunnion.report.excel", ("xlsxwriter",), "excel"),
    "csv": Output("trunnion.report.csv"),
    "vtu": Output("trunnion.report.vtu", ("pyevtk",), "vtk"),
    "png": Output("trunnion.report.plots", ("matplotlib",), "plot"),
    "html": Output("trunnion.report.html", ("plotly", "jinja2"), "html"),
}

#: of files that a run writes: a deck of such a name could be overwritten by its reports
SUFFIXES = (".out", ".json", ".h5", ".xlsx", ".csv", ".html", ".png", ".vtu", ".pvd")


def missing(name: str) -> str:
    """Say what is not installed for a format; nothing if all is there."""
    found = OUTPUTS[name]
    if found.packages:
        from importlib.util import find_spec

        lacking = [package for package in found.packages if find_spec(package) is None]
        if lacking:
            what = "the package" if len(lacking) == 1 else "the packages"
            say = f"--{name} needs {what} {' and '.join(lacking)}"
            return f"{say}: pip install 'trunnion[{found.extra}]'"
    return ""


def further_files(name: str, results: Results, model: Model, folder: Path, stem: str) -> Files:
    """Make the files of one format, by their places."""
    make: Callable[[Results, Model, str], dict[str, bytes]]
    make = import_module(OUTPUTS[name].module).files
    return {folder / file: content for file, content in make(results, model, stem).items()}
