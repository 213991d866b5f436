"""How far a long call about a known curve is, told to whoever asked.

It is no argument of what works, since the medial axis is kept by its arguments.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from crustline.delaunay import Progress, as_progress

_asked: ContextVar[Progress | None] = ContextVar("asked", default=None)


@contextmanager
def told_to(progress: Progress | None) -> Iterator[None]:
    """Pass on to `progress` what is told within."""
    before = _asked.set(as_progress(progress))
    try:
        yield
    finally:
        _asked.reset(before)


def tell(stage: str, fraction: float) -> None:
    """Tell a stage, and which part of it is done; an error of who hears it ends the call."""
    if (progress := _asked.get()) is not None:
        progress(stage, fraction)
