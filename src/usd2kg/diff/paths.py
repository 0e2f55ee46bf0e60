"""Ancestors and differing parts of prim paths."""

from collections.abc import Iterator

__all__ = ["ancestor_paths", "differing_prefixes"]


def differing_prefixes(old: str, new: str) -> tuple[str, str]:
    """Return two paths without the elements that they share at the end.

    >>> differing_prefixes("/Room/Shelf/Cup", "/Room/Board/Cup")
    ('/Room/Shelf', '/Room/Board')
    """
    before, after = old.split("/"), new.split("/")
    while len(before) > 1 and len(after) > 1 and before[-1] == after[-1]:
        before.pop()
        after.pop()
    return "/".join(before), "/".join(after)


def ancestor_paths(path: str) -> Iterator[str]:
    """Yield the paths of the ancestor prims, nearest first; the pseudo-root is the empty path.

    >>> list(ancestor_paths("/Room/Shelf"))
    ['/Room', '']
    """
    while path:
        path = path.rpartition("/")[0]
        yield path
