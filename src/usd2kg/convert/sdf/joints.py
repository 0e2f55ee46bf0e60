"""Joints → UsdPhysics joints."""

import math
from collections.abc import Mapping

import numpy as np
from pxr import Gf, Usd, UsdPhysics

from usd2kg.convert.prims import PrimAuthor
from usd2kg.convert.sdf.frames import WORLD_FRAME, Scope
from usd2kg.convert.sdf.model import Axis, SdfJoint
from usd2kg.convert.sdf.notes import Notes
from usd2kg.convert.sdf.values import Matrix, inverse

__all__ = ["define_joint"]

_TYPES = {
    "revolute": "PhysicsRevoluteJoint",
    "continuous": "PhysicsRevoluteJoint",
    "prismatic": "PhysicsPrismaticJoint",
    "fixed": "PhysicsFixedJoint",
    "ball": "PhysicsSphericalJoint",
}
_WITH_AXIS = frozenset({"revolute", "continuous", "prismatic"})
_OTHER = "PhysicsJoint"
_TOKENS = {(1.0, 0.0, 0.0): "X", (0.0, 1.0, 0.0): "Y", (0.0, 0.0, 1.0): "Z"}


def define_joint(
    author: PrimAuthor,
    parent: str,
    joint: SdfJoint,
    scope: Scope,
    bodies: Mapping[str, str],
    to_world: Matrix,
    notes: Notes,
) -> None:
    """Write a joint below the path `parent`; it is omitted, with a note, if its links are missing.

    Args:
        author: author of the stage.
        parent: path of the model or world.
        joint: the joint.
        scope: frames of the model or world.
        bodies: name of a link, as `Scope.link_of` returns it → path of its prim.
        to_world: pose of the model in the world.
        notes: gets what is left out.
    """
    ends = [scope.link_of(name) if name != WORLD_FRAME else "" for name in (joint.parent, joint.child)]
    if any(end is None or (end and end not in bodies) for end in ends) or ends[0] == ends[1]:
        found = f"{joint.parent!r} and {joint.child!r}"
        text = f"the joint {joint.name!r} connects {found}, expected two links; it is left out"
        notes.add(joint.path, joint.element, text)
        return
    type_name = _TYPES.get(joint.type, _OTHER)
    if type_name == _OTHER:
        text = f"the joint {joint.name!r} is of the type {joint.type!r}, which USD lacks; it has no axis and no limits"
        notes.add(joint.path, joint.element, text)
    prim = author.define(parent, joint.name, type_name)
    frame = scope.place(joint.pose, joint.child)
    axis = (joint.axis or Axis((0.0, 0.0, 1.0))) if joint.type in _WITH_AXIS else None
    if axis is not None:
        direction = _direction(axis, frame, scope)
        token = _TOKENS.get(tuple(np.round(direction, 9).tolist()))
        if token is None:
            token, frame = "X", frame @ _turn_from_x(direction)
        UsdPhysics.RevoluteJoint(prim).CreateAxisAttr(token)
        if joint.type != "continuous":
            _limit(prim, axis, is_angle=joint.type == "revolute")
    for side, end in enumerate(ends):
        if end:
            prim.CreateRelationship(f"physics:body{side}", custom=False).SetTargets([bodies[end]])
            local = inverse(scope.pose_or_root(end)) @ frame
        else:
            local = to_world @ frame
        _place(UsdPhysics.Joint(prim), side, local)


def _direction(axis: Axis, frame: Matrix, scope: Scope) -> np.ndarray:
    """Return the unit vector of an axis in the frame of the joint."""
    direction = np.array(axis.xyz, np.float64)
    if axis.expressed_in:
        rotation = scope.pose_or_root(axis.expressed_in)[:3, :3]
        direction = frame[:3, :3].T @ rotation @ direction
    unit: np.ndarray = direction / np.linalg.norm(direction)
    return unit


def _turn_from_x(direction: np.ndarray) -> Matrix:
    """Return a rotation from x to a direction."""
    helper = np.eye(3)[int(np.argmin(np.abs(direction)))]
    second = np.cross(direction, helper)
    second /= np.linalg.norm(second)
    matrix = np.eye(4)
    matrix[:3, :3] = np.stack([direction, second, np.cross(direction, second)], axis=1)
    return matrix


def _limit(prim: Usd.Prim, axis: Axis, *, is_angle: bool) -> None:
    joint = UsdPhysics.RevoluteJoint(prim) if is_angle else UsdPhysics.PrismaticJoint(prim)
    # UsdPhysics has angles in degrees.
    lower, upper = (math.degrees(v) if is_angle and v is not None else v for v in (axis.lower, axis.upper))
    if lower is not None:
        joint.CreateLowerLimitAttr(lower)
    if upper is not None:
        joint.CreateUpperLimitAttr(upper)


def _place(joint: UsdPhysics.Joint, side: int, local: Matrix) -> None:
    position = Gf.Vec3f(*local[:3, 3].tolist())
    rotation = Gf.Quatf(Gf.Matrix4d(local.T.tolist()).ExtractRotationQuat().GetNormalized())
    if side == 0:
        joint.CreateLocalPos0Attr(position)
        joint.CreateLocalRot0Attr(rotation)
    else:
        joint.CreateLocalPos1Attr(position)
        joint.CreateLocalRot1Attr(rotation)
