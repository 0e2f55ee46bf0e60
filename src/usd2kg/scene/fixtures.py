"""Fixtures: what is built into a body and yet has a name of its own, a tap in a sink's cabinet."""

from usd2kg.scene.outline import PrimRecord
from usd2kg.words import words_of

__all__ = ["find_fixtures"]

_FIXTURE_WORDS = frozenset(
    """
    basin burner cooktop countertop counter faucet hob hotplate sink stovetop tap washbasin worktop
    """.split()
)
"""Distinct fixtures, which people name apart from the body that they are built into."""


def find_fixtures(body: PrimRecord, candidates: dict[str, str]) -> dict[str, str]:
    """Return path → reason of a body's fixtures, which may be frames whose mesh is part of the body's."""
    found: dict[str, str] = {}
    pending = list(body.children)
    while pending:
        record = pending.pop()
        if record.path in candidates:
            continue
        if not record.is_hidden and _is_fixture(record) and _last_word(record.name) not in words_of(body.name):
            found[record.path] = f"fixture of {body.name}"
        else:
            pending.extend(record.children)
    return found


def _is_fixture(record: PrimRecord) -> bool:
    is_whole = record.is_gprim or record.gprim_count > 0 or (record.type_name == "Xform" and not record.children)
    return is_whole and _last_word(record.name) in _FIXTURE_WORDS


def _last_word(name: str) -> str:
    return next(reversed(words_of(name)), "")
