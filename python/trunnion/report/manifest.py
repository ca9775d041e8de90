"""What a stored result was made of, so that the run can be repeated: nothing of the machine."""

from typing import Any

from trunnion._version import VERSION
from trunnion.model import Model
from trunnion.report.encode import dump


def manifest_entry(model: Model) -> str:
    """Give the member "manifest" of the JSON report."""
    return dump(manifest_of(model))


def manifest_of(model: Model) -> dict[str, Any]:
    """Name the input file, its hash, the version, the settings and what was said beside it."""
    if model.file is None:
        raise ValueError("a model that was not read from a file has no manifest")
    settings, beside = model.settings, model.file.beside
    found: dict[str, Any] = {
        "deck": model.file.name,
        "sha256": model.file.sha256,
        "version": VERSION,
        "settings": {
            "iteration": settings.iteration,
            "events": settings.events,
            "permissive": model.origin is not None and bool(model.origin.left_out),
        },
    }
    if beside is not None:
        found["options"] = {
            "table": beside.table,
            "table_sha256": beside.table_sha256,
            "tolerance": beside.tolerance,
            "anchors": list(beside.anchors),
        }
    return found
