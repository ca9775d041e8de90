"""Quantities of supports in a study: MU, GAP, K, KF, RATE and LOAD.

A place is `node`, `node#2` (the second card of the node, as in reports) or the NAME of a support;
after a comma stands a direction word: `GAP@60,GUIDE`.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from trunnion.arrays import Card
from trunnion.deck.values import WordError, nearest
from trunnion.many.edits import Edit, Quantity
from trunnion.model import Direction, Model, Support
from trunnion.results.supports import card_ids

Rubs = Callable[[Direction], bool]
Spot = tuple[int, int]  # number of the support and of its direction


def _cards(model: Model, label: str) -> list[int]:
    """Numbers of the supports that a place means: all where it is left out."""
    supports = model.supports
    if not label:
        return list(range(len(supports)))
    ids = card_ids([Card(s.node, s.cnode, "", s.kind, 0) for s in supports])
    names = {s.name.upper() for s in supports if s.name}
    found = [i for i, s in enumerate(supports) if s.node == label]
    if "#" in label:
        found = [i for i, own in enumerate(ids) if own == label]
    found = found or [i for i, s in enumerate(supports) if s.name and s.name.upper() == label]
    if not found:
        words = {s.node for s in supports} | names | set(ids)
        raise WordError(f"there is no support {label}{nearest(label, words)}")
    return found


def _spots(model: Model, label: str, part: str) -> list[Spot]:
    """Directions that a place and a word mean; rotations and frictionless kinds stay out."""
    cards = [i for i in _cards(model, label) if model.supports[i].kind == "support"]
    found = [(i, j) for i in cards for j in range(len(model.supports[i].directions))]
    if not found:
        raise WordError(f"no SUPPORT card stands at {label}" if label else "there is no SUPPORT")
    if part:
        words = {_at(model, spot).word for spot in found}
        found = [spot for spot in found if _at(model, spot).word == part]
        if not found:
            listed = " ".join(sorted(words))
            raise WordError(f"{part} is no direction there; there are {listed}")
    return found


def _at(model: Model, spot: Spot) -> Direction:
    return model.supports[spot[0]].directions[spot[1]]


def _turns(direction: Direction) -> bool:
    return direction.word.lstrip("+-").startswith("R")


def _narrowed(
    model: Model, spots: Sequence[Spot], label: str, part: str, has: Rubs, what: str
) -> list[Spot]:
    """Directions that have a quantity; where none has, the only one, or the one that is named."""
    found = [spot for spot in spots if has(_at(model, spot))]
    if found or not label:
        if not found:
            raise WordError(f"no support has {what}; name the place")
        return found
    free = [spot for spot in spots if not _turns(_at(model, spot))]
    if part or len(free) == 1:
        return list(spots)
    words = " ".join(_at(model, spot).word for spot in spots)
    raise WordError(f"no direction at {label} has {what}; name one after a comma: {words}")


def _edit(spots: Sequence[Spot], change: Callable[[Direction, float], Direction]) -> Edit:
    by_card: dict[int, set[int]] = {}
    for i, j in spots:
        by_card.setdefault(i, set()).add(j)

    def edit(model: Model, value: float) -> Model:
        supports = list(model.supports)
        known: dict[tuple[object, ...], tuple[Direction, ...]] = {}  # most cards are alike
        for i, which in by_card.items():
            before = supports[i].directions
            key = (tuple(which), before)
            if key not in known:
                known[key] = tuple(
                    change(d, value) if j in which else d for j, d in enumerate(before)
                )
            supports[i] = replace(supports[i], directions=known[key])
        return replace(model, supports=supports)

    return edit


def _friction(model: Model, label: str, part: str) -> Edit:
    """MU of the directions that rub in the deck, or of those named."""
    default = model.settings.mu
    spots = [spot for spot in _spots(model, label, part) if not _turns(_at(model, spot))]

    def rubs(d: Direction) -> bool:
        return (default if d.mu is None else d.mu) > 0.0

    chosen = [spot for spot in spots if rubs(_at(model, spot))]
    if not chosen and not label:
        raise WordError("no support of the deck has friction; name a place: MU@node")
    return _edit(chosen or spots, lambda d, value: replace(d, mu=value))


def _gap(model: Model, label: str, part: str) -> Edit:
    """Both sides of the gaps."""
    spots = _spots(model, label, part)
    chosen = _narrowed(model, spots, label, part, lambda d: max(d.gap) > 0.0, "a gap")
    if any(_turns(_at(model, spot)) for spot in chosen):
        raise WordError("the gap of a rotation cannot vary; name a translation")
    return _edit(chosen, lambda d, value: replace(d, gap=(value, value)))


def _stiffness(model: Model, label: str, part: str) -> Edit:
    """K: without a place that of the DEFAULT card, else of the translations of supports there."""
    if not label:
        return lambda model, value: replace(model, settings=replace(model.settings, k=value))
    cards = [i for i in _cards(model, label) if model.supports[i].kind in ("anchor", "snubber")]
    if not cards:
        spots = [spot for spot in _spots(model, label, part) if not _turns(_at(model, spot))]
        return _edit(spots, lambda d, value: replace(d, k=value))
    return _field("k", cards)


def _stick(model: Model, label: str, part: str) -> Edit:
    if not label:
        return lambda model, value: replace(model, settings=replace(model.settings, kf=value))
    spots = [spot for spot in _spots(model, label, part) if not _turns(_at(model, spot))]
    return _edit(spots, lambda d, value: replace(d, kf=value))


def _hanger(name: str) -> Callable[[Model, str, str], Edit]:
    def find(model: Model, label: str, part: str) -> Edit:
        cards = [i for i in _cards(model, label) if model.supports[i].kind == "hanger"]
        if not cards:
            raise WordError(f"no HANGER stands at {label}" if label else "there is no HANGER")
        return _field(name, cards)

    return find


def _field(name: str, cards: Sequence[int]) -> Edit:
    """Field of whole cards."""

    def edit(model: Model, value: float) -> Model:
        supports: list[Support] = list(model.supports)
        for i in cards:
            supports[i] = replace(supports[i], **{name: value})  # type: ignore[arg-type]
        return replace(model, supports=supports)

    return edit


SUPPORTS: Mapping[str, Quantity] = {
    "MU": Quantity("SUPPORT", "MU", _friction, "friction where there is any", "supports"),
    "GAP": Quantity("SUPPORT", "GAP", _gap, "both sides of the gaps", "supports"),
    "K": Quantity("SUPPORT", "K", _stiffness, "stiffness; without place DEFAULT K", "supports"),
    "KF": Quantity("SUPPORT", "KF", _stick, "stick stiffness; without DEFAULT KF", "supports"),
    "RATE": Quantity("HANGER", "RATE", _hanger("k"), "rate of a hanger, or of all", "supports"),
    "LOAD": Quantity("HANGER", "LOAD", _hanger("load"), "cold load of a hanger", "loads"),
}
