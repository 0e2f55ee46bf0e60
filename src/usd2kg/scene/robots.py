"""Robots: many bodies on a chain of turning joints are one thing to a person."""

from collections.abc import Iterator, Mapping, Sequence

from usd2kg.scene.outline import JointLink, Outline, PrimRecord

__all__ = ["merge_robots"]

_ARM_JOINTS = 4
"""A chain of this many turning joints, each moving the next, is a robot arm and not furniture."""
_TURNING = "PhysicsRevoluteJoint"


def merge_robots(outline: Outline, candidates: dict[str, str]) -> None:
    """Make the bodies of each robot arm one candidate: the topmost body, or the prim that holds just the robot.

    Links may be nested in each other (as URDF converters write them) or lie side by side (as Isaac Sim does).
    """
    if sum(joint.type_name == _TURNING for joint in outline.joints) < _ARM_JOINTS:
        return
    _merge_nested(outline, candidates)
    _merge_side_by_side(outline, candidates)


def _merge_nested(outline: Outline, candidates: dict[str, str]) -> None:
    turning = {joint.body1 for joint in outline.joints if joint.type_name == _TURNING}
    for record in outline.records:
        if record.path in candidates and record.is_body and _nested_chain(record, turning) >= _ARM_JOINTS:
            _merge(record, candidates)


def _merge(record: PrimRecord, candidates: dict[str, str]) -> None:
    for below in record.walk():
        candidates.pop(below.path, None)
    candidates[record.path] = "robot: a chain of turning joints"


def _nested_chain(record: PrimRecord, turning: set[str]) -> int:
    """Return the longest run of turning joints below `record`, if the chain never branches into objects."""
    length, current = 0, record
    while True:
        links = [child for child in current.children if child.is_body]
        if len(links) != 1:
            return length
        current = links[0]
        length += current.path in turning


def _merge_side_by_side(outline: Outline, candidates: dict[str, str]) -> None:
    moved = {joint.body1: joint for joint in outline.joints if joint.body0}
    moves: dict[str, list[str]] = {}
    for joint in moved.values():
        moves.setdefault(str(joint.body0), []).append(joint.body1)
    bases = {base for body in moved if body in candidates and (base := _arm_base(body, moved))}
    if not bases:
        return
    records = {record.path: record for record in outline.records}
    for base in sorted(bases):
        bodies = [records[body] for body in sorted(_carried(base, moves)) if body in records]
        holder = _holder(bodies)
        # A prim that shows more than the robot is the room or the table that it stands on.
        if holder is not None and holder.gprim_count == _geometry_of(bodies):
            _merge(holder, candidates)


def _arm_base(body: str, moved: Mapping[str, JointLink]) -> str | None:
    """Return the body that a chain of turning joints to `body` stands on; None if they are too few for an arm."""
    turns, base, seen = 0, None, {body}
    while body in moved:
        joint = moved[body]
        body = str(joint.body0)
        if body in seen:
            return None
        seen.add(body)
        if joint.type_name == _TURNING:
            # What the base itself is fixed to is no part of the robot.
            turns, base = turns + 1, body
    return base if turns >= _ARM_JOINTS else None


def _carried(base: str, moves: Mapping[str, list[str]]) -> set[str]:
    """Return a body with all that joints hang on it."""
    found, pending = {base}, [base]
    while pending:
        for body in moves.get(pending.pop(), ()):
            if body not in found:
                found.add(body)
                pending.append(body)
    return found


def _geometry_of(bodies: Sequence[PrimRecord]) -> int:
    """Return the number of visible geometry prims of the bodies, nested ones counted once."""
    paths = {body.path for body in bodies}
    outermost = [body for body in bodies if not any(above.path in paths for above in _above(body))]
    return sum(body.gprim_count for body in outermost)


def _above(record: PrimRecord) -> Iterator[PrimRecord]:
    above = record.parent
    while above is not None:
        yield above
        above = above.parent


def _holder(bodies: Sequence[PrimRecord]) -> PrimRecord | None:
    """Return the nearest prim that all the bodies are below; None if that is the stage itself."""
    shared: list[PrimRecord] | None = None
    for body in bodies:
        above = list(_above(body))
        shared = above if shared is None else [record for record in shared if record in above]
    return shared[0] if shared and shared[0].parent is not None else None
