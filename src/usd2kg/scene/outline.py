"""The stage as a plain tree of outline records: just what choosing the objects and reading them needs."""

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, NamedTuple

__all__ = ["NOTHING_AUTHORED", "Authored", "JointLink", "Outline", "PrimRecord"]


class JointLink(NamedTuple):
    """Which body a joint moves against which."""

    body0: str | None
    """None for the world."""
    body1: str
    type_name: str


class Authored(NamedTuple):
    """What the names of a prim's authored properties say; prims with the same schemas and names share one."""

    names: tuple[str, ...]
    moves: bool
    """Whether a transform is authored."""
    turns: bool
    """Whether a transform may turn the prim against its parent."""
    binds: bool
    """Whether a material is bound."""
    has_purpose_binding: bool
    """Whether one is bound for one purpose only, or to a collection."""
    is_semantic: bool
    has_texts: bool
    """Whether there are some beyond the schemas', which may carry words."""


_NO_METADATA: Mapping[str, Any] = MappingProxyType({})
NOTHING_AUTHORED = Authored(
    (), moves=False, turns=False, binds=False, has_purpose_binding=False, is_semantic=False, has_texts=False
)


@dataclass(slots=True)
class PrimRecord:
    """One prim that is, holds or groups geometry."""

    stage: Any
    path: str
    name: str
    type_name: str
    kind: str
    parent: "PrimRecord | None"
    metadata: Mapping[str, Any] = field(default_factory=lambda: _NO_METADATA)
    """The authored metadata, composition arcs left out."""
    authored: Authored = NOTHING_AUTHORED
    children: list["PrimRecord"] = field(default_factory=list)
    is_gprim: bool = False
    has_points: bool = False
    """Whether it can be measured by points: its own, or those of a round solid's surface."""
    is_scope: bool = False
    is_body: bool = False
    """Carries UsdPhysics' RigidBodyAPI, or a mass of its own without being geometry."""
    has_mass: bool = False
    """Carries UsdPhysics' MassAPI."""
    is_instance: bool = False
    is_instancer: bool = False
    is_hidden: bool = False
    """Of guide or proxy purpose, by itself or from above."""
    is_unresolved: bool = False
    """A reference or payload at or below it could not be opened."""
    is_labelled: bool = False
    """Something semantic is authored on it."""
    may_be_turned: bool = False
    """Whether a transform at or above it may turn it against the world's axes."""
    is_bound: bool = False
    """Whether a material is bound at or above it."""
    has_subsets: bool = False
    left_out: list[tuple[str, str]] | None = None
    """(name, reason) of the prims right below that were not entered; None if there are none."""
    twin: "PrimRecord | None" = None
    """The same prim in the first instance of the same prototype; None outside of instances and in the first one."""
    first_instance: str | None = None
    """Of an instance, the path of the first one of the same prototype."""
    gprim_count: int = 0
    """Visible geometry prims at and below it, in default or render purpose."""
    hidden_gprim_count: int = 0
    """The same for guide and proxy purpose."""
    known_prim: Any = None
    known_as_asset: bool | None = None

    @property
    def prim(self) -> Any:
        """The prim, looked up when it is first asked for."""
        if self.known_prim is None:
            self.known_prim = self.stage.GetPrimAtPath(self.path)
        return self.known_prim

    @property
    def is_asset(self) -> bool:
        """Whether it brings in a reference or payload, or is an instance; looked up when it is first asked for."""
        if self.known_as_asset is None:
            prim = (self.twin or self).prim
            self.known_as_asset = self.is_instance or prim.HasAuthoredReferences() or prim.HasAuthoredPayloads()
        return self.known_as_asset

    @property
    def may_have_asset(self) -> bool:
        """Whether the stage may name an asset that it comes from."""
        return "assetInfo" in self.metadata or self.is_asset

    @property
    def may_have_texts(self) -> bool:
        """Whether somebody may have written words on it, beyond the schemas."""
        return self.authored.has_texts or "customData" in self.metadata or "assetInfo" in self.metadata

    def walk(self) -> Iterator["PrimRecord"]:
        """Yield this record and all below it, parents first."""
        pending = [self]
        while pending:
            record = pending.pop()
            yield record
            if record.children:
                pending.extend(reversed(record.children))


@dataclass(slots=True)
class Outline:
    """The record tree, and what was not entered into it.

    As a context manager it lets go of the stage at the end, though its records refer to each other: a stage that is
    still held is not read again from a file that has changed.
    """

    root: PrimRecord
    """The pseudo-root."""
    records: list[PrimRecord] = field(default_factory=list)
    """All records below it, parents first."""
    left_out: Counter[str] = field(default_factory=Counter)
    """Reason → number of prims."""
    pruned: dict[str, str] = field(default_factory=dict)
    """Path of a prim that was not entered → the reason."""
    prim_count: int = 0
    joints: list[JointLink] = field(default_factory=list)
    """What the joints connect, in traversal order."""
    joint_prims: list[Any] = field(default_factory=list)
    """The joints, in traversal order."""
    labelled_prims: list[Any] = field(default_factory=list)
    """Prims on which something semantic is authored, in traversal order; what instances share is there once."""
    has_purpose_bindings: bool = False
    """Whether a material is bound for one purpose only, or to a collection, anywhere."""

    def __enter__(self) -> "Outline":
        return self

    def __exit__(self, *_: object) -> None:
        for record in self.records:
            record.parent = None
