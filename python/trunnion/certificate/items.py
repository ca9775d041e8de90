"""Lines of a certificate: the worst of many relative errors, and where it stands."""

import math
from collections.abc import Callable, Iterable

import numpy as np

from trunnion.arrays import F8, Certificate, Item, System

LIMIT = 1e-9

Where = Callable[[int], str]


def verdict(items: Iterable[Item]) -> Certificate:
    """Pass or fail by the worst item."""
    items = tuple(items)
    worst = max(items, key=lambda item: item.value)
    where = f"{worst.name} at {worst.where}" if worst.where else worst.name
    return Certificate(worst.value <= LIMIT, worst.value, where, items)


def number(value: float) -> float:
    """Size of an error; one that is no number counts as inf."""
    return abs(float(value)) if math.isfinite(value) else math.inf


def item(name: str, relative: F8, where: Where) -> Item:
    """Worst entry of (n,) relative errors; argmax finds a NaN first."""
    if relative.size == 0:
        return Item(name, 0.0, "")
    worst = int(np.argmax(relative))
    return Item(name, number(relative[worst]), where(worst))


def six(error: F8, translational: float, rotational: float) -> F8:
    """Larger relative error of the two halves of (6, n)."""
    error = np.abs(error)
    half = np.maximum(error[:3] / translational, error[3:] / rotational)
    relative: F8 = half.max(axis=0)
    return relative


def node(system: System) -> Where:
    """Names of nodes."""
    return lambda i: f"node {system.labels[i]}"


def element(system: System) -> Where:
    """Names of elements."""
    return lambda i: f"element {system.parts[i].start}-{system.parts[i].end}"


def contact(system: System) -> Where:
    """Names of contacts: card and direction."""

    def where(i: int) -> str:
        card = system.cards[system.contacts.card[i]]
        return f"{card.kind} {card.label} {system.contacts.word[i]}"

    return where


def slider(system: System) -> Where:
    """Names of sliders: card and what presses them."""

    def where(i: int) -> str:
        card, s = system.cards[system.sliders.card[i]], system.sliders
        words = [system.contacts.word[j] for j in s.contact[s.first[i] : s.first[i + 1]]]
        return " ".join([card.kind, card.label, *words])

    return where
