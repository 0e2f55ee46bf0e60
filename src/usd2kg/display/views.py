"""make_view: record → View, the displayed content of a record."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import singledispatch
from itertools import islice
from pathlib import Path

from usd2kg.assistant import InterpretedAnswer
from usd2kg.display.cells import clean_line, size_text
from usd2kg.display.pictures import Pictured
from usd2kg.graph import KnowledgeGraph
from usd2kg.grounding import Grounding
from usd2kg.ontology.model import local_name
from usd2kg.pipeline import BuildResult
from usd2kg.query import Answer
from usd2kg.scene import Box, Scene, SceneObject
from usd2kg.world import World

__all__ = ["MAX_ROWS", "View", "make_view"]

MAX_ROWS = 20
"""Maximum number of displayed table rows."""
_MAX_LINE = 400
"""Characters of a title or note."""
_OBJECT_COLUMNS = ("class", "name", "confidence", "size in m", "relations")
_RELATIONS = {"on": "on", "inside": "in", "attached-to": "attached to", "part-of": "part of"}
"""Relation → words before the name of the anchor."""


@dataclass(frozen=True)
class View:
    """The displayed content of a record."""

    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[object, ...], ...]
    """The first rows of the table, at most `MAX_ROWS`."""
    count: int
    """Number of rows of the whole table."""
    notes: tuple[str, ...] = ()
    """Lines below the title."""
    pictured: Pictured | None = None
    """The record to draw; None for no picture."""

    @property
    def lines(self) -> tuple[str, ...]:
        """The title and the notes, each on one line."""
        return tuple(clean_line(line, _MAX_LINE) for line in (self.title, *self.notes))


@singledispatch
def make_view(record: object) -> View:
    """Return the displayed content of a record.

    Raises:
        TypeError: there is no view of its class.
    """
    raise TypeError(f"there is no view of {type(record).__name__}")


@make_view.register
def _(scene: Scene) -> View:
    frame = scene.frame
    notes = [f"{scene.prim_count} prims, {frame.metres_per_unit:g} m a unit, {frame.up_axis} up"]
    if scene.diagnostics:
        notes.append(f"{len(scene.diagnostics)} diagnostics: {_counts(note.code for note in scene.diagnostics)}")
    rows = (
        (_name(obj), _box_text(obj.box), obj.mass_kg, _last(obj.parent_path), obj.prim_path) for obj in scene.objects
    )
    return View(
        f"{Path(scene.source).name}: {_number(len(scene.objects), 'object')}, {_number(len(scene.joints), 'joint')}",
        ("name", "size in m", "mass in kg", "part of", "path"),
        _first(rows),
        len(scene.objects),
        tuple(notes),
        scene,
    )


@make_view.register
def _(grounding: Grounding) -> View:
    predictions = grounding.predictions
    rows = (
        (
            p.class_iri and local_name(p.class_iri),
            _last(p.prim_path),
            _share(p.confidence),
            p.status.value,
            p.explanation,
        )
        for p in predictions
    )
    return View(
        f"{Path(grounding.scene).name}: {_number(len(predictions), 'prediction')} by {grounding.grounder}",
        ("class", "name", "confidence", "status", "explanation"),
        _first(rows),
        len(predictions),
        (_counts(p.status.value for p in predictions),),
        grounding,
    )


@make_view.register
def _(graph: KnowledgeGraph) -> View:
    counts = sorted(graph.classes.items(), key=lambda item: (-item[1], item[0]))
    notes = [f"relations: {_relation_counts(graph)}"]
    if graph.imports:
        notes.append(f"imports {', '.join(graph.imports)}")
    return View(
        f"{graph.iri}: {_number(graph.individuals, 'object')}, {_number(len(graph.triples), 'triple')}",
        ("class", "objects", "IRI"),
        _first((local_name(iri), count, iri) for iri, count in counts),
        len(counts),
        tuple(notes),
        graph,
    )


@make_view.register
def _(result: BuildResult) -> View:
    objects, names = result.scene.objects, {obj.prim_path: _name(obj) for obj in result.scene.objects}
    shown = objects[:MAX_ROWS]
    related = _related(result.graph, {obj.prim_path for obj in shown}, names)
    return View(
        _title(result),
        _OBJECT_COLUMNS,
        tuple(_object_row(result, obj, related.get(obj.prim_path, ())) for obj in shown),
        len(objects),
        (f"relations: {_relation_counts(result.graph)}",),
        result.scene,
    )


@make_view.register
def _(world: World) -> View:
    name = Path(world.source).name or world.source
    title = f"{name}: {_number(len(world.store.facts.things), 'object')}, {_number(len(world.store), 'triple')}"
    return View(
        title if world.built is None else _title(world.built),
        _OBJECT_COLUMNS,
        tuple(
            (
                row.class_label,
                row.name,
                _share(row.confidence),
                size_text((row.size_x, row.size_y, row.size_z)),
                row.relations,
            )
            for row in world.first_objects(MAX_ROWS)
        ),
        len(world.store.facts.things),
        () if world.built is None else (f"relations: {_relation_counts(world.built.graph)}",),
        world.store if world.scene is None else world.scene,
    )


@make_view.register
def _(answer: Answer) -> View:
    return View(_number(len(answer.rows), "row"), answer.columns, _first(answer.values), len(answer.rows))


@make_view.register
def _(answer: InterpretedAnswer) -> View:
    table = answer.answer
    return View(
        answer.sentence or _number(len(table.rows), "row"),
        table.columns if table.rows else (),
        _first(table.values),
        len(table.rows),
        (f"understood as: {answer.understood}",),
    )


def _title(result: BuildResult) -> str:
    graph = result.graph
    return (
        f"{Path(result.scene.source).name}: {_number(graph.individuals, 'object')} of "
        f"{_number(len(graph.classes), 'class')}, {_number(len(graph.triples), 'triple')}"
    )


def _object_row(result: BuildResult, obj: SceneObject, related: Sequence[str]) -> tuple[object, ...]:
    prediction = result.grounding.by_path.get(obj.prim_path)
    label = result.tbox.by_iri[prediction.class_iri].label if prediction and prediction.class_iri else None
    confidence = prediction.confidence if prediction is not None else None
    return label, _name(obj), _share(confidence), _box_text(obj.box), ", ".join(related)


def _related(graph: KnowledgeGraph, targets: set[str], names: Mapping[str, str]) -> dict[str, list[str]]:
    """Return prim path → text of the relations `on`, `in`, `attached to` and `part of` of the object."""
    found: dict[str, list[str]] = {}
    for relation in graph.relations:
        if relation.target in targets and relation.kind in _RELATIONS:
            anchor = names.get(relation.anchor) or _last(relation.anchor)
            found.setdefault(relation.target, []).append(f"{_RELATIONS[relation.kind]} {anchor}")
    return found


def _first(rows: Iterable[tuple[object, ...]]) -> tuple[tuple[object, ...], ...]:
    return tuple(islice(rows, MAX_ROWS))


def _relation_counts(graph: KnowledgeGraph) -> str:
    return _counts(relation.kind for relation in graph.relations) or "none"


def _counts(kinds: Iterable[str]) -> str:
    return ", ".join(f"{count} {kind}" for kind, count in Counter(kinds).most_common())


def _number(count: int, noun: str) -> str:
    return f"{count} {noun}{'' if count == 1 else 'es' if noun.endswith('s') else 's'}"


def _name(obj: SceneObject) -> str:
    return obj.display_name or obj.name


def _last(path: str | None) -> str:
    return "" if path is None else path.rpartition("/")[2]


def _box_text(box: Box | None) -> str:
    return size_text(None if box is None else box.size)


def _share(confidence: float | None) -> str | None:
    return None if confidence is None else f"{confidence:.2f}"
