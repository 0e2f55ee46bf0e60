"""Robots: many bodies on a chain of turning joints are one thing to a person."""

from collections.abc import Iterable, Mapping

from usd2kg.scene.outline import Node, Outline

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
    for node in outline.root.walk():
        if node.path in candidates and node.is_body and _nested_chain(node, turning) >= _ARM_JOINTS:
            _merge(node, candidates)


def _merge(node: Node, candidates: dict[str, str]) -> None:
    for below in node.walk():
        candidates.pop(below.path, None)
    candidates[node.path] = "robot: a chain of turning joints"


def _nested_chain(node: Node, turning: set[str]) -> int:
    """Return the longest run of turning joints below `node`, if the chain never branches into objects."""
    length, current = 0, node
    while True:
        links = [child for child in current.children if child.is_body]
        if len(links) != 1:
            return length
        current = links[0]
        length += current.path in turning


def _merge_side_by_side(outline: Outline, candidates: dict[str, str]) -> None:
    links = {joint.body1: (joint.body0, joint.type_name == _TURNING) for joint in outline.joints if joint.body0}
    ends = {body for body in links if body in candidates and _chain_above(body, links) >= _ARM_JOINTS}
    if not ends:
        return
    nodes = {node.path: node for node in outline.root.walk()}
    for end in sorted(ends):
        bodies = _joined(end, links) & nodes.keys()
        holder = _holder([nodes[body] for body in sorted(bodies)])
        below = {node.path for node in holder.walk() if node.path in candidates} if holder else set()
        if holder is not None and below and below <= bodies | {holder.path}:
            _merge(holder, candidates)


def _chain_above(body: str, links: Mapping[str, tuple[str, bool]]) -> int:
    """Return how many turning joints lead to a body from its base."""
    count, seen = 0, {body}
    while body in links:
        body, is_turning = links[body]
        count += is_turning
        if body in seen:
            return 0
        seen.add(body)
    return count


def _joined(body: str, links: Mapping[str, tuple[str, bool]]) -> set[str]:
    """Return all bodies that joints connect with `body`."""
    beside: dict[str, list[str]] = {}
    for body1, (body0, _) in links.items():
        beside.setdefault(body0, []).append(body1)
        beside.setdefault(body1, []).append(body0)
    found, pending = {body}, [body]
    while pending:
        for other in beside.get(pending.pop(), ()):
            if other not in found:
                found.add(other)
                pending.append(other)
    return found


def _holder(bodies: Iterable[Node]) -> Node | None:
    """Return the nearest prim that all the bodies are below; None if that is the stage itself."""
    shared: list[Node] | None = None
    for body in bodies:
        above: list[Node] = []
        node = body.parent
        while node is not None:
            above.append(node)
            node = node.parent
        shared = above if shared is None else [node for node in shared if node in above]
    return shared[0] if shared and shared[0].parent is not None else None
