"""Pictures of records: of their stage, or of the boxes in their graph."""

import logging
from collections.abc import Hashable, Mapping
from dataclasses import dataclass
from pathlib import Path

from usd2kg.diagrams.coloring import Coloring, color_by_group
from usd2kg.graph import KnowledgeGraph
from usd2kg.grounding import Grounding
from usd2kg.query import GraphStore
from usd2kg.render import ColoredBox, draw_boxes, draw_stage_thumbnail, draw_thumbnail
from usd2kg.scene import Scene

__all__ = ["MAX_BOXES", "PICTURE_SIZE", "Picture", "Pictured", "draw_picture"]

logger = logging.getLogger(__name__)

PICTURE_SIZE = (280, 210)
"""Width and height in pixels: 40 kB of PNG for a furnished room."""
MAX_BOXES = 1_000
"""Maximum number of objects of a graph with a picture: drawing more takes seconds."""
_MAX_PREDICTIONS = 20_000
"""Maximum number of objects of a grounding whose stage is opened for a picture."""
_MAX_KEPT = 8
_pictures: dict[tuple[Hashable, ...], bytes | None] = {}
"""Cache key of a picture → PNG; None if there is no picture."""

Pictured = Scene | Grounding | KnowledgeGraph | GraphStore


@dataclass(frozen=True)
class Picture:
    """A picture with the legend of its colours."""

    png: bytes
    caption: str
    legend: tuple[tuple[str, str, int], ...] = ()
    """Colour (`#rrggbb`), label, and number of objects."""


def draw_picture(record: Pictured) -> Picture | None:
    """Return a picture of a record; None if it is too large, or cannot be drawn.

    A scene and a grounding show their stage, if it is unchanged; a graph shows the boxes of its objects, coloured by
    class. A failure is logged: a record has to be shown, whatever drawing it raises.
    """
    try:
        if isinstance(record, KnowledgeGraph):
            return _draw_graph(record)
        if isinstance(record, GraphStore):
            return _draw_boxes(record)
        png = _draw_stage(record)
        return None if png is None else Picture(png, "the scene")
    except Exception as error:  # whatever drawing raises
        logger.info("no picture: %s", error)
        return None


def _draw_stage(record: Scene | Grounding) -> bytes | None:
    """Return a picture of a stage; the last few are cached, since a notebook shows the same scene repeatedly."""
    key: tuple[Hashable, ...]
    if isinstance(record, Scene):
        key = (record.source, record.content_hash, record.frame, record.time)
    else:
        stage = (record.scene, record.scene_hash)
        # Any picture of the same stage.
        key = next((known for known in _pictures if known[:2] == stage), stage)
    if key not in _pictures:
        while len(_pictures) >= _MAX_KEPT:
            _pictures.pop(next(iter(_pictures)))
        _pictures[key] = None
        if isinstance(record, Scene):
            _pictures[key] = draw_thumbnail(record, PICTURE_SIZE)
        elif len(record.predictions) <= _MAX_PREDICTIONS:
            _pictures[key] = draw_stage_thumbnail(Path(record.scene), record.scene_hash, PICTURE_SIZE)
    return _pictures[key]


def _draw_graph(graph: KnowledgeGraph) -> Picture | None:
    if graph.individuals > MAX_BOXES:
        return None
    return _draw_boxes(GraphStore.from_triples(graph.triples, graph.iri))


def _draw_boxes(store: GraphStore) -> Picture | None:
    facts = store.facts
    if len(facts.columns.iris) > MAX_BOXES:
        return None
    placed = {iri: body for iri in facts.things if (body := facts.body(iri)).lower is not None}
    coloring = _color_by_class({iri: next(iter(facts.class_labels(iri)), None) for iri in placed})
    colors = coloring.linear_colors()
    boxes = [
        ColoredBox(body.lower, body.upper, colors[iri])
        for iri, body in placed.items()
        if body.lower is not None and body.upper is not None
    ]
    png = draw_boxes(boxes, PICTURE_SIZE)
    if png is None:
        return None
    legend = tuple((entry.color, entry.label, len(entry.prim_paths)) for entry in coloring.legend)
    return Picture(png, "the boxes of the objects", legend)


def _color_by_class(class_of: Mapping[str, str | None]) -> Coloring:
    labels = {label: label for label in sorted({label for label in class_of.values() if label})}
    return color_by_group(class_of, labels, class_of, "no class")
