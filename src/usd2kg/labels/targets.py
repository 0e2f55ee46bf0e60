"""Prims that a layer can label."""

from typing import Any, NamedTuple

from pxr import Sdf

__all__ = ["LabelTarget", "find_target"]


class LabelTarget(NamedTuple):
    """A prim to label, or the reason why it cannot be labelled."""

    prim: Any
    """None if a layer cannot label it."""
    reason: str = ""
    """Why the prim cannot be labelled; empty if it can."""
    instances: tuple[str, ...] = ()
    """Paths of the instances around it, outermost first, which must be made uninstanceable."""


def find_target(stage: Any, prim_path: str, *, de_instances: bool) -> LabelTarget:
    """Return the prim to label at a path.

    Args:
        stage: the composed stage.
        prim_path: an absolute path; may also be the path of an instance of a point instancer.
        de_instances: whether enclosing instances may be made uninstanceable.
    """
    prim = _prim_at(stage, prim_path)
    reason = _find_obstacle(prim, prim_path)
    if reason or not prim.IsInstanceProxy():
        return LabelTarget(None if reason else prim, reason)
    instances = tuple(_enclosing_instances(prim))
    if not de_instances:
        return LabelTarget(None, f"inside an instance, which --de-instance makes editable: {instances[0]}")
    return LabelTarget(prim, instances=instances)


def _prim_at(stage: Any, prim_path: str) -> Any:
    is_path = prim_path.startswith("/") and Sdf.Path.IsValidPathString(prim_path)
    return stage.GetPrimAtPath(prim_path) if is_path and Sdf.Path(prim_path).IsPrimPath() else None


def _find_obstacle(prim: Any, prim_path: str) -> str:
    """Return why a prim cannot be labelled, apart from instancing; empty if it can."""
    if not prim:
        is_instance = prim_path.endswith("]")
        return "an instance of a point instancer is not a prim" if is_instance else "no such prim on the stage"
    obstacles = (
        (prim.IsInPrototype(), "inside a prototype, whose path OpenUSD generates"),
        (not prim.IsActive(), "inactive"),
        (not prim.IsDefined(), "only an over without a definition"),
        (prim.IsAbstract(), "abstract; prims that inherit from it would be labelled"),
    )
    return next((reason for holds, reason in obstacles if holds), "")


def _enclosing_instances(prim: Any) -> list[str]:
    found = []
    parent = prim.GetParent()
    while parent and not parent.IsPseudoRoot():
        if parent.IsInstance():
            found.append(str(parent.GetPath()))
        parent = parent.GetParent()
    return found[::-1]
