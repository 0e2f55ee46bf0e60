"""Prim paths: what is above one, and where two part."""

from collections.abc import Iterator

__all__ = ["above", "differing_prefixes"]


def differing_prefixes(before: str, after: str) -> tuple[str, str]:
    """Return two paths without the steps at their ends that they share.

    >>> differing_prefixes("/Room/Shelf/Cup", "/Room/Board/Cup")
    ('/Room/Shelf', '/Room/Board')
    """
    old, new = before.split("/"), after.split("/")
    while len(old) > 1 and len(new) > 1 and old[-1] == new[-1]:
        old.pop()
        new.pop()
    return "/".join(old), "/".join(new)


def above(path: str) -> Iterator[str]:
    """Yield the paths of the prims above, the nearest first; the top is the empty path.

    >>> list(above("/Room/Shelf"))
    ['/Room', '']
    """
    while path:
        path = path.rpartition("/")[0]
        yield path
