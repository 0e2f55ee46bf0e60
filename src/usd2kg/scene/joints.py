"""Physics joints of a stage, in radians, metres and the z-up world frame."""

import math
from collections.abc import Iterable
from typing import Any, NamedTuple

from pxr import Gf, Usd, UsdGeom

from usd2kg.scene.bounds import to_metres
from usd2kg.scene.metadata import authored_texts
from usd2kg.scene.model import Diagnostic, Direction, Joint, JointType, StageFrame, Vector
from usd2kg.scene.settings import JOINTS, MAX_COORDINATE
from usd2kg.scene.stage import UNREADABLE, error_text, read_targets, read_value

__all__ = ["JointReading", "read_joints"]

_TYPES: dict[str, JointType] = {
    "PhysicsRevoluteJoint": "revolute",
    "PhysicsPrismaticJoint": "prismatic",
    "PhysicsFixedJoint": "fixed",
    "PhysicsSphericalJoint": "spherical",
    "PhysicsDistanceJoint": "distance",
}
_LIMITS: dict[str, tuple[str, str]] = {
    "revolute": ("physics:lowerLimit", "physics:upperLimit"),
    "prismatic": ("physics:lowerLimit", "physics:upperLimit"),
    "distance": ("physics:minDistance", "physics:maxDistance"),
}
_STATES = {"revolute": "state:angular:physics:position", "prismatic": "state:linear:physics:position"}
_AXES = {"X": Gf.Vec3d(1, 0, 0), "Y": Gf.Vec3d(0, 1, 0), "Z": Gf.Vec3d(0, 0, 1)}
_WITH_AXIS = frozenset({"revolute", "prismatic", "spherical"})
_MIN_LENGTH = 1e-9
"""Shorter directions and rotations are undefined."""
_FLOAT32_NOISE = 1e-6
"""Smaller components of a unit vector are rounding errors of 32-bit quaternions."""
_MIN_COSINE = math.cos(math.radians(JOINTS.max_axis_angle))


class JointReading(NamedTuple):
    """The joints in traversal order, with diagnostics."""

    joints: tuple[Joint, ...]
    diagnostics: tuple[Diagnostic, ...]
    """Code `joint`."""


def read_joints(prims: Iterable[Any], frame: StageFrame, time: Any) -> JointReading:
    """Return the joints of a stage.

    Authored limits and states are in degrees or stage units, and joint frames are relative to the bodies, as UsdPhysics
    specifies.

    Args:
        prims: the joint prims.
        frame: units and up axis of the stage.
        time: time code at which bodies and values are read.
    """
    reader = _JointReader(frame, time)
    joints = tuple(joint for prim in prims if (joint := reader.read(prim)))
    return JointReading(joints, tuple(reader.notes))


class _JointReader:
    def __init__(self, frame: StageFrame, time: Any) -> None:
        self.frame = frame
        self.time = time
        self.xforms = UsdGeom.XformCache(time)
        self.notes: list[Diagnostic] = []

    def read(self, prim: Any) -> Joint | None:
        """Return a joint; None if OpenUSD cannot read it."""
        try:
            return self._read(prim)
        except UNREADABLE as error:
            self._note(prim, f"OpenUSD cannot read it ({error_text(error)}); it is left out")
            return None

    def _read(self, prim: Any) -> Joint:
        kind = _TYPES.get(str(prim.GetTypeName()), "other")
        bodies = [self._body(prim, side) for side in (0, 1)]
        if not any(path for path, _ in bodies):
            self._note(prim, "it connects no body on the stage; expected targets of physics:body0 and physics:body1")
        side = _framed_side([body for _, body in bodies])
        axis = self._axis(prim) if kind in _WITH_AXIS else None
        vector = self._axis_vector(prim, axis, side, bodies[side][1]) if axis and side is not None else None
        lower, upper = self._limits(prim, kind)
        return Joint(
            prim_path=str(prim.GetPath()),
            type=kind,
            body0=bodies[0][0],
            body1=bodies[1][0],
            axis=axis,
            axis_vector=vector,
            origin=self._origin(prim, side, bodies[side][1]) if side is not None else None,
            direction=_direction(vector) if vector else None,
            lower=lower,
            upper=upper,
            value=self._value(prim, kind),
            is_enabled=self._flag(prim, "physics:jointEnabled", default=True),
            is_excluded_from_articulation=self._flag(prim, "physics:excludeFromArticulation", default=False),
        )

    def _body(self, prim: Any, side: int) -> tuple[str | None, Any]:
        """Return the path and the prim of a body; the prim is None for the world, and invalid for a broken target."""
        targets = read_targets(prim, f"physics:body{side}")
        if not targets:
            return None, None
        if len(targets) > 1:
            self._note(prim, f"physics:body{side} has {len(targets)} targets, expected one; <{targets[0]}> is used")
        path = targets[0].GetPrimPath()
        body = prim.GetStage().GetPrimAtPath(path)
        if body and body.IsActive():
            return str(path), body
        above = _nearest_above(prim.GetStage(), path)
        state = "is inactive" if body else "is not on the stage"
        instead = f"<{above}> is used" if above else "it is left out"
        self._note(prim, f"physics:body{side} is <{path}>, which {state}; {instead}")
        return above, Usd.Prim()

    def _axis(self, prim: Any) -> str | None:
        # UsdPhysics: the default axis is X.
        axis = next(iter(authored_texts(prim, "physics:axis", self.time)), "X")
        if axis not in _AXES:
            self._note(prim, f"physics:axis is {axis!r}, expected X, Y or Z; it has no axis")
            return None
        return axis

    def _axis_vector(self, prim: Any, axis: str, side: int, body: Any) -> Vector | None:
        direction = _AXES[axis]
        local = read_value(prim, f"physics:localRot{side}", self.time, Gf.Quatf, Gf.Quatd, Gf.Quath)
        # Exporters write an all-zero quaternion for "not set".
        if local is not None and not local.GetLength() < _MIN_LENGTH:
            direction = Gf.Rotation(Gf.Quatd(local).GetNormalized()).TransformDir(direction)
        if body:
            try:
                # A non-uniform scale of the body must not tilt the axis.
                pose = self.xforms.GetLocalToWorldTransform(body).RemoveScaleShear()
            except UNREADABLE:
                return None
            direction = pose.TransformDir(direction)
        return _unit(direction, self.frame)

    def _origin(self, prim: Any, side: int, body: Any) -> Vector | None:
        # UsdPhysics: the joint frame is relative to the body's frame, including its scale.
        local = read_value(prim, f"physics:localPos{side}", self.time, Gf.Vec3f, Gf.Vec3d, Gf.Vec3h)
        point = Gf.Vec3d(local or (0, 0, 0))
        if body:
            try:
                point = self.xforms.GetLocalToWorldTransform(body).Transform(point)
            except UNREADABLE:
                return None
        origin = to_metres(point, self.frame)
        return origin if all(abs(value) < MAX_COORDINATE for value in origin) else None

    def _limits(self, prim: Any, kind: JointType) -> tuple[float | None, float | None]:
        if kind not in _LIMITS:
            return None, None
        lower, upper = (self._number(prim, name) for name in _LIMITS[kind])
        if kind == "distance":
            # UsdPhysics: a negative distance means "unlimited".
            lower, upper = (None if value is None or value < 0 else value for value in (lower, upper))
        if lower is not None and upper is not None and lower > upper:
            self._note(prim, f"its lower limit {lower:g} is above its upper limit {upper:g}; both are kept as authored")
        return self._convert(lower, kind), self._convert(upper, kind)

    def _value(self, prim: Any, kind: JointType) -> float | None:
        return self._convert(self._number(prim, _STATES[kind]), kind) if kind in _STATES else None

    def _convert(self, value: float | None, kind: JointType) -> float | None:
        if value is None:
            return None
        return math.radians(value) if kind == "revolute" else value * self.frame.metres_per_unit

    def _number(self, prim: Any, name: str) -> float | None:
        """Return an authored number in stage units; None if there is none, or it means "unlimited"."""
        value = read_value(prim, name, self.time, object)
        if value is None:
            return None
        if not isinstance(value, int | float) or math.isnan(value):
            self._note(prim, f"{name} is {value!r}, expected a number; it is left out")
            return None
        # Restore the decimal number of a 32-bit float, such as 0.4 for 0.4000000059604645.
        return float(f"{value:.7g}") if abs(value) < MAX_COORDINATE else None

    def _flag(self, prim: Any, name: str, *, default: bool) -> bool:
        value = read_value(prim, name, self.time, bool)
        return default if value is None else bool(value)

    def _note(self, prim: Any, message: str) -> None:
        self.notes.append(Diagnostic("joint", message, str(prim.GetPath())))


def _framed_side(bodies: list[Any]) -> int | None:
    """Return the side whose joint frame is used; None if neither can be.

    Both joint frames have the same axis. An existing body is preferred to the world (None), side 0 to side 1.
    """
    sides = [side for side in (0, 1) if bodies[side]] or [side for side in (0, 1) if bodies[side] is None]
    return sides[0] if sides else None


def _nearest_above(stage: Any, path: Any) -> str | None:
    for above in path.GetPrefixes()[-2::-1]:
        prim = stage.GetPrimAtPath(above)
        if prim and prim.IsActive():
            return str(above)
    return None


def _unit(direction: Any, frame: StageFrame) -> Vector | None:
    """Return a direction of the stage as a unit vector, z-up; None if its length is 0 or not finite."""
    x, y, z = (direction[0], direction[1], direction[2])
    if frame.up_axis == "Y":
        y, z = -z, y
    length = math.hypot(x, y, z)
    if not math.isfinite(length) or length < _MIN_LENGTH:
        return None
    unit = [0.0 if abs(value) < _FLOAT32_NOISE * length else value / length for value in (x, y, z)]
    return (unit[0], unit[1], unit[2])


def _direction(vector: Vector) -> Direction:
    if abs(vector[2]) >= _MIN_COSINE:
        return "vertical"
    return "horizontal" if math.hypot(vector[0], vector[1]) >= _MIN_COSINE else "oblique"
