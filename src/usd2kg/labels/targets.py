"""Which prims can carry a label in a layer over their stage, and which instances stand in the way."""

from typing import Any, NamedTuple

from pxr import Sdf

__all__ = ["LabelTarget", "find_target"]


class LabelTarget(NamedTuple):
    """Whether one prim can carry a label."""

    prim: Any
    """The prim; None where it can carry none."""
    reason: str = ""
    """Why not."""
    instances: tuple[str, ...] = ()
    """Paths of the instances that have to be broken up first, the outermost first."""


def find_target(stage: Any, prim_path: str, *, de_instances: bool) -> LabelTarget:
    """Return whether the prim at a path can carry a label.

    Args:
        stage: the composed stage.
        prim_path: an absolute path, or that of a copy of a point instancer.
        de_instances: whether instances may be broken up for it.
    """
    prim = _prim_at(stage, prim_path)
    reason = _reason_against(prim, prim_path)
    if reason or not prim.IsInstanceProxy():
        return LabelTarget(None if reason else prim, reason)
    instances = tuple(_instances_above(prim))
    if not de_instances:
        return LabelTarget(None, f"it is inside the instance {instances[0]}; --de-instance breaks that up")
    return LabelTarget(prim, instances=instances)


def _prim_at(stage: Any, prim_path: str) -> Any:
    is_path = prim_path.startswith("/") and Sdf.Path.IsValidPathString(prim_path)
    return stage.GetPrimAtPath(prim_path) if is_path and Sdf.Path(prim_path).IsPrimPath() else None


def _reason_against(prim: Any, prim_path: str) -> str:
    """Return why a prim can carry no label, instances left aside; empty if it can."""
    if not prim:
        is_copy = prim_path.endswith("]")
        return "a copy of a point instancer is no prim" if is_copy else "there is no such prim on the stage"
    told = (
        (prim.IsInPrototype(), "it is in a prototype, whose path OpenUSD makes up"),
        (not prim.IsActive(), "it is inactive"),
        (not prim.IsDefined(), "it is only an over, nothing defines it"),
        (prim.IsAbstract(), "it is abstract: what inherits from it would be labelled"),
    )
    return next((reason for holds, reason in told if holds), "")


def _instances_above(prim: Any) -> list[str]:
    above = []
    parent = prim.GetParent()
    while parent and not parent.IsPseudoRoot():
        if parent.IsInstance():
            above.append(str(parent.GetPath()))
        parent = parent.GetParent()
    return above[::-1]
