"""How a scene ends: certified and right, refused by name, or wrong."""

import signal
from dataclasses import dataclass
from pipes import Scene

import numpy as np
from law import violation

import trunnion
from trunnion.cases.analysis import Start
from trunnion.errors import DeckError, ModelError

LIMIT = 1e-8  # of the laws: the certificate's 1e-9 has denominators of its own
BACK = 1e-9  # of the chosen displacements
SECONDS = 60  # of one scene; more is a hang
GIVEN_BACK, ANOTHER, LAWFUL = "given back", "another answer", "certified"


@dataclass
class Outcome:
    """`word` is the category; a `wrong` one must never be."""

    seed: int
    kind: str
    word: str
    detail: str = ""
    wrong: bool = False


class HangError(Exception):
    """A scene takes too long."""


def outcome(scene: Scene) -> Outcome:
    """Solve a scene and judge how it ends."""

    def hang(*_: object) -> None:
        raise HangError

    before = signal.signal(signal.SIGALRM, hang)
    signal.alarm(SECONDS)
    try:
        return _outcome(scene)
    except HangError:
        return Outcome(scene.seed, scene.kind, "hang", f"more than {SECONDS} s", wrong=True)
    except Exception as error:
        return Outcome(scene.seed, scene.kind, "traceback", repr(error)[:200], wrong=True)
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


def _outcome(scene: Scene) -> Outcome:
    def say(word: str, detail: str = "", *, wrong: bool = False) -> Outcome:
        return Outcome(scene.seed, scene.kind, word, detail, wrong)

    try:
        case = trunnion.solve(scene.model)["A"]
    except (DeckError, ModelError) as error:
        return say("refused: " + _kind_of(str(error)), str(error).splitlines()[0][:160])
    if case.state is None:
        return say("not converged: " + _kind_of(case.cause or ""), (case.cause or "")[:160])
    off, where = violation(scene, case)
    if not off <= LIMIT:
        return say("wrong by a law", f"{where} {off:.1e}", wrong=True)
    if not scene.u:
        return say(LAWFUL)
    if _misses(scene, case) <= BACK:
        return say(GIVEN_BACK)
    if not scene.friction:
        return say("wrong without friction", f"{_misses(scene, case):.1e}", wrong=True)
    found = trunnion.solve(scene.model, starts={"A": Start(_chosen_capacities(scene, case))})["A"]
    if found.state is not None and _misses(scene, found) <= BACK:
        return say(ANOTHER, "the chosen one is found from its own capacities")
    return say(ANOTHER, "the chosen one is not found again")


def _misses(scene: Scene, case: trunnion.arrays.CaseResult) -> float:
    """Distance from the chosen displacements, of the largest movement and rotation."""
    u = case.state.u + case.state.u_low
    chosen = np.array([[float(x) for x in scene.u[int(i)]] for i in case.system.labels])
    error, size = np.abs(u - chosen), np.abs(chosen)
    move = max(size[:, :3].max(), 1e-300)
    turn = max(size[:, 3:].max(), 1e-3 * move)
    return float(max(error[:, :3].max() / move, error[:, 3:].max() / turn))


def _chosen_capacities(scene: Scene, case: trunnion.arrays.CaseResult) -> np.ndarray:
    sliders, cards = case.system.sliders, case.system.cards
    rests = iter(scene.rests)
    of_card = {i: next(rests) for i, card in enumerate(cards) if card.kind != "anchor"}
    push = [abs(float(of_card[c].force["XYZ".index(of_card[c].word[-1])])) for c in sliders.card]
    return sliders.mu * np.array(push)


def _kind_of(text: str) -> str:
    for words in ("without bound", "out of balance", "certificate", "do not settle", "no restraint",
                  "still change", "nothing resists", "undetermined"):  # fmt: skip
        if words in text:
            return words
    return text[:40]
