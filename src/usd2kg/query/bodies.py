"""Boxes, masses and joints of a graph's objects, as numbers for the SPARQL functions."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pyoxigraph as ox
from numpy.typing import NDArray

from usd2kg.query.body_table import NO_BODY, Body, BodyTable, load_table, parse_number_term, parse_vector
from usd2kg.query.dataset import Dataset

__all__ = ["BodyIndex", "JointMotion"]

Vector = NDArray[np.float64]

_ROUNDING = 1e-4
"""Metres: distances are rounded to four decimals."""

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
  { ?o soma:isOntopOf|u2k:on|soma:isInsideOf|u2k:inside|u2k:attachedTo|u2k:partOf|^soma:hasPhysicalComponent ?carrier }
  UNION
  { ?j soma:hasParentLink|u2k:parentObject ?carrier ; soma:hasChildLink|u2k:childObject ?o }
  ?o u2k:primPath [] .
}"""


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


class BodyIndex:
    """The objects of one graph by IRI, read on first access."""

    def __init__(self, dataset: Dataset) -> None:
        self._dataset = dataset

    @cached_property
    def table(self) -> BodyTable:
        """All objects."""
        return load_table(self._dataset)

    @cached_property
    def _rows(self) -> dict[str, int]:
        return {iri: row for row, iri in enumerate(self.table.iris)}

    def find(self, iri: str) -> Body:
        """Return the body of an object; for another IRI, one without size and mass."""
        row = self._rows.get(iri)
        return NO_BODY if row is None else self.table.body(row)

    def within(self, distance: float, origin: str) -> list[str] | None:
        """Return the IRIs of the objects whose boxes are within a distance in metres of an object or a position.

        Args:
            distance: metres, to which the rounding of distances is added.
            origin: an IRI, or "x y z" in metres.

        Returns:
            None if the origin has no box.
        """
        point = parse_vector(origin)
        body = self.find(origin) if point is None else Body(point, point, None, None)
        if body.lower is None or body.upper is None:
            return None
        gaps = np.maximum(np.maximum(self.table.lower - body.upper, body.lower - self.table.upper), 0)
        # Objects without a box have NaN, which is not near anything.
        near = np.flatnonzero(np.linalg.norm(gaps, axis=1) <= distance + _ROUNDING)
        return [self.table.iris[row] for row in near.tolist()]

    @cached_property
    def joints(self) -> dict[str, JointMotion]:
        """Joint IRI → its motion, for joints with an axis and two limits."""
        found = ((row["j"].value, _motion(row)) for row in self._dataset.select(_JOINTS))
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
        for row in self._dataset.select(_CARRIED):
            carried.setdefault(row["carrier"].value, set()).add(row["o"].value)
        return carried


def _motion(row: ox.QuerySolution) -> JointMotion | None:
    axis, origin = parse_vector(row["axis"].value), parse_vector(row["origin"].value)
    lower, upper = parse_number_term(row["lower"]), parse_number_term(row["upper"])
    if axis is None or origin is None or lower is None or upper is None:
        return None
    position = parse_number_term(row["position"])
    if position is None:
        position = min(max(0.0, lower), upper)
    parent, child, whole = (row[name].value if row[name] else None for name in ("parent", "child", "whole"))
    is_revolute = row["type"].value.endswith("RevoluteJoint")
    opening = max(lower - position, upper - position, key=abs)
    return JointMotion(parent, child, whole, is_revolute, axis, origin, opening)
