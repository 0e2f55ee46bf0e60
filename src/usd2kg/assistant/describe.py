"""Descriptions and lists of the objects of a graph."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pyoxigraph as ox
from numpy.typing import NDArray

from usd2kg.assistant.settings import RESULTS
from usd2kg.query import Answer, GraphStore
from usd2kg.query.body_table import Body
from usd2kg.query.dataset import term_list

__all__ = ["describe_objects", "description_answer", "list_objects"]

# The engine evaluates a group below OPTIONAL before what is around it. {found} limits each to the objects asked about.
_CLASSES = """
SELECT DISTINCT ?object ?path ?class ?iri ?confidence ?why WHERE {{
  {found}
  VALUES ?kind {{ usd:Prim u2k:Object }}
  ?o a ?kind ; u2k:primPath ?path ; rdfs:label ?object .
  OPTIONAL {{
    {found}
    ?o a ?iri . ?iri rdfs:label ?class .
    FILTER(?iri NOT IN (u2k:Object, usd:Prim))
    OPTIONAL {{
      {found}
      ?x owl:annotatedSource ?o ; owl:annotatedProperty rdf:type ; owl:annotatedTarget ?iri .
      ?x sssom:confidence ?confidence .
      OPTIONAL {{ ?x u2k:explanation ?why }}
    }}
  }}
}} ORDER BY ?path"""

_WORDS = """
SELECT DISTINCT ?path ?material ?asset ?room WHERE {{
  {found}
  ?o u2k:primPath ?path .
  OPTIONAL {{ {found} ?o u2k:material ?material }}
  OPTIONAL {{ {found} ?o u2k:asset ?asset }}
  OPTIONAL {{ {found} ?o u2k:inRoom/rdfs:label ?room }}
}}"""

_DECIMALS = 6
"""Of metres, as in the graph."""
_Row = Mapping[str, Any]


def list_objects(
    graph: GraphStore, class_name: str | None = None, *, limit: int = RESULTS.max_listed, start: int = 0
) -> dict[str, Any]:
    """Return one page of the objects with class and confidence, ordered by prim path.

    An object with several classes has several rows; `count` is the number of rows on all pages.

    Args:
        graph: the graph.
        class_name: only objects of this class or a subclass.
        limit: maximum number of rows on the page.
        start: index of the first row.

    Raises:
        GraphError: the class is unknown.
    """
    answer = graph.sparql(_CLASSES.format(found="")) if class_name is None else graph.all_of(class_name)
    kept = [i for i, column in enumerate(answer.columns) if column in {"object", "class", "path", "confidence"}]
    rows = [{answer.columns[i]: row[i] for i in kept} for row in answer.values]
    return {"count": len(rows), "start": start, "objects": rows[start : start + limit]}


def describe_objects(graph: GraphStore, thing: str, *, limit: int = RESULTS.max_described) -> dict[str, Any]:
    """Return everything that a graph states about the objects that match a name.

    Lengths are metres and masses kilograms, in the z-up world frame.

    Args:
        graph: the graph.
        thing: prim path, label, class or words, see `GraphStore.find`.
        limit: maximum number of objects that are described; `count` includes the others.

    Raises:
        GraphError: no object matches.
    """
    facts = graph.facts
    iris = facts.sorted(node.value for node in graph.find(thing))
    shown = f"VALUES ?o {{ {term_list(map(ox.NamedNode, iris[:limit]))} }}"
    classes, words = (_rows_by_path(graph.sparql(query.format(found=shown))) for query in (_CLASSES, _WORDS))
    described = []
    for iri in iris[:limit]:
        path, body = facts.path(iri), facts.body(iri)
        rows = words.get(path, [])
        described.append(
            {
                "object": facts.label(iri),
                "path": path,
                "iri": iri,
                "classes": [
                    {key: row[key] for key in ("class", "iri", "confidence", "why")}
                    for row in classes.get(path, [])
                    if row["iri"]
                ],
                **_box(body),
                "mass_kg": body.mass,
                "room": next((row["room"] for row in rows if row["room"]), None),
                "materials": sorted({row["material"] for row in rows if row["material"]}),
                "assets": sorted({row["asset"] for row in rows if row["asset"]}),
                **_related_objects(graph, path),
            }
        )
    return {"count": len(iris), "objects": described}


def _box(body: Body) -> dict[str, tuple[float, ...] | None]:
    """Return the centre and the sides of a box, in metres; None for an object without one."""
    if body.lower is None or body.upper is None:
        return {"center_m": None, "size_m": None}
    center, size = (body.lower + body.upper) / 2, body.upper - body.lower
    return {"center_m": _rounded(center), "size_m": _rounded(size)}


def _rounded(vector: NDArray[np.float64]) -> tuple[float, ...]:
    return tuple(round(float(value), _DECIMALS) for value in vector)


def _related_objects(graph: GraphStore, path: str) -> dict[str, Any]:
    """Return relation name → labels of the supporters, containers, contents, neighbours and parts of an object."""
    location = graph.where_is(path).as_dicts()
    related: dict[str, Any] = {
        "stands_on": sorted({row["on"] for row in location if row.get("on")}),
        "lies_in": sorted({row["inside"] for row in location if row.get("inside")}),
    }
    queries = {"on_it": graph.on, "in_it": graph.inside, "near_it": graph.near, "parts": graph.parts_of}
    for name, query in queries.items():
        related[name] = list(dict.fromkeys(row["object"] for row in query(path).as_dicts()))
    return related


def _rows_by_path(answer: Answer) -> Mapping[str, list[_Row]]:
    found: dict[str, list[_Row]] = {}
    for row in answer.as_dicts():
        found.setdefault(str(row["path"]), []).append(row)
    return found


def description_answer(graph: GraphStore, thing: str) -> Answer:
    """Return the description of the objects that match a name as a table of facts.

    Raises:
        GraphError: no object matches.
    """
    facts: list[tuple[str, str, str]] = []
    for obj in describe_objects(graph, thing)["objects"]:
        for cls in obj["classes"]:
            facts.append((obj["object"], "class", cls["class"]))
            facts += [(obj["object"], key, _text(cls[key])) for key in ("confidence", "why") if cls[key] is not None]
        facts += [
            (obj["object"], name, _text(value))
            for name, value in obj.items()
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
