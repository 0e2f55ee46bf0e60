"""Boxes, masses and joints of a graph's objects, as numbers for the SPARQL functions."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pyoxigraph as ox
from numpy.typing import NDArray

from usd2kg.graph.vocabulary import PREFIXES

__all__ = ["Body", "BodyIndex", "JointMotion", "parse_vector"]

Vector = NDArray[np.float64]

_BODIES = """
SELECT ?o ?center ?width ?depth ?height ?oriented ?mass WHERE {
  ?o u2k:primPath [] .
  OPTIONAL {
    ?o (soma:hasShape/dul:hasRegion)?/u2k:boxCenter ?center ;
       (soma:hasShape/dul:hasRegion/soma:hasDepth)|u2k:width ?width ;
       (soma:hasShape/dul:hasRegion/soma:hasWidth)|u2k:depth ?depth ;
       (soma:hasShape/dul:hasRegion/soma:hasHeight)|u2k:height ?height .
  }
  OPTIONAL { ?o u2k:orientedSize ?oriented }
  OPTIONAL { ?o (soma:hasMassAttribute/soma:hasMassValue)|u2k:mass ?mass }
} ORDER BY ?o"""

_JOINTS = """
SELECT ?j ?parent ?child ?whole ?type ?axis ?origin ?lower ?upper ?position WHERE {
  ?j u2k:definingPrim [] ; u2k:jointAxis ?axis ; u2k:jointOrigin ?origin .
  ?j a ?type . FILTER(?type IN (soma:RevoluteJoint, u2k:RevoluteJoint, soma:PrismaticJoint, u2k:PrismaticJoint))
  ?j (soma:hasJointLimit/soma:hasJointPositionMin)|u2k:lowerLimit ?lower ;
     (soma:hasJointLimit/soma:hasJointPositionMax)|u2k:upperLimit ?upper .
  OPTIONAL { ?j soma:hasParentLink|u2k:parentObject ?parent }
  OPTIONAL { ?j soma:hasChildLink|u2k:childObject ?child }
  OPTIONAL { ?whole soma:hasPhysicalComponent|u2k:hasJoint ?j }
  OPTIONAL { ?j (soma:hasJointState/soma:hasJointPosition)|u2k:jointPosition ?position }
} ORDER BY ?j"""

_CARRIED = """
SELECT DISTINCT ?carrier ?o WHERE {
  { ?o soma:isOntopOf|u2k:on|soma:isInsideOf|u2k:inside|u2k:partOf|^soma:hasPhysicalComponent ?carrier }
  UNION
  { ?j soma:hasParentLink|u2k:parentObject ?carrier ; soma:hasChildLink|u2k:childObject ?o }
  ?o u2k:primPath [] .
}"""


@dataclass(frozen=True)
class Body:
    """Size and mass of one object, as far as the graph states them."""

    lower: Vector | None
    """(3,) metres, world frame: lower corner of the AABB; None without a box."""
    upper: Vector | None
    extents: tuple[float, float, float] | None
    """Metres, ascending; along the object's own axes if known."""
    mass: float | None
    """Kilograms; None if unknown."""


@dataclass(frozen=True)
class JointMotion:
    """A joint with two limits."""

    parent: str | None
    """IRI of the object that it is fixed to; None for the world."""
    child: str | None
    """IRI of the object that it moves; None if it moves a part of `whole`."""
    whole: str | None
    """IRI of the object that contains both bodies; None if the joint connects two objects."""
    is_revolute: bool
    """False for a prismatic joint."""
    axis: Vector
    """(3,) unit vector, world frame."""
    origin: Vector
    """(3,) metres, world frame."""
    opening: float
    """From the current position to the farther limit, signed; radians or metres."""


def parse_vector(text: str) -> Vector | None:
    """Return the vector written as "x y z"; None if the text is not three finite numbers.

    >>> parse_vector("1 2.5 0")
    array([1. , 2.5, 0. ])
    >>> parse_vector("1 two 3") is None
    True
    """
    try:
        values = np.array([float(part) for part in text.split()])
    except ValueError:
        return None
    return values if values.shape == (3,) and bool(np.isfinite(values).all()) else None


class BodyIndex:
    """The objects of one graph by IRI, read on first access."""

    def __init__(self, store: ox.Store) -> None:
        self._store = store

    @cached_property
    def by_iri(self) -> dict[str, Body]:
        """Object IRI → its body."""
        return {row["o"].value: _body(row) for row in self._select(_BODIES)}

    @cached_property
    def joints(self) -> dict[str, JointMotion]:
        """Joint IRI → its motion, for joints with an axis and two limits."""
        found = ((row["j"].value, _motion(row)) for row in self._select(_JOINTS))
        return {iri: motion for iri, motion in found if motion is not None}

    def carried_by(self, iri: str) -> set[str]:
        """Return the IRIs of the objects that move with an object: on it, in it, part of it or jointed to it."""
        found: set[str] = set()
        waiting = [iri]
        while waiting:
            new = self._carried.get(waiting.pop(), set()) - found
            found |= new
            waiting.extend(new)
        return found - {iri}

    @cached_property
    def _carried(self) -> dict[str, set[str]]:
        carried: dict[str, set[str]] = {}
        for row in self._select(_CARRIED):
            carried.setdefault(row["carrier"].value, set()).add(row["o"].value)
        return carried

    def _select(self, query: str) -> list[ox.QuerySolution]:
        found = self._store.query(query, prefixes=PREFIXES, use_default_graph_as_union=True)
        assert isinstance(found, ox.QuerySolutions)
        return list(found)


def _body(row: ox.QuerySolution) -> Body:
    center = parse_vector(row["center"].value) if row["center"] else None
    mass = _number(row["mass"])
    if center is None:
        return Body(None, None, None, mass)
    half = np.array([_number(row[name]) or 0.0 for name in ("width", "depth", "height")]) / 2
    oriented = parse_vector(row["oriented"].value) if row["oriented"] else None
    shortest, middle, longest = sorted(float(side) for side in (2 * half if oriented is None else oriented))
    return Body(center - half, center + half, (shortest, middle, longest), mass)


def _motion(row: ox.QuerySolution) -> JointMotion | None:
    axis, origin = parse_vector(row["axis"].value), parse_vector(row["origin"].value)
    lower, upper = _number(row["lower"]), _number(row["upper"])
    if axis is None or origin is None or lower is None or upper is None:
        return None
    position = _number(row["position"])
    if position is None:
        position = min(max(0.0, lower), upper)
    parent, child, whole = (row[name].value if row[name] else None for name in ("parent", "child", "whole"))
    is_revolute = row["type"].value.endswith("RevoluteJoint")
    opening = max(lower - position, upper - position, key=abs)
    return JointMotion(parent, child, whole, is_revolute, axis, origin, opening)


def _number(term: ox.NamedNode | ox.BlankNode | ox.Literal | ox.Triple | None) -> float | None:
    if not isinstance(term, ox.Literal):
        return None
    try:
        value = float(term.value)
    except ValueError:
        return None
    return value if np.isfinite(value) else None
