"""Reports: everything that formats numbers for people and files."""

from collections.abc import Iterable
from pathlib import Path

from trunnion.arrays import Results
from trunnion.collector import paused
from trunnion.model import Model
from trunnion.report.atomic import write_files


def write_reports(
    results: Results, model: Model, folder: Path, stem: str, *, also: Iterable[str] = ()
) -> list[Path]:
    """Write <stem>.out, <stem>.json and what else is asked for, all of them or none.

    Parameters
    ----------
    also : names of `report.outputs.OUTPUTS`: h5, xlsx, csv, vtu.
    """
    files = report_files(results, model, folder, stem, also=also)
    write_files(files)
    return list(files)


def report_files(
    results: Results, model: Model, folder: Path, stem: str, *, also: Iterable[str] = ()
) -> dict[Path, bytes]:
    """Give the reports by their places, without writing them."""
    from trunnion.report.json import json_report
    from trunnion.report.text import text_report

    with paused():  # millions of small strings: half the time
        files = {
            folder / f"{stem}.out": text_report(results, model),
            folder / f"{stem}.json": json_report(results, model),
        }
        for name in also:
            from trunnion.report.outputs import further_files

            files |= further_files(name, results, model, folder, stem)
    return files
