"""Paths of prims, as text."""

from collections.abc import Container

__all__ = ["nearest_in"]


def nearest_in(path: str | None, known: Container[str]) -> str | None:
    """Return the path, or that of its nearest ancestor, that is in a collection; None if there is none.

    >>> nearest_in("/Room/Door/handle", {"/Room", "/Room/Door"}), nearest_in("/Hall", {"/Room"})
    ('/Room/Door', None)
    """
    while path and path not in known:
        path = path.rpartition("/")[0]
    return path or None
