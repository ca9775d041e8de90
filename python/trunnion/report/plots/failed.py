"""The picture of a case without numbers: what it is, why, which restraints were restless."""

from collections import Counter
from textwrap import wrap

from matplotlib.figure import Figure

from trunnion.arrays import CaseResult
from trunnion.report.causes import told_cause
from trunnion.report.counts import counted
from trunnion.report.plots import legend
from trunnion.report.plots.drawing import length_bar, triad
from trunnion.report.plots.glyphs import glyphs, stand
from trunnion.report.plots.page import EDGE, FOOT, HEIGHT, LARGE, TOP, WIDTH, page, put
from trunnion.report.plots.palette import NO_STATE, STATES
from trunnion.report.plots.pipe import plain_faces
from trunnion.report.plots.scene import Subject, draw_model, frame_of, label_nodes, occupied
from trunnion.report.units import ReportUnits
from trunnion.results.supports import card_nodes

PANEL = 3.3
PLACE = EDGE, FOOT, WIDTH - 2 * EDGE - PANEL - 0.2, HEIGHT - TOP - FOOT
LAST = 20  # iterations whose changes are told
NAMED = 12
COLUMNS = 46  # characters of a line of the cause


def failed(found: Subject, case: CaseResult, units: ReportUnits, title: str) -> Figure:
    """Draw the model with its restless restraints marked; there are no numbers in it."""
    system = case.system
    what = f"{case.name} = {case.text}:  NOT CONVERGED, no numbers"
    figure = page(title, what, found.caution)
    frame = frame_of(figure, PLACE, found)
    standing = stand(system, frame, found.course)
    bodies = glyphs(system, standing)
    restless = restless_supports(case)
    names = [card.name for card in system.cards]
    looks = [STATES["slip"] if names[g.card] in restless else NO_STATE for g in bodies]
    draw_model(frame, found, plain_faces(found.system, found.course), looks, bodies, standing)
    triad(frame, system.up, found.north)
    length_bar(frame, units.length)
    nodes = card_nodes(system)
    order = sorted(range(len(nodes)), key=lambda i: (-restless.get(names[i], 0), i))
    space = occupied(frame, found, None, bodies)
    order = list({nodes[i]: i for i in reversed(order)}.values())[::-1]
    label_nodes(
        frame, space, [system.cards[i].label for i in order],
        system.xyz[[nodes[i] for i in order]], bold=[names[i] in restless for i in order],
    )  # fmt: skip
    x, y = WIDTH - EDGE - PANEL, HEIGHT - TOP - 0.1
    put(
        figure, x, y, "NOT CONVERGED", size=LARGE, colour=STATES["slip"].colour, bold=True, top=True
    )
    y = legend.lines(figure, x, y - 0.35, PANEL, wrap(told_cause(case, units), COLUMNS)[:8]) - 0.15
    if restless:
        y = legend.heading(figure, x, y, f"CHANGED STATE IN THE LAST {LAST} ITERATIONS")
        rows = [f"{name}: {counted(n, 'time')}" for name, n in restless.most_common(NAMED)]
        more = [f"and {len(restless) - NAMED} more"] if len(restless) > NAMED else []
        legend.lines(figure, x, y, PANEL, rows + more)
    return figure


def restless_supports(case: CaseResult) -> Counter[str]:
    """Count the changes of state of each support in the last iterations, as far as named there."""
    count: Counter[str] = Counter()
    for record in case.history[-LAST:]:
        changed = record.get("changed")
        if isinstance(changed, list):
            count.update(str(name) for name in changed)
    return count
