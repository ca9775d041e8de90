"""What a model made from a foreign file does not contain, on top of every report."""

from trunnion.origin import Origin
from trunnion.report.columns import section, wrapped
from trunnion.report.encode import dump


def origin_text(origin: Origin | None) -> str:
    """Top of the text report; nothing for a deck."""
    if origin is None:
        return ""
    text = f"\nMade from {origin.file}: {origin.format}\n"
    if origin.left_out:
        note = "of that file, and not in these results"
        text += section(f"LEFT OUT ({len(origin.left_out)})", note)
        text += "".join(wrapped(str(entry)) for entry in origin.left_out)
    if origin.assumed:
        text += section("ASSUMED", "where that file is silent")
        text += "".join(wrapped(str(entry)) for entry in origin.assumed)
    return text


def origin_entry(origin: Origin) -> str:
    """Give the member "origin" of the JSON report."""
    left_out = [
        {"element": x.element, "feature": x.feature, "where": x.where} for x in origin.left_out
    ]
    assumed = [{"text": x.text, "where": x.where} for x in origin.assumed]
    return dump(
        {
            "file": origin.file,
            "format": origin.format,
            "left_out": left_out,
            "assumed": assumed,
        }
    )
