"""Names of the picture files: any case name becomes one that every file system takes."""

from hashlib import sha256

KEPT = frozenset("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+")
LONGEST = 80  # characters of one part


def safe(name: str) -> str:
    """Write a name with no characters but letters, digits, _ - +; others as %2F.

    Different names stay different.  Dots are written so, too: LINE with a case A.B and LINE.A
    with a case B have pictures of their own in the same folder.
    """
    text = "".join(c if c in KEPT else _encoded(c) for c in name)
    if len(text) <= LONGEST:
        return text
    mark = sha256(name.encode("utf-8", "surrogatepass")).hexdigest()[:12]
    return f"{text[: LONGEST - 13]}~{mark}"


def _encoded(character: str) -> str:
    return "".join(f"%{byte:02X}" for byte in character.encode("utf-8", "surrogatepass"))
