"""Numbers of things in words."""


def counted(n: int, what: str) -> str:
    """Say "1 node", "2 nodes"; what ends in a word whose plural has an s."""
    return f"{n} {what}{'s' * (n != 1)}"
