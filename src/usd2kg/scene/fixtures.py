"""Fixtures: what is built into a body and yet has a name of its own, a tap in a sink's cabinet."""

from usd2kg.scene.outline import Node
from usd2kg.words import words_of

__all__ = ["find_fixtures"]

_FIXTURE_WORDS = frozenset(
    """
    basin burner cooktop countertop counter faucet hob hotplate sink stovetop tap washbasin worktop
    """.split()
)
"""Distinct fixtures, which people name apart from the body that they are built into."""


def find_fixtures(body: Node, candidates: dict[str, str]) -> dict[str, str]:
    """Return path → reason of a body's fixtures, which may be frames whose mesh is part of the body's."""
    found: dict[str, str] = {}
    pending = list(body.children)
    while pending:
        node = pending.pop()
        if node.path in candidates:
            continue
        if not node.is_hidden and _is_fixture(node) and _last_word(node.name) not in words_of(body.name):
            found[node.path] = f"fixture of {body.name}"
        else:
            pending.extend(node.children)
    return found


def _is_fixture(node: Node) -> bool:
    is_whole = node.is_gprim or node.gprim_count > 0 or (node.type_name == "Xform" and not node.children)
    return is_whole and _last_word(node.name) in _FIXTURE_WORDS


def _last_word(name: str) -> str:
    return next(reversed(words_of(name)), "")
