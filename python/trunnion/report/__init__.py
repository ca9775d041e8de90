"""Reports: everything that formats numbers for people and files."""

from collections.abc import Iterable
from pathlib import Path

from trunnion.arrays import Results
from trunnion.collector import paused
from trunnion.model import Model
from trunnion.report.atomic import write_files
from trunnion.watch import Watch


def write_reports(
    results: Results,
    model: Model,
    folder: Path,
    stem: str,
    *,
    also: Iterable[str] = (),
    watch: Watch | None = None,
) -> list[Path]:
    """Write <stem>.out, <stem>.json and what else is asked for, all of them or none.

    Parameters
    ----------
    also : names of `report.outputs.OUTPUTS`: h5, xlsx, csv, vtu, png, html.
    watch : is told what is being written.
    """
    files = report_files(results, model, folder, stem, also=also, watch=watch)
    write_files(files)
    return list(files)


def report_files(
    results: Results,
    model: Model,
    folder: Path,
    stem: str,
    *,
    also: Iterable[str] = (),
    watch: Watch | None = None,
) -> dict[Path, bytes]:
    """Give the reports by their places, without writing them."""
    from trunnion.report.json import json_report
    from trunnion.report.text import text_report

    watch = watch or Watch()
    with paused():  # millions of small strings: half the time
        watch.turn(f"writing {stem}.out")
        files = {folder / f"{stem}.out": text_report(results, model)}
        watch.turn(f"writing {stem}.json")
        files[folder / f"{stem}.json"] = json_report(results, model)
        for name in also:
            from trunnion.report.outputs import further_files

            watch.turn(f"writing {name}")
            files |= further_files(name, results, model, folder, stem)
    return files
