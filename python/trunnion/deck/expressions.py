"""Grammar of CASE and COMB: sums of load sets, and expressions of case names.

expression = [+|-] product {(+|-) product}
product    = number * product | (expression) | function(expression {, expression}) | name
           | U(x,y,z) | SPECTRUM(name,direction[,factor[,group]])
"""

import re
from typing import Any, NoReturn

from trunnion.deck.keywords import ACCELERATIONS, KEYWORDS, WINDS
from trunnion.deck.values import nearest
from trunnion.model import INFINITE, SETS, Case, Expression, Shock, Term

MAX_NESTING = 50
MAX_NAMES = 200  # in one expression
LOAD_SETS = (
    *("W", "WNC", "WW", "H", "S", "CS"),
    *(letter + s for letter in "TPDFQ" for s in SETS),
    *ACCELERATIONS,
    *WINDS,
)
FUNCTIONS = ("ABS", "SRSS", "MAX", "MIN", "SIGNMAX", "SCALAR")
RESERVED = frozenset(
    (
        *LOAD_SETS,
        *("U", "WIND", "SPECTRUM"),
        *FUNCTIONS,
        *(flag for flag, _ in KEYWORDS["CASE"].flags),
    )
)

_TOKEN = re.compile(
    r"\s*(?:((?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:E[+-]?[0-9]+)?)|([A-Z_][A-Z0-9_.]*)|(\S))", re.I
)


class ExpressionError(ValueError):
    """A fault with its place in the text: characters `start` to `stop`."""

    def __init__(self, message: str, start: int, stop: int) -> None:
        super().__init__(message)
        self.start, self.stop = start, stop


class _Parser:
    """Recursive descent over the tokens (kind, text, start, stop) of one expression."""

    def __init__(self, text: str) -> None:
        self.tokens: list[tuple[str, str, int, int]] = []
        kinds = ("number", "name", "sign")
        for match in _TOKEN.finditer(text.rstrip()):
            i = match.lastindex or 3
            self.tokens.append((kinds[i - 1], match[i].upper(), match.start(i), match.end(i)))
        self.end = len(text.rstrip())
        self.at = 0
        self.depth = 0
        self.names = 0

    def peek(self) -> str:
        """Text of the next token, "" at the end."""
        return self.tokens[self.at][1] if self.at < len(self.tokens) else ""

    def fail(self, message: str, token: int | None = None) -> NoReturn:
        """Raise a fault at a token, by default the next one."""
        i = self.at if token is None else token
        if i < len(self.tokens):
            raise ExpressionError(message, self.tokens[i][2], self.tokens[i][3])
        raise ExpressionError(message, max(0, self.end - 1), self.end)

    def take(self, wanted: str) -> None:
        """Step over a token that must be there."""
        if self.peek() != wanted:
            self.fail(f"{wanted} is missing before {self.peek() or 'the end'}")
        self.at += 1

    def sum(self) -> Expression:
        """Read [+|-] product {(+|-) product}."""
        self.depth += 1
        if self.depth > MAX_NESTING:
            self.fail(f"parentheses are nested more than {MAX_NESTING} deep")
        sign = self.peek()
        if sign in ("+", "-"):
            self.at += 1
        left = self.product()
        if sign == "-":
            left = ("neg", left)
        while (sign := self.peek()) in ("+", "-") and sign:
            self.at += 1
            left = (sign, left, self.product())
        self.depth -= 1
        return left

    def product(self) -> Expression:
        """Read one product."""
        if self.at >= len(self.tokens):
            self.fail("a name is missing at the end")
        kind, text, *_ = self.tokens[self.at]
        self.at += 1
        if kind == "number":
            if self.peek() != "*":
                self.fail(f"{text} is a plain number; write {text}*NAME", self.at - 1)
            self.at += 1
            self.depth += 1
            if self.depth > MAX_NESTING:
                self.fail(f"factors are nested more than {MAX_NESTING} deep")
            value = float(text)
            if value - value != 0.0:
                self.fail(f"{text} is not a finite number", self.at - 2)
            found: Expression = ("*", value, self.product())
            self.depth -= 1
            return found
        if text == "(":
            found = self.sum()
            self.take(")")
            return found
        if kind == "name" and self.peek() == "(":
            return self.function(text)
        if kind == "name":
            self.count_name(self.at - 1)
            return ("case", text)
        self.fail(f"{text} where a name or a number should stand", self.at - 1)

    def count_name(self, token: int) -> None:
        """Keep expressions short enough for recursion."""
        self.names += 1
        if self.names > MAX_NAMES:
            self.fail(f"more than {MAX_NAMES} names", token)

    def function(self, text: str) -> Expression:
        """Read ABS(expression), SRSS(expression, ...), U(x,y,z) or SPECTRUM(...)."""
        named = self.at - 1
        self.at += 1
        if text in FUNCTIONS:
            inner = [self.sum()]
            while self.peek() == "," and text != "ABS":
                self.at += 1
                inner.append(self.sum())
            if self.peek() == ",":
                self.fail("ABS takes one expression; write ABS(A) + ABS(B)", named)
            self.take(")")
            return (text.lower(), *inner)
        if text == "U":
            return self.vector()
        if text == "SPECTRUM":
            return self.shock()
        self.fail(f"{text} is no function; functions are {' '.join(FUNCTIONS)}", named)

    def vector(self) -> Expression:
        """Read the rest of U(x,y,z)."""
        start = self.at - 2
        parts: list[float] = []
        while len(parts) < 3:
            sign = -1.0 if self.peek() == "-" else 1.0
            if self.peek() in ("+", "-"):
                self.at += 1
            if self.at >= len(self.tokens) or self.tokens[self.at][0] != "number":
                self.fail("U(x,y,z) takes three numbers, in g", start)
            parts.append(sign * float(self.peek()))
            self.at += 1
            if len(parts) < 3:
                self.take(",")
        self.take(")")
        self.count_name(start)
        return ("vector", *parts)

    def shock(self) -> Expression:
        """Read the rest of SPECTRUM(name,direction[,factor[,group]])."""
        start = self.at - 2
        parts: list[str] = []
        while not parts or self.peek() == ",":
            if parts:
                self.at += 1
            words = []
            while self.at < len(self.tokens) and self.peek() not in (",", ")", "("):
                words.append(self.peek())
                self.at += 1
            parts.append("".join(words))
        self.take(")")
        self.count_name(start)
        if not 2 <= len(parts) <= 4 or not all(parts):
            self.fail("write SPECTRUM(name,direction[,factor[,group]])", start)
        if parts[1] not in ("X", "Y", "Z"):
            self.fail(f"direction {parts[1]} of a SPECTRUM is not one of X Y Z", start)
        try:
            factor = float(parts[2]) if len(parts) > 2 else 1.0
        except ValueError:
            self.fail(f"factor {parts[2]} of a SPECTRUM is not a number", start)
        if not 0.0 < factor < INFINITE:
            self.fail(f"factor {parts[2]} of a SPECTRUM must be > 0", start)
        return ("shock", parts[0], parts[1], factor, parts[3] if len(parts) > 3 else None)


def parse(text: str) -> Expression:
    """Parse an expression; an ExpressionError tells where it goes wrong."""
    parser = _Parser(text)
    expression = parser.sum()
    if parser.at < len(parser.tokens):
        word = parser.tokens[parser.at][1]
        if word == ")":
            parser.fail(") has no (")
        hint = "; * binds a number on the left of a name" if word == "*" else ""
        parser.fail(f"{word} where + or - should stand{hint}")
    return expression


def terms(expression: Expression, factor: float = 1.0) -> list[Term]:
    """Multiply a sum of load sets out to factors and names."""
    match expression:
        case ("case", str(name)):
            return [Term(factor, name)]
        case ("vector", float(x), float(y), float(z)):
            return [Term(factor, "U", (x, y, z))]
        case ("neg", tuple(a)):
            return terms(a, -factor)
        case ("*", float(n), tuple(a)):
            return terms(a, factor * n)
        case ("+", tuple(a), tuple(b)):
            return terms(a, factor) + terms(b, factor)
        case ("-", tuple(a), tuple(b)):
            return terms(a, factor) + terms(b, -factor)
    name = str(expression[0]).upper()
    raise ValueError(f"{name} combines results; it stands on COMB cards only")


def shocks(expression: Expression, factor: float = 1.0) -> list[Shock]:
    """Multiply a sum of SPECTRUM(...) out to shocks."""
    match expression:
        case ("shock", str(name), str(direction), float(own), group):
            return [Shock(name, direction, factor * own, None if group is None else str(group))]
        case ("*", float(n), tuple(a)) if n > 0.0:
            return shocks(a, factor * n)
        case ("+", tuple(a), tuple(b)):
            return shocks(a, factor) + shocks(b, factor)
    raise ValueError("a response spectrum case is a sum of SPECTRUM(...) alone, with + between")


def case_names(expression: Any) -> list[str]:
    """Names of the cases in an expression, in order."""
    if expression[0] == "case":
        return [expression[1]]
    return [n for part in expression[1:] if isinstance(part, tuple) for n in case_names(part)]


def has(word: str, expression: Any) -> bool:
    """Tell whether a word is in an expression: "vector" is U(x,y,z), "shock" SPECTRUM(...)."""
    parts = (part for part in expression[1:] if isinstance(part, tuple))
    return expression[0] == word or any(has(word, part) for part in parts)


def format_expression(expression: Any, inner: bool = False) -> str:
    """Write an expression in one standard form, which parses to an equal one."""
    kind, *parts = expression
    if kind == "case":
        return str(parts[0])
    if kind.upper() in FUNCTIONS:
        return f"{kind.upper()}({','.join(format_expression(part) for part in parts)})"
    if kind == "*":
        return f"{format_factor(parts[0])}*{format_expression(parts[1], True)}"
    if kind == "neg":
        text = f"-{format_expression(parts[0], True)}"
    else:
        left = format_expression(parts[0])
        text = f"{left} {kind} {format_expression(parts[1], True)}"
    return f"({text})" if inner else text


def format_factor(value: float) -> str:
    """Shortest text that reads back to the same number: 2, 1.3."""
    return f"{value:g}" if float(f"{value:g}") == value else repr(value)


def format_terms(items: tuple[Term, ...]) -> str:
    """Write the load sets of a case: W + P1 - 0.5*T1."""
    text = ""
    for term in items:
        name = term.name
        if term.vector is not None:
            name = f"U({','.join(format_factor(x) for x in term.vector)})"
        size = abs(term.factor)
        part = name if size == 1.0 else f"{format_factor(size)}*{name}"
        sign = "-" if term.factor < 0.0 else "+"
        text += f" {sign} {part}" if text else part if sign == "+" else f"-{part}"
    return text


def format_shocks(items: tuple[Shock, ...]) -> str:
    """Write a response spectrum case: SPECTRUM(SSE,X) + SPECTRUM(SSE,Y,0.67)."""
    texts = []
    for shock in items:
        parts = [shock.spectrum, shock.direction]
        if shock.factor != 1.0 or shock.group is not None:
            parts.append(format_factor(shock.factor))
        if shock.group is not None:
            parts.append(shock.group)
        texts.append(f"SPECTRUM({','.join(parts)})")
    return " + ".join(texts)


def format_case(case: Case) -> str:
    """Write what stands after the = of a CASE, without its keys."""
    return format_shocks(case.spectrum.shocks) if case.spectrum else format_terms(case.terms)


def unknown_set(word: str, cases: set[str]) -> str:
    """Say that a name in a CASE is no load set, with the nearest one."""
    return f"{word} is no load set{nearest(word, {*LOAD_SETS, *cases})}"
