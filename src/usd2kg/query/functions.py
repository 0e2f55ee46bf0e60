"""SPARQL functions for distances, extents, joint motions and routes, which SPARQL cannot compute from text.

Objects are measured by their boxes, large hollow ones by those of their walls. A function is unbound for an object
without a box and for wrong arguments.
"""

from collections.abc import Callable

import numpy as np
import pyoxigraph as ox

from usd2kg.query.bodies import BodyIndex
from usd2kg.query.body_table import Body, parse_vector
from usd2kg.query.dataset import FUNCTION_NAMESPACE, Dataset
from usd2kg.query.routes import RouteFinder, Step
from usd2kg.query.settings import SWEEP
from usd2kg.query.sweep import find_obstacles

__all__ = ["FUNCTIONS", "make_functions"]

Term = ox.NamedNode | ox.BlankNode | ox.Literal | ox.Triple
Function = Callable[..., Term | None]

FUNCTIONS = {
    "gap": "(object, object): metres between the boxes of two objects; 0 if they meet",
    "clearance": "(object, object): metres from the top of the second up to the bottom of the first, if one is over the"
    " other; negative if the first begins below that top",
    "distanceTo": '(object, "x y z"): metres from a position to the box of an object; 0 inside',
    "extent": "(object, 1, 2 or 3): shortest, middle or longest extent, metres, along the object's own axes if known",
    "sizeDifference": "(object, object): largest difference of their extents, as a share of the larger",
    "mass": "(object): kilograms",
    "opensInto": "(joint, object): how far the joint opens until its moving part hits the object, radians or metres",
    "routeStep": "(door, start, end): number of a door on the shortest route between two rooms, or objects in rooms",
    "routeRoom": "(door, start, end): the room that the door leads into on that route",
    "routeLength": "(door, start, end): metres from the first door of that route, straight from door to door",
    "tilts": "(joint): whether the joint tilts what lies on its moving part, because it turns about a level axis",
}
"""Function → its arguments and result."""
_DECIMALS = 4
"""Decimals of all results; 0.1 mm is finer than any scene is modelled."""


def make_functions(dataset: Dataset, bodies: BodyIndex) -> dict[ox.NamedNode, Function]:
    """Return the functions over the objects of a graph, which are read at the first call."""
    measure, routes = _Measure(bodies), RouteFinder(dataset, bodies)

    def step(door: Term, start: Term, end: Term) -> Step | None:
        return routes.find(_text(start), _text(end)).get(_text(door))

    functions: dict[str, Function] = {
        "gap": lambda a, b: measure.compare(a, b, _gap),
        "clearance": lambda a, b: measure.compare(a, b, _clearance),
        "distanceTo": measure.distance_to,
        "extent": measure.extent,
        "sizeDifference": lambda a, b: measure.compare(a, b, _size_difference),
        "mass": lambda a: _literal(measure.body(a).mass),
        "opensInto": measure.opens_into,
        "routeStep": lambda *terms: ox.Literal(found.number) if (found := step(*terms)) else None,
        "routeRoom": lambda *terms: ox.NamedNode(found.room) if (found := step(*terms)) else None,
        "routeLength": lambda *terms: _literal(found.length) if (found := step(*terms)) else None,
        "tilts": measure.tilts,
    }
    return {ox.NamedNode(FUNCTION_NAMESPACE + name): function for name, function in functions.items()}


class _Measure:
    """The functions, with the collisions of each joint computed once."""

    def __init__(self, bodies: BodyIndex) -> None:
        self._bodies = bodies
        self._obstacles: dict[str, dict[str, float]] = {}

    def body(self, term: Term) -> Body:
        return self._bodies.find(_text(term))

    def compare(self, a: Term, b: Term, measure: Callable[[Body, Body], float | None]) -> Term | None:
        return _literal(measure(self.body(a), self.body(b)))

    def distance_to(self, term: Term, position: Term) -> Term | None:
        point = parse_vector(_text(position))
        return None if point is None else _literal(_gap(Body(point, point, None, None), self.body(term)))

    def extent(self, term: Term, rank: Term) -> Term | None:
        extents = self.body(term).extents
        return _literal(extents[int(_text(rank)) - 1]) if extents and _text(rank) in {"1", "2", "3"} else None

    def opens_into(self, joint: Term, term: Term) -> Term | None:
        iri = _text(joint)
        if iri not in self._obstacles:
            motion = self._bodies.joints.get(iri)
            self._obstacles[iri] = find_obstacles(self._bodies, motion) if motion else {}
        collision = self._obstacles[iri].get(_text(term))
        return None if collision is None else _literal(abs(collision))

    def tilts(self, joint: Term) -> Term | None:
        motion = self._bodies.joints.get(_text(joint))
        if motion is None:
            return None
        return ox.Literal(bool(motion.is_revolute and abs(motion.axis[2]) < SWEEP.max_level_slope))


def _text(term: Term) -> str:
    return "" if isinstance(term, ox.Triple) else term.value


def _literal(value: float | None) -> ox.Literal | None:
    # Adding 0.0 turns -0.0 into 0.0.
    return None if value is None else ox.Literal(round(float(value), _DECIMALS) + 0.0)


def _gap(a: Body, b: Body) -> float | None:
    """Return the distance between two objects in metres, 0 if they meet; None if one has no box.

    Objects are boxes, hollow ones several.
    """
    if a.lower is None or a.upper is None or b.lower is None or b.upper is None:
        return None
    one = np.array(a.shell or (np.concatenate([a.lower, a.upper]),))[:, None]
    other = np.array(b.shell or (np.concatenate([b.lower, b.upper]),))[None]
    apart = np.maximum(one[..., :3] - other[..., 3:], other[..., :3] - one[..., 3:])
    return float(np.linalg.norm(np.maximum(apart, 0), axis=-1).min())


def _clearance(a: Body, b: Body) -> float | None:
    if a.lower is None or a.upper is None or b.lower is None or b.upper is None:
        return None
    shared = np.minimum(a.upper, b.upper)[:2] - np.maximum(a.lower, b.lower)[:2]
    return float(a.lower[2] - b.upper[2]) if bool((shared > 0).all()) else None


def _size_difference(a: Body, b: Body) -> float | None:
    if a.extents is None or b.extents is None:
        return None
    return max(abs(x - y) / max(x, y, 1e-9) for x, y in zip(a.extents, b.extents, strict=True))
