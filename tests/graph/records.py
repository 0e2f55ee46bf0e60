"""Scenes of boxes with given classes, to test graphs without stage and grounder."""

import io
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Any

import pyoxigraph as ox

from tests.grounding.records import make_object, make_scene
from usd2kg.graph import RDF_FORMATS, KnowledgeGraph, instantiate, serialize_graph
from usd2kg.graph.vocabulary import PREFIXES
from usd2kg.grounding import Candidate, Grounding, Prediction, Status
from usd2kg.ontology import TBox
from usd2kg.query import Dataset, GraphStore
from usd2kg.scene import Box, Scene, SceneObject

BASE = "https://my.lab/k/"

Corner = tuple[float, float, float]


def box_at(lower: Corner, size: Corner) -> Box:
    """Return a box by its lower corner and its size, in metres."""
    x, y, z = (low + side for low, side in zip(lower, size, strict=True))
    return Box(lower, (x, y, z))


def thing(path: str, lower: Corner, size: Corner, **known: Any) -> SceneObject:
    """Return an object with a box and no nested objects."""
    box = box_at(lower, size)
    return make_object(path, **{"box": box, "own_box": box, **known})


def ground_as(tbox: TBox, scene: Scene, classes: dict[str, str], **changes: Any) -> Grounding:
    """Return a grounding from path → local name of the class; other objects have none."""
    return Grounding(
        scene=scene.source,
        scene_hash=scene.content_hash,
        ontology=tbox.ontology_iri,
        ontology_hash=tbox.content_hash,
        grounder="by-hand",
        settings={"regime": "semantic"},
        is_calibrated=False,
        tool_version="0.1.0",
        predictions=tuple(predict(tbox, obj.prim_path, classes.get(obj.prim_path)) for obj in scene.objects),
        **changes,
    )


def predict(tbox: TBox, path: str, name: str | None) -> Prediction:
    if name is None:
        return Prediction(path, None, None, Status.REFUSED, "by-hand", "not labelled")
    iri = tbox.resolve(name)
    return Prediction(
        path, iri, 0.75, Status.GROUNDED, "by-hand", f"it is a {name}", ("name",), (Candidate(iri, 0.75),)
    )


def build_graph(tbox: TBox, placed: Iterable[tuple[SceneObject, str | None]], **options: Any) -> KnowledgeGraph:
    """Return the graph of (object, local name of its class) pairs, and of the scene's `joints`."""
    pairs = list(placed)
    scene = make_scene(*(obj for obj, _ in pairs), source="scenes/room one.usda")
    scene = replace(scene, joints=tuple(options.pop("joints", ())))
    classes = {obj.prim_path: name for obj, name in pairs if name is not None}
    options.setdefault("base", BASE)
    return instantiate(scene, tbox, ground_as(tbox, scene, classes), **options)


def reread(graph: KnowledgeGraph, ending: str = ".ttl") -> ox.Store:
    """Return the serialised graph as a store."""
    rdf_format = RDF_FORMATS[ending]
    store = ox.Store()
    store.load(io.BytesIO(serialize_graph(graph, rdf_format)), format=rdf_format)
    return store


def open_store(graph: KnowledgeGraph) -> GraphStore:
    return GraphStore(Dataset(reread(graph)), "room.ttl")


def select(store: ox.Store, query: str) -> list[tuple[str | None, ...]]:
    """Return the rows of a SELECT query as text, sorted."""
    found = store.query(query, prefixes={**PREFIXES, "k": BASE})
    rows = [tuple(None if term is None else term.value for term in row) for row in found]
    return sorted(rows, key=str)


def said_of(store: ox.Store, statement: str) -> dict[str, str | None]:
    """Return the annotations of a statement by property; the last of several values."""
    subject, predicate, value = statement.split(maxsplit=2)
    rows = select(
        store,
        f"SELECT ?p ?v {{ ?x a owl:Axiom ; owl:annotatedSource {subject} ; owl:annotatedProperty {predicate} ;"
        f" owl:annotatedTarget {value} ; ?p ?v . FILTER(!STRSTARTS(STR(?p), STR(owl:)) && ?p != rdf:type) }}",
    )
    return {str(name): text for name, text in rows}


def ask(store: ox.Store, query: str) -> bool:
    return bool(store.query(f"ASK {{ {query} }}", prefixes={**PREFIXES, "k": BASE}))


def related(relations: Sequence[Any]) -> set[tuple[str, str, str]]:
    """Return relations as (name of the target, kind, name of the anchor)."""
    return {(r.target.rpartition("/")[2], r.kind, r.anchor.rpartition("/")[2]) for r in relations}
