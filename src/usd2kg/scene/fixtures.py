"""Fixtures: objects built into a rigid body, like the tap of a sink cabinet."""

from usd2kg.knowledge import word_set
from usd2kg.scene.outline import PrimRecord
from usd2kg.words import words_of

__all__ = ["find_fixtures"]

_FIXTURES = word_set("scene", "fixtures")


def find_fixtures(body: PrimRecord, candidates: dict[str, str]) -> dict[str, str]:
    """Return path → reason of the fixtures of a rigid body, including empty frames whose mesh is part of the body's."""
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
    return is_whole and _last_word(record.name) in _FIXTURES


def _last_word(name: str) -> str:
    return next(reversed(words_of(name)), "")
