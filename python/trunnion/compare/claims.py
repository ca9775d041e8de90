"""What a file claims beside its numbers: certificates, texts, title, settings, tables of others.

A stored certificate must be the one that its numbers give: items within `NEAR` (round-off of
another machine), `worst` and `passed` those of its items.  In sums of cases, whose first item
is `sum`, and in combinations of these, stored items are upper bounds (docs/theory.md).
"""

from collections.abc import Iterator, Mapping
from typing import Any

from trunnion.arrays import Certificate
from trunnion.model import Model

NEAR = 1e-12  # a thousandth of what a certificate allows
BEYOND = 1e300  # stands for an item without a number
NO_MODES: dict[str, list[float]] = {"frequency_hz": []}
OPTIONAL = ("cycles", "winds", "hangers")


def false_claim(found: Certificate | None, stored: Mapping[str, Any]) -> str:
    """Say where a stored certificate is not that of the numbers; nothing if it is.

    Raises
    ------
    KeyError, TypeError, ValueError, AttributeError : it is no certificate.
    """
    if found is None:
        return ""
    claimed = stored["certificate"]
    items = {item["name"]: _number(item["value"]) for item in claimed["items"]}
    own = {item.name: item.value for item in found.items}
    bounds = "sum" in items
    for name in dict.fromkeys([*own, *items]):
        if name == "sum" and name not in own:
            continue
        if name not in own or name not in items:
            return f"certificate: {name} is in one of file and numbers only"
        far = own[name] - items[name] if bounds else abs(own[name] - items[name])
        if not far <= NEAR:
            return f"certificate: {name} is {items[name]:.1e}, the numbers give {own[name]:.1e}"
    for name, value in items.items():
        if _number(claimed[name]) != value:
            return f"certificate: {name} is not that of its items"
    worst = max(items.values(), default=0.0)
    if _number(claimed["worst"]) != worst:
        return "certificate: worst is not the largest of its items"
    if claimed["passed"] is not True:
        return "certificate: passed is not true, the numbers pass"
    return ""


def false_members(report: Mapping[str, Any], model: Model) -> Iterator[tuple[str, str]]:
    """Yield by name what the file says of its deck that the deck does not say."""
    from trunnion.report.manifest import manifest_of

    if report.get("title") != model.title:
        yield "title", "not that of the deck"
    manifest = report.get("manifest") or {}
    if model.file is not None and manifest.get("settings") != manifest_of(model)["settings"]:
        yield "manifest", "settings are not those of the deck"
    if model.modal is None and report.get("modes") != NO_MODES:
        yield "modes", "the deck asks for none"
    given = {"cycles": model.cycles, "winds": model.winds}
    given["hangers"] = tuple(s for s in model.supports if s.design is not None)
    for name in OPTIONAL:
        if report.get(name) and not given[name]:
            yield name, "the deck asks for none"


def _number(value: float | None) -> float:
    return BEYOND if value is None else float(value)
