"""The stage as a plain tree of outline nodes: just what choosing the objects needs.

Traversal happens once, here. Prims that can never be objects (cameras, materials, inactive or
invisible branches…) are counted by reason and not entered.
"""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from pxr import Kind, Tf, Usd, UsdGeom, UsdPhysics

from usd2kg.scene.stage import OpenedStage

__all__ = ["Node", "Outline", "outline_stage"]

_HIDDEN_PURPOSES = frozenset({UsdGeom.Tokens.guide, UsdGeom.Tokens.proxy})

_REASON_BY_SCHEMA = (
    ("UsdGeomCamera", "camera"),
    ("UsdLuxBoundableLightBase", "light"),
    ("UsdLuxNonboundableLightBase", "light"),
    ("UsdLuxLightFilter", "light"),
    ("UsdLuxPluginLight", "light"),
    ("UsdShadeMaterial", "material"),
    ("UsdShadeNodeGraph", "material"),
    ("UsdShadeShader", "material"),
    ("UsdGeomSubset", "geometry subset"),
    ("UsdSkelSkeleton", "skeleton rig"),
    ("UsdSkelAnimation", "skeleton rig"),
    ("UsdSkelBlendShape", "skeleton rig"),
    ("UsdPhysicsScene", "physics"),
    ("UsdPhysicsCollisionGroup", "physics"),
    ("UsdRenderSettingsBase", "render settings"),
)


@dataclass(slots=True)
class Node:
    """One prim that is, holds or groups geometry."""

    prim: Any
    path: str
    name: str
    type_name: str
    kind: str
    parent: "Node | None"
    children: list["Node"] = field(default_factory=list)
    is_gprim: bool = False
    is_scope: bool = False
    is_body: bool = False
    """Carries UsdPhysics' RigidBodyAPI, or a mass of its own without being geometry."""
    is_asset: bool = False
    """Brings in a reference or payload, or is an instance."""
    is_instancer: bool = False
    is_hidden: bool = False
    """Of guide or proxy purpose, by itself or from above."""
    is_unresolved: bool = False
    """A reference or payload at or below it could not be opened."""
    gprim_count: int = 0
    """Visible geometry prims at and below it, in default or render purpose."""
    hidden_gprim_count: int = 0
    """The same for guide and proxy purpose."""

    def walk(self) -> Iterator["Node"]:
        """Yield this node and all below it, parents first."""
        pending = [self]
        while pending:
            node = pending.pop()
            yield node
            pending.extend(reversed(node.children))


@dataclass(slots=True)
class Outline:
    """The node tree, and what was not entered into it."""

    root: Node
    """The pseudo-root."""
    left_out: Counter[str]
    """Reason → number of prims."""
    pruned: dict[str, str]
    """Path of a prim that was not entered → the reason."""
    prim_count: int
    joints: dict[str, str]
    """Path of the moved body → type of the joint that moves it."""


def outline_stage(opened: OpenedStage, time: Usd.TimeCode) -> Outline:
    """Return the outline of a stage, instance proxies included, read at `time`."""
    return _Outliner(opened, time).run()


class _Outliner:
    def __init__(self, opened: OpenedStage, time: Usd.TimeCode) -> None:
        self.opened = opened
        self.time = time
        self.unresolved = opened.unresolved
        self.left_out: Counter[str] = Counter()
        self.pruned: dict[str, str] = {}
        self.joints: dict[str, str] = {}
        self.prim_count = 0
        self.reason_by_type: dict[str, tuple[str | None, bool, bool]] = {}

    def run(self) -> Outline:
        pseudo_root = self.opened.stage.GetPseudoRoot()
        root = Node(pseudo_root, "/", "", "", "", None)
        entered = {"/": root}
        prims = iter(Usd.PrimRange(pseudo_root, Usd.TraverseInstanceProxies(Usd.PrimAllPrimsPredicate)))
        next(prims)
        for prim in prims:
            self.prim_count += 1
            path = str(prim.GetPath())
            reason = self._reason_to_prune(prim)
            if reason is not None:
                self.left_out[reason] += 1
                self.pruned[path] = reason
                prims.PruneChildren()
                continue
            node = self._node(prim, path, entered[path.rpartition("/")[0] or "/"])
            entered[path] = node
            if node.is_gprim or node.is_instancer:
                _count_geometry(node)
            if node.is_instancer:
                prims.PruneChildren()
        return Outline(root, self.left_out, self.pruned, self.prim_count, self.joints)

    def _reason_to_prune(self, prim: Any) -> str | None:
        if not prim.IsActive():
            return "inactive"
        if prim.IsAbstract():
            return "abstract"
        if not prim.IsDefined():
            return "over without definition"
        reason, is_joint, is_imageable = self._classify(prim)
        if is_joint:
            for target in UsdPhysics.Joint(prim).GetBody1Rel().GetTargets():
                self.joints.setdefault(str(target), prim.GetTypeName())
            return "physics"
        if reason is None and is_imageable:
            visibility = prim.GetAttribute(UsdGeom.Tokens.visibility)
            if visibility.HasAuthoredValue() and visibility.Get(self.time) == UsdGeom.Tokens.invisible:
                return "invisible"
        return reason

    def _classify(self, prim: Any) -> tuple[str | None, bool, bool]:
        type_name = prim.GetTypeName()
        known = self.reason_by_type.get(type_name)
        if known is None:
            reason = next((why for schema, why in _REASON_BY_SCHEMA if _is_a(prim, schema)), None)
            known = (reason, prim.IsA(UsdPhysics.Joint), prim.IsA(UsdGeom.Imageable))
            self.reason_by_type[type_name] = known
        return known

    def _is_hidden(self, prim: Any, parent_is_hidden: bool) -> bool:
        purpose = prim.GetAttribute(UsdGeom.Tokens.purpose)
        if purpose.HasAuthoredValue():
            return purpose.Get() in _HIDDEN_PURPOSES
        return parent_is_hidden

    def _node(self, prim: Any, path: str, parent: Node) -> Node:
        is_gprim = prim.IsA(UsdGeom.Gprim)
        has_mass = prim.HasAPI(UsdPhysics.MassAPI) and not is_gprim
        node = Node(
            prim=prim,
            path=path,
            name=prim.GetName(),
            type_name=str(prim.GetTypeName()),
            kind=_kind(prim),
            parent=parent,
            is_gprim=is_gprim,
            is_scope=prim.IsA(UsdGeom.Scope),
            is_body=prim.HasAPI(UsdPhysics.RigidBodyAPI) or has_mass,
            is_asset=prim.HasAuthoredReferences() or prim.HasAuthoredPayloads() or prim.IsInstance(),
            is_instancer=prim.IsA(UsdGeom.PointInstancer),
            is_hidden=self._is_hidden(prim, parent.is_hidden),
            is_unresolved=path in self.unresolved,
        )
        parent.children.append(node)
        return node


def _count_geometry(node: Node) -> None:
    above: Node | None = node
    while above is not None:
        if node.is_hidden:
            above.hidden_gprim_count += 1
        else:
            above.gprim_count += 1
        above = above.parent


def _kind(prim: Any) -> str:
    kind = Usd.ModelAPI(prim).GetKind()
    for base in (Kind.Tokens.component, Kind.Tokens.subcomponent, Kind.Tokens.assembly, Kind.Tokens.group):
        # Studios derive kinds of their own ("prop" from "component"); the registry knows the base.
        if kind and Kind.Registry.IsA(kind, base):
            return str(base)
    return str(kind)


def _is_a(prim: Any, schema: str) -> bool:
    schema_type = Tf.Type.FindByName(schema)
    return bool(schema_type) and prim.IsA(schema_type)
