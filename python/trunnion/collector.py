"""Python's collector of reference cycles, paused where many records are made."""

import gc
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def paused() -> Iterator[None]:
    """Keep the collector from running.

    Records of a model have no cycles among them, and the collector would go over those of a
    large model again and again (a third of the time at 100 000 pipes).
    """
    collecting = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collecting:
            gc.enable()
