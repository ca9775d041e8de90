"""Load cases of a model that names none: SUS, OPE, EXP, and OCC for occasional loads."""

from dataclasses import replace

from trunnion.model import Case, Comb, Expression, Model, Place, Term

DEFAULT = Place("<default>")


def with_cases(model: Model) -> Model:
    """Give the model itself when it has cases, else one that shares all and has default cases."""
    return model if model.cases else replace(model, cases=default_cases(model))


def may_be_free(model: Model) -> bool:
    """Tell whether modes alone will do, where the structure is not held and no case is named."""
    modal = model.modal
    return not model.cases and not model.cycles and modal is not None and modal.about is None


def default_cases(model: Model) -> list[Case | Comb]:
    """Cases that follow from the load sets a model gives.

    SUS = W + H + P (first set) + F1.  OPE for each set of temperatures, pressures and
    displacements that differs from SUS: W + H + Pn + Tn + Dn + F1.  EXP = OPE - SUS.  Every
    occasional set (U, WIND, S, F2 to F9) is a linear case about the first OPE, and OCC takes
    them one at a time: ABS(SUS) + MAX(BY_U1, BY_WIND1 ...).
    """
    t = {s for pipe in model.pipes for s in pipe.operation.t}
    p = {s for pipe in model.pipes for s in pipe.operation.p}
    d = {item.set for item in model.displacements}
    f = {item.set for item in model.forces}
    always = ["W"] + ["H"] * any(s.kind == "hanger" for s in model.supports)
    first = [f"P{min(p)}"] if p else []
    sustained = always + first + ["F1"] * ("1" in f)
    found: list[Case | Comb] = [_case("SUS", sustained)]
    operating = []
    for s in sorted(t | p | d):
        pressure = [f"P{s}"] if s in p else first
        sets = always + pressure + [f"T{s}"] * (s in t) + [f"D{s}"] * (s in d)
        sets += ["F1"] * ("1" in f)
        if sets != sustained:
            operating.append((s, sets))
    one = len(operating) == 1
    names = {s: "" if one else s for s, _ in operating}
    found += [_case(f"OPE{names[s]}", sets) for s, sets in operating]
    for number in names.values():
        ends = _name(f"OPE{number}"), _name("SUS")
        found.append(Comb(f"EXP{number}", ("-", *ends), f"OPE{number} - SUS", DEFAULT))
    return found + _occasional(model, found[1].name if operating else "SUS", f)


def _occasional(model: Model, about: str, forces: set[str]) -> list[Case | Comb]:
    """Linear cases of the occasional sets about a case, and their envelope on SUS."""
    sets = [f"U{s}" for s in sorted({a.set for a in model.accelerations})]
    sets += [f"WIND{s}" for s in sorted({w.set for w in model.winds})]
    sets += ["S"] * bool(model.snows)
    sets += [f"F{s}" for s in sorted(forces - {"1"})]
    if not sets:
        return []
    found: list[Case | Comb] = [replace(_case(f"BY_{s}", [s]), about=about) for s in sets]
    largest: Expression = ("max", *(_name(case.name) for case in found))
    expression = ("+", ("abs", _name("SUS")), largest)
    text = f"ABS(SUS) + MAX({','.join(case.name for case in found)})"
    return [*found, Comb("OCC", expression, text, DEFAULT)]


def _case(name: str, sets: list[str]) -> Case:
    return Case(name, tuple(Term(1.0, s) for s in sets), place=DEFAULT)


def _name(case: str) -> Expression:
    return ("case", case)


def is_operating(case: Case) -> bool:
    """Tell whether a case can give travels: weight with temperature or movements, from rest."""
    names = {term.name for term in case.terms}
    plain = case.about is None and case.on is None and case.spectrum is None
    return plain and bool(names & {"W", "WNC", "WW"}) and any(n[0] in "TD" for n in names)
