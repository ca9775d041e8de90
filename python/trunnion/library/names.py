"""Names that a user may misspell: the error that knows the nearest valid ones."""

from collections.abc import Iterable


class UnknownName(KeyError):  # noqa: N818 (what happened, not a failure of the program)
    """A name that a table does not have.

    Parameters
    ----------
    what : kind of name, for the message ("material grade").
    name : the name asked for.
    known : the names the table has.
    """

    def __init__(self, what: str, name: str, known: Iterable[str]) -> None:
        from difflib import get_close_matches

        super().__init__(name)
        self.what = what
        self.name = name
        upper = {k.upper(): k for k in known}
        close = get_close_matches(name.upper(), upper, n=3, cutoff=0.5)
        self.nearest: list[str] = [upper[c] for c in close]

    def __str__(self) -> str:
        hint = f"; nearest: {', '.join(self.nearest)}" if self.nearest else ""
        return f"{self.what} {self.name} is not known{hint}"
