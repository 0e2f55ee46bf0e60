"""Joints with their bodies, axis, limits and state; radians, metres, vectors in the world frame.

soma:RevoluteJoint and soma:PrismaticJoint require both limits, so joints with fewer get a superclass. Types that SOMA
lacks get a u2k class.
"""

from collections.abc import Iterator
from typing import NamedTuple

import pyoxigraph as ox

from usd2kg.graph.iris import individual_iri
from usd2kg.graph.physical_properties import aspect_node, declare_individual
from usd2kg.graph.vocabulary import RDF, RDFS, SOMA, U2K, XSD, Triple, number, text, vector_text
from usd2kg.prim_paths import nearest_in
from usd2kg.scene import Joint, Scene

__all__ = ["JointIndividual", "plain_joint", "resolve_joints", "soma_joint"]

_OWN_CLASSES = {
    "revolute": U2K.RevoluteJoint,
    "prismatic": U2K.PrismaticJoint,
    "fixed": U2K.FixedJoint,
    "spherical": U2K.SphericalJoint,
    "distance": U2K.DistanceJoint,
    "other": U2K.Joint,
}


class JointIndividual(NamedTuple):
    """A joint with its node and the objects that it connects."""

    joint: Joint
    node: ox.NamedNode
    parent: ox.NamedNode | None
    """Fixed object; None for the world, a body that does not belong to an object, and a joint within one object."""
    child: ox.NamedNode | None
    """Moved object; None in the same cases."""
    whole: ox.NamedNode | None
    """Object that both bodies belong to, such as a robot; None if there is none."""


def resolve_joints(scene: Scene, base: str) -> Iterator[JointIndividual]:
    """Yield the joints of a scene in order; a body belongs to the nearest object at or above it."""
    for joint in scene.joints:
        parent, child = (nearest_in(body, scene.by_path) for body in (joint.body0, joint.body1))
        whole = parent if parent == child else None
        if whole is not None:
            parent = child = None
        nodes = (ox.NamedNode(individual_iri(base, path)) if path else None for path in (parent, child, whole))
        yield JointIndividual(joint, ox.NamedNode(individual_iri(base, joint.prim_path, "joint")), *nodes)


def plain_joint(linked: JointIndividual) -> Iterator[Triple]:
    """Yield a joint in u2k terms."""
    joint, node = linked.joint, linked.node
    yield from declare_individual(node, _OWN_CLASSES[joint.type])
    yield from _common(linked)
    for name, other in (("parentObject", linked.parent), ("childObject", linked.child)):
        if other is not None:
            yield node, U2K[name], other
    for name, value in (("lowerLimit", joint.lower), ("upperLimit", joint.upper), ("jointPosition", joint.value)):
        if value is not None:
            yield node, U2K[name], number(value)


def soma_joint(linked: JointIndividual) -> Iterator[Triple]:
    """Yield a joint in SOMA terms, with u2k terms for what SOMA lacks."""
    joint, node = linked.joint, linked.node
    first, *others = _soma_classes(joint)
    yield from declare_individual(node, first)
    for cls in others:
        yield node, RDF.type, cls
    yield from _common(linked)
    for name, other in (("hasParentLink", linked.parent), ("hasChildLink", linked.child)):
        if other is not None:
            yield node, SOMA[name], other
    limits = (("hasJointPositionMin", joint.lower), ("hasJointPositionMax", joint.upper))
    yield from _region(node, "limit", SOMA.hasJointLimit, SOMA.JointLimit, limits)
    yield from _region(node, "state", SOMA.hasJointState, SOMA.JointState, (("hasJointPosition", joint.value),))


def _soma_classes(joint: Joint) -> tuple[ox.NamedNode, ...]:
    limits = sum(limit is not None for limit in (joint.lower, joint.upper))
    match joint.type:
        case "revolute":
            return ((SOMA.ContinuousJoint,), (SOMA.HingeJoint,), (SOMA.RevoluteJoint,))[limits]
        case "prismatic":
            return (SOMA.PrismaticJoint,) if limits == 2 else (SOMA.MovableJoint, U2K.PrismaticJoint)
        case "fixed":
            return (SOMA.FixedJoint,)
        case "other":
            return (SOMA.Joint,)
        case _:
            return (SOMA.MovableJoint, _OWN_CLASSES[joint.type])


def _region(
    node: ox.NamedNode,
    part: str,
    has: ox.NamedNode,
    cls: ox.NamedNode,
    values: tuple[tuple[str, float | None], ...],
) -> Iterator[Triple]:
    known = [(name, value) for name, value in values if value is not None]
    if known:
        region = aspect_node(node, part)
        yield node, has, region
        yield from declare_individual(region, cls)
        for name, value in known:
            yield region, SOMA[name], number(value)


def _common(linked: JointIndividual) -> Iterator[Triple]:
    joint, node = linked.joint, linked.node
    yield node, RDFS.label, text(joint.prim_path.rpartition("/")[2])
    yield node, U2K.definingPrim, text(joint.prim_path)
    for name, path in (("parentPrim", joint.body0), ("childPrim", joint.body1)):
        if path is not None:
            yield node, U2K[name], text(path)
    for name, vector in (("jointAxis", joint.axis_vector), ("jointOrigin", joint.origin)):
        if vector is not None:
            yield node, U2K[name], text(vector_text(vector))
    if not joint.is_enabled:
        yield node, U2K.isEnabled, ox.Literal("false", datatype=XSD.boolean)
    if joint.is_excluded_from_articulation:
        yield node, U2K.closesLoop, ox.Literal("true", datatype=XSD.boolean)
