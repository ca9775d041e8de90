"""The files that a run writes when it is asked: what each needs, and who makes it."""

from collections.abc import Callable, Mapping
from importlib import import_module
from pathlib import Path

from trunnion.arrays import Results
from trunnion.frozen import frozen
from trunnion.model import Model

Files = dict[Path, bytes]


@frozen
class Format:
    """One format: its files in words, the package that writes it, the extra that brings that."""

    files: str
    module: str
    package: str = ""
    extra: str = ""


FORMATS: Mapping[str, Format] = {
    "h5": Format("<stem>.h5, whole arrays", "trunnion.report.hdf5", "h5py", "hdf5"),
    "xlsx": Format("<stem>.xlsx, a workbook", "trunnion.report.excel", "xlsxwriter", "excel"),
    "csv": Format("<stem>_csv/, the tables of the workbook", "trunnion.report.csv"),
    "vtu": Format(
        "<stem>.pvd and <stem>_vtu/, for ParaView", "trunnion.report.vtu", "pyevtk", "vtk"
    ),
}


def missing(name: str) -> str:
    """Say what is not installed for a format; nothing if all is there."""
    found = FORMATS[name]
    if found.package:
        from importlib.util import find_spec

        if find_spec(found.package) is None:
            say = f"--{name} needs the package {found.package}"
            return f"{say}: pip install 'trunnion[{found.extra}]'"
    return ""


def further_files(name: str, results: Results, model: Model, folder: Path, stem: str) -> Files:
    """Make the files of one format, by their places."""
    make: Callable[[Results, Model, str], dict[str, bytes]]
    make = import_module(FORMATS[name].module).files
    return {folder / file: content for file, content in make(results, model, stem).items()}
