"""Traverse a stage once and return its outline.

For speed, few values are read per prim: authored metadata and the names of authored properties decide what else is
read. Prims that are never objects (cameras, materials, inactive or invisible subtrees, and so on) are counted by reason
and pruned. A prototype is traversed for its first instance only.
"""

import sys
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from pxr import Kind, Sdf, Tf, Usd, UsdGeom

from usd2kg.scene.equal_references import EqualReferences
from usd2kg.scene.instancers import is_endless
from usd2kg.scene.metadata import text_names
from usd2kg.scene.outline import Authored, JointLink, Outline, PrimRecord
from usd2kg.scene.solids import ROUND_SOLIDS
from usd2kg.scene.stage import UNREADABLE, OpenedStage, read_targets, read_value, value_of

__all__ = ["ENDLESS", "UNREADABLE_PRIM", "outline_prototype", "outline_stage", "paths_above_endless"]

ENDLESS = "point instancer among its own prototypes"
UNREADABLE_PRIM = "unreadable"
"""Reasons of pruned prims that are reported as diagnostics."""
_FAULTS = frozenset({ENDLESS, UNREADABLE_PRIM})

_HIDDEN_PURPOSES = frozenset({UsdGeom.Tokens.guide, UsdGeom.Tokens.proxy})
_TURNING_OPS = ("xformOp:rotate", "xformOp:orient", "xformOp:transform", "xformOp:shear")
_BINDING = "material:binding"
_SUBSET = "geometry subset"
_PHYSICS = "physics"
_INVISIBLE = "invisible"
_RECORDED_METADATA = frozenset({"specifier", "typeName", "kind", "active", "instanceable", "apiSchemas"})
"""Metadata that other fields of a record hold."""

_REASON_BY_SCHEMA = (
    ("UsdGeomCamera", "camera"),
    ("UsdLuxBoundableLightBase", "light"),
    ("UsdLuxNonboundableLightBase", "light"),
    ("UsdLuxLightFilter", "light"),
    ("UsdLuxPluginLight", "light"),
    ("UsdShadeMaterial", "material"),
    ("UsdShadeNodeGraph", "material"),
    ("UsdShadeShader", "material"),
    ("UsdGeomSubset", _SUBSET),
    ("UsdSkelSkeleton", "skeleton rig"),
    ("UsdSkelAnimation", "skeleton rig"),
    ("UsdSkelBlendShape", "skeleton rig"),
    ("UsdPhysicsScene", _PHYSICS),
    ("UsdPhysicsCollisionGroup", _PHYSICS),
    ("UsdRenderSettingsBase", "render settings"),
)


class _TypeTraits(NamedTuple):
    """Facts derived from the type of a prim."""

    reason: str | None
    """Why prims of the type are pruned; None if they are not."""
    is_joint: bool
    may_be_joint: bool
    """Whether the type's name ends in Joint: plain OpenUSD has no schemas of vendors' types (PhysxPhysicsGearJoint)."""
    is_imageable: bool
    is_gprim: bool
    has_points: bool
    is_scope: bool
    is_instancer: bool


def outline_stage(opened: OpenedStage, time: Usd.TimeCode) -> Outline:
    """Return the outline of a stage at `time`, including instance proxies."""
    return _Outliner(opened.stage, time, opened.unresolved).run(opened.stage.GetPseudoRoot().GetAllChildren())


def outline_prototype(prototype: Any, time: Usd.TimeCode) -> Outline:
    """Return the outline of a prototype of a point instancer, which is its first record, and the prims below it.

    The prims above it are not in the outline: the copies are drawn below the instancer. An inactive, abstract or
    invisible prototype has no record.
    """
    outliner = _Outliner(prototype.GetStage(), time, frozenset())
    # A material may be bound above it.
    outliner.outline.root.is_bound = True
    return outliner.run([prototype])


class _Outliner:
    def __init__(self, stage: Any, time: Usd.TimeCode, unresolved: frozenset[str]) -> None:
        self.stage = stage
        self.time = time
        self.unresolved = unresolved
        self.outline = Outline(PrimRecord(stage, "/", "", "", "", None))
        self.traits: dict[str, _TypeTraits] = {}
        self.kinds: dict[str, str] = {"": ""}
        self.authored: dict[tuple[Any, ...], Authored] = {}
        self.first_instances: dict[Any, PrimRecord] = {}
        """Path of the prototype → its first instance."""
        self.instancers: dict[Any, list[Any]] = {}
        """Path of a prim → the point instancers at and below it; a cache."""
        self.labelled: set[Any] = set()
        """Paths of labelled prims in prototypes."""
        self.references = EqualReferences(stage, self.outline.labelled_prims, _FAULTS | {_PHYSICS})
        self.with_joints: dict[Any, bool] = {}
        """Path of the prototype → whether it contains joints, which are read for each instance."""

    def run(self, tops: Iterable[Any]) -> Outline:
        """Return the outline of some prims and the prims below them."""
        for top in tops:
            self._enter_below(top)
        self.outline.records = list(self.outline.root.walk())[1:]
        _count_geometry(self.outline.records)
        return self.outline

    def _enter_below(self, top: Any) -> None:
        """Add the records of a prim and the prims below it to the root of the outline."""
        entered = {top.GetPath().pathString.rpartition("/")[0]: self.outline.root}
        prims = iter(Usd.PrimRange(top, Usd.TraverseInstanceProxies(Usd.PrimAllPrimsPredicate)))
        for prim in prims:
            path = prim.GetPath().pathString
            above, _, name = path.rpartition("/")
            # Many prims have the same names, which the scene keeps.
            name = sys.intern(name)
            try:
                record = self._enter(prim, path, name, entered[above])
            except UNREADABLE:
                self._leave_out((name, UNREADABLE_PRIM), entered[above])
                record = None
            if record is None:
                prims.PruneChildren()
                continue
            entered[path] = record
            if record.is_instancer or self._copy_known_contents(record):
                prims.PruneChildren()

    def _enter(self, prim: Any, path: str, name: str, parent: PrimRecord) -> PrimRecord | None:
        """Add the record of a prim to the tree and return it; None if the prim is pruned."""
        self.outline.prim_count += 1
        metadata = prim.GetAllAuthoredMetadata()
        reason = _reason_of(metadata)
        if reason is not None:
            self._leave_out((name, reason), parent)
            return None
        type_name = metadata.get("typeName", "")
        if type_name.__class__ is not str:
            type_name = ""
        traits = self._type_traits(prim, type_name)
        schemas = tuple(prim.GetPrimTypeInfo().GetAppliedAPISchemas()) if "apiSchemas" in metadata else ()
        authored = self._authored(prim, type_name, schemas)
        if traits.is_joint or (traits.may_be_joint and "physics:body1" in authored.names):
            self._add_joint(prim, type_name)
            reason = _PHYSICS
        elif traits.reason is not None or self._is_invisible(prim, traits, authored):
            reason = traits.reason or _INVISIBLE
        # OpenUSD computes bounds of cameras and lights, but not of invisible prims.
        if (traits.is_instancer or reason) and traits.is_imageable and reason != _INVISIBLE:
            reason = ENDLESS if is_endless(prim, self.instancers) else reason
        if authored.is_semantic and self._is_new(prim):
            self.outline.labelled_prims.append(prim)
        if reason is not None:
            self._leave_out((name, reason), parent)
            return None
        record = PrimRecord(self.stage, path, name, type_name, self._kind(metadata), parent, known_prim=prim)
        self._fill(record, traits, authored, schemas)
        if not _RECORDED_METADATA.issuperset(metadata):
            record.metadata = metadata
        record.is_labelled = authored.is_semantic
        record.is_instance = "instanceable" in metadata and prim.IsInstance()
        # Last, so that an exception leaves no incomplete record in the tree.
        parent.children.append(record)
        return record

    def _is_new(self, prim: Any) -> bool:
        """Return whether the prim has not been met in another instance of its prototype."""
        if not prim.IsInstanceProxy():
            return True
        shared = prim.GetPrimInPrototype().GetPath()
        is_new = shared not in self.labelled
        self.labelled.add(shared)
        return is_new

    def _fill(self, record: PrimRecord, traits: _TypeTraits, authored: Authored, schemas: Sequence[str]) -> None:
        record.authored = authored
        record.is_gprim, record.has_points = traits.is_gprim, traits.has_points
        record.is_scope, record.is_instancer = traits.is_scope, traits.is_instancer
        record.is_unresolved = record.path in self.unresolved
        _inherit(record)
        if UsdGeom.Tokens.purpose in authored.names:
            purpose = record.prim.GetAttribute(UsdGeom.Tokens.purpose)
            if purpose and purpose.HasAuthoredValue():
                record.is_hidden = value_of(purpose, Usd.TimeCode.Default()) in _HIDDEN_PURPOSES
        if schemas:
            record.has_mass = "PhysicsMassAPI" in schemas
            record.is_body = "PhysicsRigidBodyAPI" in schemas or (record.has_mass and not record.is_gprim)

    def _authored(self, prim: Any, type_name: str, schemas: tuple[str, ...]) -> Authored:
        names = tuple(prim.GetAuthoredPropertyNames())
        known = self.authored.get((type_name, schemas, names))
        if known is None:
            known = _read_authored(prim, schemas, names)
            self.authored[type_name, schemas, names] = known
            self.outline.has_purpose_bindings |= known.has_purpose_binding
        return known

    def _is_invisible(self, prim: Any, traits: _TypeTraits, authored: Authored) -> bool:
        if not traits.is_imageable or UsdGeom.Tokens.visibility not in authored.names:
            return False
        return bool(read_value(prim, UsdGeom.Tokens.visibility, self.time, str) == UsdGeom.Tokens.invisible)

    def _leave_out(self, child: tuple[str, str], parent: PrimRecord) -> None:
        """Record a child that is pruned, as (name, reason)."""
        name, reason = child
        self.outline.left_out[reason] += 1
        if reason in _FAULTS:
            self.outline.faults[f"{parent.path.rstrip('/')}/{name}"] = reason
        if parent.left_out is None:
            parent.left_out = []
        parent.left_out.append(child)
        parent.has_subsets |= reason == _SUBSET

    def _add_joint(self, prim: Any, type_name: str) -> None:
        self.outline.joint_prims.append(prim)
        fixed, moved = (_first_target(prim, f"physics:body{side}") for side in (0, 1))
        if moved is not None:
            self.outline.joints.append(JointLink(fixed, moved, type_name))

    def _type_traits(self, prim: Any, type_name: str) -> _TypeTraits:
        known = self.traits.get(type_name)
        if known is None:
            known = self.traits[type_name] = _TypeTraits(
                reason=next((why for schema, why in _REASON_BY_SCHEMA if _is_a(prim, schema)), None),
                is_joint=_is_a(prim, "UsdPhysicsJoint"),
                may_be_joint=type_name.endswith("Joint"),
                is_imageable=prim.IsA(UsdGeom.Imageable),
                is_gprim=prim.IsA(UsdGeom.Gprim),
                has_points=prim.IsA(UsdGeom.PointBased) or type_name in ROUND_SOLIDS,
                is_scope=prim.IsA(UsdGeom.Scope),
                is_instancer=prim.IsA(UsdGeom.PointInstancer),
            )
        return known

    def _kind(self, metadata: Mapping[str, Any]) -> str:
        kind = metadata.get("kind", "")
        if kind.__class__ is not str:
            return ""
        if kind not in self.kinds:
            self.kinds[kind] = _standard_kind(kind)
        return self.kinds[kind]

    def _copy_known_contents(self, root: PrimRecord) -> bool:
        """Copy the records below a prim with the same contents; return whether this was possible."""
        if root.is_instance:
            return self._copy_first_instance(root)
        first = self.references.find(root)
        if first is None:
            return False
        root.original = first
        self._copy_contents(first, root)
        return True

    def _copy_contents(self, first: PrimRecord, root: PrimRecord) -> None:
        pending = [(first, root)]
        while pending:
            source, copy = pending.pop()
            for pruned in source.left_out or ():
                self.outline.prim_count += 1
                self._leave_out(pruned, copy)
            for child in source.children:
                self.outline.prim_count += 1
                pending.append((child, _copy_below(child, copy)))

    def _copy_first_instance(self, root: PrimRecord) -> bool:
        """Copy the records below the first instance of the same prototype; return whether this was possible."""
        prototype = root.prim.GetPrototype().GetPath()
        first = self.first_instances.setdefault(prototype, root)
        root.first_instance = first.path
        if first is root or first.is_hidden != root.is_hidden or self._holds_joints(prototype, first):
            return False
        root.twin = first
        self._copy_contents(first, root)
        return True

    def _holds_joints(self, prototype: Any, first: PrimRecord) -> bool:
        if prototype not in self.with_joints:
            reasons = {reason for record in first.walk() for _, reason in record.left_out or ()}
            self.with_joints[prototype] = _PHYSICS in reasons
        return self.with_joints[prototype]


def _copy_below(source: PrimRecord, parent: PrimRecord) -> PrimRecord:
    path = f"{parent.path}/{source.name}"
    record = PrimRecord(source.stage, path, source.name, source.type_name, source.kind, parent)
    record.metadata, record.authored = source.metadata, source.authored
    parent.children.append(record)
    record.is_gprim, record.has_points = source.is_gprim, source.has_points
    record.is_scope, record.is_instancer, record.is_instance = source.is_scope, source.is_instancer, source.is_instance
    record.is_body, record.has_mass = source.is_body, source.has_mass
    record.is_labelled, record.is_unresolved = source.is_labelled, source.is_unresolved
    if parent.original is not None:
        record.original = source
    else:
        record.twin = source.twin or source
    record.first_instance = source.first_instance
    _inherit(record)
    record.is_hidden = source.is_hidden
    return record


def _inherit(record: PrimRecord) -> None:
    parent = record.parent
    assert parent is not None
    record.is_hidden = parent.is_hidden
    record.is_bound = parent.is_bound or record.authored.binds
    record.may_be_turned = parent.may_be_turned or record.authored.turns


def _count_geometry(records: list[PrimRecord]) -> None:
    for record in reversed(records):
        if record.is_gprim or record.is_instancer:
            if record.is_hidden:
                record.hidden_gprim_count += 1
            else:
                record.gprim_count += 1
        if record.parent is not None:
            record.parent.gprim_count += record.gprim_count
            record.parent.hidden_gprim_count += record.hidden_gprim_count


def _first_target(prim: Any, name: str) -> str | None:
    targets = read_targets(prim, name)
    return str(targets[0].GetPrimPath()) if targets else None


def _read_authored(prim: Any, schemas: tuple[str, ...], names: tuple[str, ...]) -> Authored:
    bindings = [name for name in names if name.startswith(_BINDING)]
    return Authored(
        names,
        moves=UsdGeom.Tokens.xformOpOrder in names,
        turns=any(name.startswith(_TURNING_OPS) for name in names),
        binds=bool(bindings),
        has_purpose_binding=bool(set(bindings) - {_BINDING}),
        is_semantic=any(name.lower().startswith("semantic") for name in (*names, *schemas)),
        has_texts=bool(text_names(prim, names)),
    )


def _reason_of(metadata: Mapping[str, Any]) -> str | None:
    if not metadata.get("active", True):
        return "inactive"
    specifier = metadata.get("specifier", Sdf.SpecifierOver)
    if specifier == Sdf.SpecifierDef:
        return None
    return "abstract" if specifier == Sdf.SpecifierClass else "over without definition"


def _standard_kind(kind: str) -> str:
    for base in (Kind.Tokens.component, Kind.Tokens.subcomponent, Kind.Tokens.assembly, Kind.Tokens.group):
        # Studios derive custom kinds, such as "prop" from "component".
        if Kind.Registry.IsA(kind, base):
            return str(base)
    return kind


def _is_a(prim: Any, schema: str) -> bool:
    schema_type = Tf.Type.FindByName(schema)
    return bool(schema_type) and prim.IsA(schema_type)


def paths_above_endless(outline: Outline) -> frozenset[str]:
    """Return the paths of prims with a point instancer at or below them that contains itself."""
    if not outline.left_out[ENDLESS]:
        return frozenset()
    endless = (Sdf.Path(path) for path, reason in outline.faults.items() if reason == ENDLESS)
    return frozenset(prefix.pathString for path in endless for prefix in path.GetPrefixes())
