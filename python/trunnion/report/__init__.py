"""Reports: everything that formats numbers for people and files."""

import gc
from pathlib import Path

from trunnion.arrays import Results
from trunnion.model import Model
from trunnion.report.atomic import write_files


def write_reports(
    results: Results, model: Model, folder: Path, stem: str, *, h5: bool = False
) -> list[Path]:
    """Write <stem>.out, <stem>.json and on demand <stem>.h5, all of them or none."""
    files = report_files(results, model, folder, stem, h5=h5)
    write_files(files)
    return list(files)


def report_files(
    results: Results, model: Model, folder: Path, stem: str, *, h5: bool = False
) -> dict[Path, bytes]:
    """Give the reports by their places, without writing them."""
    from trunnion.report.json import json_report
    from trunnion.report.text import text_report

    collects = gc.isenabled()
    gc.disable()  # millions of small strings, no cycles: half the time
    try:
        files = {
            folder / f"{stem}.out": text_report(results, model),
            folder / f"{stem}.json": json_report(results, model),
        }
        if h5:
            from trunnion.report.hdf5 import hdf5_report

            files[folder / f"{stem}.h5"] = hdf5_report(results)
    finally:
        if collects:
            gc.enable()
    return files
