"""Merge the rigid bodies of a robot arm, a chain of revolute joints, into one object."""

from collections.abc import Iterator, Mapping, Sequence

from usd2kg.scene.outline import JointLink, Outline, PrimRecord
from usd2kg.scene.settings import ROBOTS

__all__ = ["ROBOT", "merge_robots"]

ROBOT = "robot: a chain of revolute joints"
"""The reason of an object that was merged from the links of an arm."""
_REVOLUTE = "PhysicsRevoluteJoint"


def merge_robots(outline: Outline, candidates: dict[str, str]) -> None:
    """Merge the bodies of each robot arm into one candidate: the topmost body, or the prim that contains only the arm.

    Links may be nested (as URDF converters write them) or siblings (as Isaac Sim writes them).
    """
    if sum(joint.type_name == _REVOLUTE for joint in outline.joints) < ROBOTS.min_turning_joints:
        return
    _merge_nested(outline, candidates)
    _merge_siblings(outline, candidates)


def _merge_nested(outline: Outline, candidates: dict[str, str]) -> None:
    turning = {joint.body1 for joint in outline.joints if joint.type_name == _REVOLUTE}
    for record in outline.records:
        if record.path in candidates and record.is_body and _nested_chain(record, turning) >= ROBOTS.min_turning_joints:
            _merge(record, candidates)


def _merge(record: PrimRecord, candidates: dict[str, str]) -> None:
    for below in record.walk():
        candidates.pop(below.path, None)
    candidates[record.path] = ROBOT


def _nested_chain(record: PrimRecord, turning: set[str]) -> int:
    """Return the number of revolute joints in the chain of bodies below `record`, up to its first branching."""
    length, current = 0, record
    while True:
        links = [child for child in current.children if child.is_body]
        if len(links) != 1:
            return length
        current = links[0]
        length += current.path in turning


def _merge_siblings(outline: Outline, candidates: dict[str, str]) -> None:
    moved = {joint.body1: joint for joint in outline.joints if joint.body0}
    moves: dict[str, list[str]] = {}
    for joint in moved.values():
        moves.setdefault(str(joint.body0), []).append(joint.body1)
    bases = {base for body in moved if body in candidates and (base := _arm_base(body, moved))}
    if not bases:
        return
    records = {record.path: record for record in outline.records}
    for base in sorted(bases):
        bodies = [records[body] for body in sorted(_moved_with(base, moves)) if body in records]
        common = _common_ancestor(bodies)
        # A prim with more geometry than the robot is its room or table.
        if common is not None and common.gprim_count == _count_gprims(bodies):
            _merge(common, candidates)


def _arm_base(body: str, moved: Mapping[str, JointLink]) -> str | None:
    """Return the base of the chain of revolute joints that ends in `body`; None if it is too short for an arm."""
    turns, base, seen = 0, None, {body}
    while body in moved:
        joint = moved[body]
        body = str(joint.body0)
        if body in seen:
            return None
        seen.add(body)
        if joint.type_name == _REVOLUTE:
            # The body that the base is fixed to does not belong to the robot.
            turns, base = turns + 1, body
    return base if turns >= ROBOTS.min_turning_joints else None


def _moved_with(base: str, moves: Mapping[str, list[str]]) -> set[str]:
    """Return a body and all bodies that joints attach to it, directly or indirectly."""
    found, pending = {base}, [base]
    while pending:
        for body in moves.get(pending.pop(), ()):
            if body not in found:
                found.add(body)
                pending.append(body)
    return found


def _count_gprims(bodies: Sequence[PrimRecord]) -> int:
    """Return the number of visible gprims of the bodies; those of nested bodies count once."""
    paths = {body.path for body in bodies}
    outermost = [body for body in bodies if not any(above.path in paths for above in _ancestors(body))]
    return sum(body.gprim_count for body in outermost)


def _ancestors(record: PrimRecord) -> Iterator[PrimRecord]:
    above = record.parent
    while above is not None:
        yield above
        above = above.parent


def _common_ancestor(bodies: Sequence[PrimRecord]) -> PrimRecord | None:
    """Return the nearest common ancestor of the bodies; None if it is the pseudo-root."""
    shared: list[PrimRecord] | None = None
    for body in bodies:
        above = list(_ancestors(body))
        shared = above if shared is None else [record for record in shared if record in above]
    return shared[0] if shared and shared[0].parent is not None else None
