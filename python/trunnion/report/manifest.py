"""What a stored result was made of, so that the run can be repeated: nothing of the machine."""

from trunnion._version import VERSION
from trunnion.model import Model
from trunnion.report.encode import dump


def manifest_entry(model: Model) -> str:
    """Give the member "manifest" of the JSON report."""
    if model.file is None:
        raise ValueError("a model that was not read from a file has no manifest")
    settings = model.settings
    return dump(
        {
            "deck": model.file.name,
            "sha256": model.file.sha256,
            "version": VERSION,
            "settings": {
                "iteration": settings.iteration,
                "events": settings.events,
                "permissive": model.origin is not None and bool(model.origin.left_out),
            },
        }
    )
