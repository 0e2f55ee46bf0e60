"""Answers about what changed since an older version of a scene, in sentences."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from usd2kg.assistant.interpreted_answer import InterpretedAnswer
from usd2kg.assistant.sentences import begin_sentence, join_few, join_words, number_text
from usd2kg.diff import Change, Changes, Link, ObjectState, compare_objects, objects_of_graph
from usd2kg.diff.versions import read_objects
from usd2kg.query import Answer, GraphStore
from usd2kg.scene import ReadOptions

__all__ = ["NEEDS_OLDER_VERSION", "answer_changes", "changes_since"]

NEEDS_OLDER_VERSION = (
    "what changed is not in one graph; compare it with an older version: usd2kg ask GRAPH 'what changed?' --since OLD, "
    "where OLD is a graph or a stage"
)
_PLACES = {"on": "on", "inside": "in", "part-of": "part of", "room": "in"}
"""Relation that says where a thing is → how it is said, the most telling first."""
_COLUMNS = ("object", "class", "path", "change", "moved_m", "before", "after")

Row = tuple[Any, ...]


def changes_since(old: Path, graph: GraphStore) -> Changes:
    """Return the changes from an older version to a graph.

    Args:
        old: a graph or a stage; a stage has no classes and relations, which are then not compared.
        graph: the newer version.

    Raises:
        Usd2kgError: the older version cannot be read, or one of them has no object.
    """
    before = read_objects(old, ReadOptions())
    return compare_objects(before, objects_of_graph(graph.dataset.triples(), graph.source))


def answer_changes(changes: Changes, kind: str = "changed", paths: frozenset[str] | None = None) -> InterpretedAnswer:
    """Return what changed, as sentences and a row for each change of an object.

    Args:
        changes: the changes.
        kind: `changed` for all, or `appeared`, `disappeared`, `moved` or `reclassified`.
        paths: prim paths of the only objects that are asked about; None for all.
    """
    sections: dict[str, Callable[[Changes], tuple[list[Row], str]]] = {
        "appeared": lambda found: _unmatched(found.added, "appeared"),
        "disappeared": lambda found: _unmatched(found.removed, "disappeared"),
        "moved": _moved,
        "resized": _resized,
        "reclassified": _reclassified,
        "renamed": _renamed,
    }
    wanted = sections if kind == "changed" else {kind: sections[kind]}
    found = [section(_about(changes, paths)) for section in wanted.values()]
    rows = tuple(row for section, _ in found for row in section)
    said = [sentence for _, sentence in found if sentence]
    text = " ".join(f"{begin_sentence(sentence)}." for sentence in said) or _nothing(changes, kind, paths)
    texts = tuple(tuple(None if cell is None else str(cell) for cell in row) for row in rows)
    return InterpretedAnswer(
        f"what {kind} since the older version", Answer(_COLUMNS, texts, rows, ""), bool(rows), sentence=text
    )


def _about(changes: Changes, paths: frozenset[str] | None) -> Changes:
    if paths is None:
        return changes
    return replace(
        changes,
        changed=tuple(change for change in changes.changed if change.match.new.prim_path in paths),
        added=tuple(state for state in changes.added if state.prim_path in paths),
        removed=(),
    )


def _nothing(changes: Changes, kind: str, paths: frozenset[str] | None) -> str:
    if paths is None:
        return f"Nothing {kind}; {changes.old_count} objects were compared with {changes.new_count}."
    return f"{join_words(sorted(path.rpartition('/')[2] for path in paths), 'or')}: not {kind}."


def _unmatched(states: Sequence[ObjectState], verb: str) -> tuple[list[Row], str]:
    rows: list[Row] = [(*_row(state), verb, None, None, None) for state in states]
    return rows, _sentence([f"{_name(state)}{_place(state.links)}" for state in states], verb)


def _moved(changes: Changes) -> tuple[list[Row], str]:
    """Things that were carried by a moving one are rows, and not named in the sentence."""
    shifted = [change for change in changes.changed if change.move or change.turned_degrees]
    rows: list[Row] = [
        (
            *_row(change.match.new),
            "moved" if change.move else "turned",
            None if change.move is None else round(change.move.distance, 4),
            None if change.move is None else _numbers(change.move.start),
            None if change.move is None else _numbers(change.move.end),
        )
        for change in shifted
    ]
    own = [change for change in shifted if change.carrier is None]
    sentence = _sentence([f"{_name(change.match.new)} {_motion(change)}" for change in own], "moved")
    carried = len(shifted) - len(own)
    with_them = f", and {carried} {'thing' if carried == 1 else 'things'} with {'it' if len(own) == 1 else 'them'}"
    return rows, f"{sentence}{with_them}" if carried and sentence else sentence


def _resized(changes: Changes) -> tuple[list[Row], str]:
    # A box that grew because something appeared below it is not a change of its own.
    own = [change for change in changes.changed if change.resized is not None and not change.holds_changes]
    sizes = [tuple(map(_numbers, change.resized or ())) for change in own]
    rows: list[Row] = [
        (*_row(change.match.new), "resized", None, *size) for change, size in zip(own, sizes, strict=True)
    ]
    return rows, _sentence([_name(change.match.new) for change in own], "changed in size")


def _reclassified(changes: Changes) -> tuple[list[Row], str]:
    own = [change for change in changes.changed if change.reclassified]
    classes = [[state.class_label or "no class" for state in (change.match.old, change.match.new)] for change in own]
    rows: list[Row] = [
        (*_row(change.match.new), "reclassified", None, *labels) for change, labels in zip(own, classes, strict=True)
    ]
    named = [f"{change.match.new.name} from {old} to {new}" for change, (old, new) in zip(own, classes, strict=True)]
    return rows, _sentence(named, "changed class")


def _renamed(changes: Changes) -> tuple[list[Row], str]:
    own = [change for change in changes.changed if change.is_renamed]
    rows: list[Row] = [
        (*_row(change.match.new), "renamed", None, change.match.old.prim_path, change.match.new.prim_path)
        for change in own
    ]
    return rows, _sentence([f"{change.match.old.name} to {change.match.new.name}" for change in own], "renamed")


def _sentence(named: Sequence[str], verb: str) -> str:
    """Return `2 moved: the cup A by 10 cm and the cup B by 20 cm`; empty if nothing is named."""
    if not named:
        return ""
    return f"{len(named)} {verb}: {join_few(named)}"


def _motion(change: Change) -> str:
    parts = [] if change.move is None else [f"by {number_text(change.move.distance, 'm')}"]
    parts += [f"turned by {change.turned_degrees:.0f}°"] if change.turned_degrees else []
    return " and ".join(parts) + _place(change.gained)


def _place(links: Iterable[Link]) -> str:
    """Return where a thing is, such as ` (on Table)`; empty if no relation says it."""
    for kind, said in _PLACES.items():
        for link in sorted(links):
            if link.kind == kind:
                return f" ({said} {link.anchor.rpartition('/')[2]})"
    return ""


def _name(state: ObjectState) -> str:
    return f"the {state.class_label} {state.name}" if state.class_label else state.name


def _row(state: ObjectState) -> Row:
    return state.name, state.class_label or None, state.prim_path


def _numbers(values: Iterable[float]) -> str:
    return " ".join(f"{value:.3f}" for value in values)
