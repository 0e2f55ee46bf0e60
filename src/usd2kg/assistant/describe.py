"""What a graph holds of one thing, together; and lists of things."""

from collections.abc import Mapping, Sequence
from typing import Any

from usd2kg.query import Answer, GraphStore
from usd2kg.validation import read_graph_objects

__all__ = ["describe", "description_answer", "list_objects"]

_CLASSES = """
SELECT DISTINCT ?object ?path ?class ?iri ?confidence ?why WHERE {
  VALUES ?kind { usd:Prim u2k:Object }
  ?o a ?kind ; u2k:primPath ?path ; rdfs:label ?object .
  OPTIONAL {
    ?o a ?iri . ?iri rdfs:label ?class .
    FILTER(?iri NOT IN (u2k:Object, usd:Prim))
    OPTIONAL {
      ?x owl:annotatedSource ?o ; owl:annotatedProperty rdf:type ; owl:annotatedTarget ?iri .
      ?x sssom:confidence ?confidence .
      OPTIONAL { ?x u2k:explanation ?why }
    }
  }
} ORDER BY ?path"""

_WORDS = """
SELECT DISTINCT ?path ?material ?asset ?room WHERE {
  ?o u2k:primPath ?path .
  OPTIONAL { ?o u2k:material ?material }
  OPTIONAL { ?o u2k:asset ?asset }
  OPTIONAL { ?o u2k:inRoom/rdfs:label ?room }
}"""

_RELATIONS = ("on", "inside", "near", "parts_of")


def list_objects(
    graph: GraphStore, class_name: str | None = None, *, most: int = 100, start: int = 0
) -> dict[str, Any]:
    """Return objects with class and confidence by prim path, a page at a time.

    Args:
        graph: the graph.
        class_name: only things of this class, subclasses included.
        most: rows of the page.
        start: rows that are passed over.

    Raises:
        GraphError: no class is called so.
    """
    answer = graph.sparql(_CLASSES) if class_name is None else graph.all_of(class_name)
    kept = [i for i, column in enumerate(answer.columns) if column in {"object", "class", "path", "confidence"}]
    rows = [{answer.columns[i]: row[i] for i in kept} for row in answer.values]
    return {"count": len(rows), "start": start, "objects": rows[start : start + most]}


def describe(graph: GraphStore, thing: str, *, most: int = 10) -> dict[str, Any]:
    """Return all that a graph holds of the things that are called so, for a person or an assistant to read.

    Lengths are metres and masses kilograms, in the z-up world frame.

    Args:
        graph: the graph.
        thing: a prim path, label, class, or words of a label.
        most: things that are described; the others are counted.

    Raises:
        GraphError: nothing is called so.
    """
    wanted = {node.value for node in graph.find(thing)}
    objects = [obj for obj in read_graph_objects(graph.store) if obj.iri in wanted]
    classes = _by_path(graph.sparql(_CLASSES))
    words = _by_path(graph.sparql(_WORDS))
    found = []
    for obj in objects[:most]:
        told = classes.get(obj.prim_path, [])
        said = words.get(obj.prim_path, [])
        found.append(
            {
                "object": obj.label,
                "path": obj.prim_path,
                "iri": obj.iri,
                "classes": [
                    {key: row[key] for key in ("class", "iri", "confidence", "why")} for row in told if row["iri"]
                ],
                "center_m": obj.center,
                "size_m": obj.size,
                "mass_kg": obj.mass_kg,
                "room": next((row["room"] for row in said if row["room"]), None),
                "materials": sorted({row["material"] for row in said if row["material"]}),
                "assets": sorted({row["asset"] for row in said if row["asset"]}),
                **_related(graph, obj.prim_path),
            }
        )
    return {"count": len(objects), "objects": found}


def _class(row: Mapping[str, Any]) -> dict[str, Any]:
    return {key: row[key] for key in ("class", "iri", "confidence", "why")}


def _related(graph: GraphStore, path: str) -> dict[str, Any]:
    """Return what stands on a thing, is in it, near it and part of it, and what it is on and in."""
    place = graph.where_is(path)
    rows = [dict(zip(place.columns, row, strict=True)) for row in place.values]
    told: dict[str, Any] = {
        "stands_on": sorted({row["on"] for row in rows if row.get("on")}),
        "lies_in": sorted({row["inside"] for row in rows if row.get("inside")}),
    }
    names = {"on": "on_it", "inside": "in_it", "near": "near_it", "parts_of": "parts"}
    for method in _RELATIONS:
        answer = getattr(graph, method)(path)
        column = answer.columns.index("object")
        told[names[method]] = list(dict.fromkeys(row[column] for row in answer.rows))
    return told


def _by_path(answer: Answer) -> Mapping[str, list[dict[str, Any]]]:
    found: dict[str, list[dict[str, Any]]] = {}
    for row in answer.values:
        told = dict(zip(answer.columns, row, strict=True))
        found.setdefault(str(told["path"]), []).append(told)
    return found


def description_answer(graph: GraphStore, thing: str) -> Answer:
    """Return the description of the things that are called so as a table of facts.

    Raises:
        GraphError: nothing is called so.
    """
    facts: list[tuple[str, str, str]] = []
    for told in describe(graph, thing)["objects"]:
        for cls in told["classes"]:
            facts.append((told["object"], "class", cls["class"]))
            facts += [(told["object"], key, _text(cls[key])) for key in ("confidence", "why") if cls[key] is not None]
        facts += [
            (told["object"], name, _text(value))
            for name, value in told.items()
            if name not in {"object", "iri", "classes"} and value not in (None, [], ())
        ]
    rows = tuple(facts)
    return Answer(("object", "fact", "value"), rows, rows, "")


def _text(value: object) -> str:
    if isinstance(value, tuple):
        return " × ".join(f"{number:g}" for number in value)
    if isinstance(value, Sequence) and not isinstance(value, str):
        return ", ".join(map(str, value))
    return f"{value:g}" if isinstance(value, float) else str(value)
