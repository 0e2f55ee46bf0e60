"""Functions of SPARQL that measure: a graph holds positions as text, which SPARQL alone cannot compute with.

Objects are taken as boxes. A function of an object without a box is unbound, and so is one whose arguments are wrong.
"""

from collections.abc import Callable

import numpy as np
import pyoxigraph as ox

from usd2kg.query.bodies import Body, BodyIndex, parse_vector
from usd2kg.query.sweep import find_obstacles

__all__ = ["FUNCTIONS", "FUNCTION_NAMESPACE", "make_functions"]

FUNCTION_NAMESPACE = "https://w3id.org/usd2kg/function#"
"""Prefix `u2kf:` in queries."""

Term = ox.NamedNode | ox.BlankNode | ox.Literal | ox.Triple
Function = Callable[..., Term | None]

FUNCTIONS = {
    "gap": "(object, object): metres between the boxes of two objects; 0 where they meet",
    "clearance": "(object, object): metres from the top of the second up to the bottom of the first, where one is over"
    " the other; less than 0 where the first begins below that top",
    "distanceTo": '(object, "x y z"): metres from a position to the box of an object; 0 inside',
    "extent": "(object, 1, 2 or 3): shortest, middle or longest extent, metres, along its own axes where known",
    "sizeDifference": "(object, object): largest difference of their extents, as a share of the larger",
    "mass": "(object): kilograms",
    "opensInto": "(joint, object): how far the joint opens until its moving part meets the object, radians or metres",
    "tilts": "(joint): whether what lies on the moving part would slide off, since it turns about a lying axis",
}
"""Function → arguments and what comes back."""


def make_functions(store: ox.Store) -> dict[ox.NamedNode, Function]:
    """Return the functions over the objects of a store; they read it when they are first called."""
    measure = _Measure(BodyIndex(store))
    functions: dict[str, Function] = {
        "gap": lambda a, b: _pair(measure, a, b, _gap),
        "clearance": lambda a, b: _pair(measure, a, b, _clearance),
        "distanceTo": measure.distance_to,
        "extent": measure.extent,
        "sizeDifference": lambda a, b: _pair(measure, a, b, _size_difference),
        "mass": lambda a: _literal(measure.body(a).mass),
        "opensInto": measure.opens_into,
        "tilts": measure.tilts,
    }
    return {ox.NamedNode(FUNCTION_NAMESPACE + name): function for name, function in functions.items()}


_NOTHING = Body(None, None, None, None)


class _Measure:
    def __init__(self, bodies: BodyIndex) -> None:
        self._bodies = bodies
        self._obstacles: dict[str, dict[str, float]] = {}

    def body(self, term: Term) -> Body:
        return self._bodies.by_iri.get(_text(term), _NOTHING)

    def distance_to(self, term: Term, position: Term) -> Term | None:
        body, point = self.body(term), parse_vector(_text(position))
        if point is None or body.lower is None or body.upper is None:
            return None
        return _literal(_apart(Body(point, point, None, None), body))

    def extent(self, term: Term, rank: Term) -> Term | None:
        extents = self.body(term).extents
        return _literal(extents[int(_text(rank)) - 1]) if extents and _text(rank) in {"1", "2", "3"} else None

    def opens_into(self, joint: Term, term: Term) -> Term | None:
        iri = _text(joint)
        if iri not in self._obstacles:
            motion = self._bodies.joints.get(iri)
            self._obstacles[iri] = find_obstacles(self._bodies, motion) if motion else {}
        met = self._obstacles[iri].get(_text(term))
        return None if met is None else _literal(abs(met))

    def tilts(self, joint: Term) -> Term | None:
        motion = self._bodies.joints.get(_text(joint))
        return None if motion is None else ox.Literal(bool(motion.turns and abs(motion.axis[2]) < 0.7))


def _text(term: Term) -> str:
    return "" if isinstance(term, ox.Triple) else term.value


def _literal(value: float | None) -> ox.Literal | None:
    # A tenth of a millimetre is finer than any scene's modelling, and its text is short.
    return None if value is None else ox.Literal(round(float(value), 4) + 0.0)


def _pair(measure: _Measure, a: Term, b: Term, compare: Callable[[Body, Body], float | None]) -> Term | None:
    return _literal(compare(measure.body(a), measure.body(b)))


def _gap(a: Body, b: Body) -> float | None:
    return None if a.lower is None or b.lower is None else _apart(a, b)


def _apart(a: Body, b: Body) -> float:
    """Return the distance of two boxes, metres; 0 where they meet."""
    assert a.lower is not None and a.upper is not None and b.lower is not None and b.upper is not None
    return float(np.linalg.norm(np.maximum(np.maximum(a.lower - b.upper, b.lower - a.upper), 0)))


def _clearance(a: Body, b: Body) -> float | None:
    if a.lower is None or a.upper is None or b.lower is None or b.upper is None:
        return None
    shared = np.minimum(a.upper, b.upper)[:2] - np.maximum(a.lower, b.lower)[:2]
    return float(a.lower[2] - b.upper[2]) if bool((shared > 0).all()) else None


def _size_difference(a: Body, b: Body) -> float | None:
    if a.extents is None or b.extents is None:
        return None
    return max(abs(x - y) / max(x, y, 1e-9) for x, y in zip(a.extents, b.extents, strict=True))
