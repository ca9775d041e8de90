"""One thread for dense algebra: with more, BLAS adds in another order and last digits change."""

from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def one_thread() -> Iterator[None]:
    """Hold every BLAS that is loaded by now to one thread, whatever the environment says.

    A library that is imported later brings its own, so import it before.
    """
    from threadpoolctl import threadpool_limits

    with threadpool_limits(1, user_api="blas"):
        yield
