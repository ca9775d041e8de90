"""Decks of published problems, solved once each, and their answers by label."""

from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import trunnion
from trunnion.arrays import OPEN, CaseResult, ModeSet, Results, System
from trunnion.model import Model
from trunnion.results.interior import points
from trunnion.results.supports import card_forces

MODELS = Path(__file__).parents[2] / "models"
HERE = Path(__file__).parent
LEFT_OUT = pytest.StashKey[bool]()


def pytest_deselected(items):
    """Remember that a run leaves tests out: it cannot make the whole record."""
    for item in items[:1]:
        item.config.stash[LEFT_OUT] = True


def pytest_collection_modifyitems(items):
    """Put the record of all comparisons behind them."""
    items.sort(key=lambda item: item.path.name == "test_verification_record.py")


@pytest.fixture(scope="session")
def whole_folder(request):
    """Whether every test of this folder runs in this process."""
    config = request.config
    parts = any("::" in argument for argument in config.args) or hasattr(config, "workerinput")
    here = {item.path.name for item in request.session.items if item.path.parent == HERE}
    left_out = parts or config.stash.get(LEFT_OUT, False)
    return not left_out and here == {path.name for path in HERE.glob("test_*.py")}


class Answer:
    """Numbers of one certified case, by label; forces act on the pipe, on the element."""

    def __init__(self, result: CaseResult) -> None:
        assert result.converged, result.cause
        assert result.certificate is not None
        assert result.certificate.passed, result.certificate
        assert result.certificate.worst <= 1e-9
        self.result = result
        self.system = result.system
        self.state = result.state

    def node(self, label: str) -> int:
        """Number of a node."""
        if label in self.system.alias:
            return self.system.alias[label]
        return self.system.labels.index(label)

    def u(self, label: str) -> np.ndarray:
        """Displacement [m, rad]."""
        n = self.node(label)
        return self.state.u[n] + self.state.u_low[n]

    def rigid_u(self, label: str) -> np.ndarray:
        """Displacement corrected to rigid supports [m, rad]."""
        return self.u(label) + self.result.penalty_u[self.node(label)]

    def support(self, label: str) -> np.ndarray:
        """Force and moment of all cards at a node on the pipe [N, N m]."""
        forces = card_forces(self.result)
        return sum(f for f, c in zip(forces, self.system.cards, strict=True) if c.label == label)

    def load(self, label: str) -> np.ndarray:
        """Force and moment of the pipe on its support, as the trade prints them [N, N m]."""
        return -self.support(label)

    def side(self, label: str, word: str) -> int:
        """Side on which a contact is closed."""
        return int(self.state.side[self.contact(label, word)])

    def is_open(self, label: str, word: str) -> bool:
        """Tell whether a contact is open."""
        return self.side(label, word) == OPEN

    def contact(self, label: str, word: str) -> int:
        """Number of a contact."""
        c = self.system.contacts
        found = [
            i
            for i in range(len(c.node))
            if self.system.cards[c.card[i]].label == label and c.word[i] == word
        ]
        assert len(found) == 1, f"{len(found)} contacts {word} at {label}"
        return found[0]

    def slider(self, label: str, word: str | None = None) -> int:
        """Number of the slider at a node, of the contact `word` where there are several."""
        s, c = self.system.sliders, self.system.contacts
        found = [
            i
            for i in range(len(s.mu))
            if self.system.cards[s.card[i]].label == label
            and word in (None, c.word[s.contact[s.first[i]]])
        ]
        assert len(found) == 1, f"{len(found)} sliders at {label}"
        return found[0]

    def element(self, start: str, end: str) -> int:
        """Number of the element between two nodes."""
        ends = [self.node(start), self.node(end)]
        found = [i for i, e in enumerate(self.system.ends.tolist()) if e == ends]
        assert len(found) == 1, f"{len(found)} elements {start}-{end}"
        return found[0]

    def end(self, start: str, end: str, at: int = 0) -> np.ndarray:
        """Force and moment on an element at its end 0 or 1 [N, N m], global."""
        return self.state.end_force[self.element(start, end), at]

    def tangent(self, start: str, end: str, at: int = 0) -> np.ndarray:
        """Unit vector along an element at its end 0 or 1."""
        e = self.element(start, end)
        turned = at * self.system.angle[e]
        return np.cos(turned) * self.system.axes[e, 0] + np.sin(turned) * self.system.axes[e, 1]

    def interior(self, label: str) -> tuple[np.ndarray, np.ndarray]:
        """Displacement and section force N Vy Vz T My Mz in the middle of a bend (30M)."""
        return self._point(self.system.mid[label], 0.5)

    def along(self, start: str, end: str, fraction: float) -> tuple[np.ndarray, np.ndarray]:
        """Displacement and section force at a part of the length of an element."""
        return self._point(self.element(start, end), fraction)

    def _point(self, element: int, fraction: float) -> tuple[np.ndarray, np.ndarray]:
        at = points(self.result, np.array([element]), np.array([fraction]))
        return at.displacement[0], at.section_force[0]


class Run:
    """A solved deck: `run["OPE"]` is the answer of a case."""

    def __init__(self, model: Model) -> None:
        self.model = model
        self.results: Results = trunnion.solve(model)

    def __getitem__(self, case: str) -> Answer:
        return Answer(self.results[case])


@cache
def _read(name: str) -> Model:
    return trunnion.read(MODELS / f"{name}.inp")


@cache
def _run(name: str) -> Run:
    return Run(_read(name))


@pytest.fixture(scope="session")
def deck():
    """Read a deck of models/ by name."""
    return _read


@pytest.fixture(scope="session")
def run():
    """Solve a deck of models/ by name."""
    return _run


@pytest.fixture(scope="session")
def solve():
    """Solve a model with some of its settings changed."""

    def run_model(model: Model, **settings: object) -> Run:
        return Run(replace(model, settings=replace(model.settings, **settings)))

    return run_model


@pytest.fixture(scope="session")
def answer():
    """Give the numbers of a case by label."""
    return Answer


INCH, POUND = 0.0254, 4.4482216152605
COMPONENTS = ("UX", "UY", "UZ", "RX", "RY", "RZ")


@dataclass(frozen=True)
class Shaken:
    """Modes of a deck and its spectrum cases, in inches and pounds."""

    model: Model
    system: System
    modes: ModeSet
    cases: dict[str, CaseResult]

    def node(self, label: str) -> int:
        """Number of a node."""
        found = self.system.alias.get(label)
        return self.system.labels.index(label) if found is None else found

    def movement(self, case: str, label: str, component: str) -> float:
        """Largest displacement [in, rad]."""
        i = COMPONENTS.index(component)
        u = float(self.cases[case].state.u[self.node(label), i])
        return u / INCH if i < 3 else u

    def end(self, case: str, start: str, end: str, at: int) -> np.ndarray:
        """N Vy Vz T My Mz at end 0 or 1 of an element, in the axes of that end [lbf, in lbf]."""
        pair = [self.node(start), self.node(end)]
        force = self.cases[case].gathered.local_force[self.system.ends.tolist().index(pair), at]
        return force / (POUND * np.array([1.0, 1.0, 1.0, INCH, INCH, INCH]))

    def reaction(self, case: str, label: str, direction: str) -> float:
        """Load of a support [lbf]."""
        at = [card.label for card in self.system.cards].index(label)
        return float(self.cases[case].gathered.card_force[at, "XYZ".index(direction)] / POUND)


def _shake(model: Model) -> Shaken:
    """Modes and spectrum cases of a model."""
    results = trunnion.solve(model)
    cases = {name: case for name, case in results.cases.items() if case.kind == "spectrum"}
    return Shaken(model, next(iter(cases.values())).system, results.modes, cases)


@cache
def _shaken(name: str) -> Shaken:
    return _shake(_read(name))


@pytest.fixture(scope="session")
def shake():
    """Find the modes of a model and solve its spectrum cases."""
    return _shake


@pytest.fixture(scope="session")
def shaken():
    """Give modes and spectrum cases of a deck of models/ by name."""
    return _shaken
