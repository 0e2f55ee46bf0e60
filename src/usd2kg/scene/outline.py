"""Outline: the prims of a stage as a tree of records, with what object selection and reading need."""

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, NamedTuple

__all__ = ["NOTHING_AUTHORED", "Authored", "JointLink", "Outline", "PrimRecord"]


class JointLink(NamedTuple):
    """The bodies of a joint."""

    body0: str | None
    """None for the world."""
    body1: str
    type_name: str


class Authored(NamedTuple):
    """Facts derived from the names of a prim's authored properties; shared by prims with the same schemas and names."""

    names: tuple[str, ...]
    moves: bool
    """Whether a transform is authored."""
    turns: bool
    """Whether a transform may rotate the prim relative to its parent."""
    binds: bool
    """Whether a material is bound."""
    has_purpose_binding: bool
    """Whether a material is bound for a single purpose, or to a collection."""
    is_semantic: bool
    """Whether a semantic property or schema is authored."""
    has_texts: bool
    """Whether properties outside of schemas may hold free text."""


_NO_METADATA: Mapping[str, Any] = MappingProxyType({})
NOTHING_AUTHORED = Authored(
    (), moves=False, turns=False, binds=False, has_purpose_binding=False, is_semantic=False, has_texts=False
)


@dataclass(slots=True)
class PrimRecord:
    """One prim that was not pruned."""

    stage: Any
    path: str
    name: str
    type_name: str
    kind: str
    parent: "PrimRecord | None"
    metadata: Mapping[str, Any] = field(default_factory=lambda: _NO_METADATA)
    """The authored metadata, without composition arcs."""
    authored: Authored = NOTHING_AUTHORED
    children: list["PrimRecord"] = field(default_factory=list)
    is_gprim: bool = False
    has_points: bool = False
    """Whether it has points, or is a round solid whose surface has points."""
    is_scope: bool = False
    is_body: bool = False
    """Whether it has UsdPhysics' RigidBodyAPI, or MassAPI without being a gprim."""
    has_mass: bool = False
    """Whether it has UsdPhysics' MassAPI."""
    is_instance: bool = False
    is_instancer: bool = False
    is_hidden: bool = False
    """Whether its own or inherited purpose is guide or proxy."""
    is_unresolved: bool = False
    """Whether a reference or payload at or below it could not be opened."""
    is_labelled: bool = False
    """Whether a semantic property or schema is authored on it."""
    may_be_turned: bool = False
    """Whether a transform at or above it may rotate it against the world axes."""
    is_bound: bool = False
    """Whether a material is bound at or above it."""
    has_subsets: bool = False
    left_out: list[tuple[str, str]] | None = None
    """(name, reason) of the child prims that were pruned; None if there are none."""
    twin: "PrimRecord | None" = None
    """The same prim in the first instance of the prototype; None outside of instances and in the first instance."""
    original: "PrimRecord | None" = None
    """The same prim below an equal reference that came first, with equal values; for the reference itself, only what is
    below is equal. None for other prims."""
    first_instance: str | None = None
    """For an instance, the path of the first instance of the prototype."""
    gprim_count: int = 0
    """Visible gprims and point instancers at and below it with default or render purpose."""
    hidden_gprim_count: int = 0
    """Gprims and point instancers at and below it with guide or proxy purpose."""
    known_prim: Any = None
    known_as_asset: bool | None = None

    @property
    def prim(self) -> Any:
        """The prim, looked up on first use."""
        if self.known_prim is None:
            self.known_prim = self.stage.GetPrimAtPath(self.path)
        return self.known_prim

    @property
    def is_asset(self) -> bool:
        """Whether it has a reference or payload, or is an instance; looked up on first use."""
        if self.known_as_asset is None:
            prim = (self.twin or self.original or self).prim
            self.known_as_asset = self.is_instance or prim.HasAuthoredReferences() or prim.HasAuthoredPayloads()
        return self.known_as_asset

    @property
    def source(self) -> "PrimRecord":
        """The prim whose geometry is read for it: equal geometry is read once."""
        return self.twin or self.original or self

    @property
    def may_have_asset(self) -> bool:
        """Whether it may have an asset name or an asset file."""
        return "assetInfo" in self.metadata or self.is_asset

    @property
    def may_have_texts(self) -> bool:
        """Whether it may have free text outside of schemas."""
        return self.authored.has_texts or "customData" in self.metadata or "assetInfo" in self.metadata

    def walk(self) -> Iterator["PrimRecord"]:
        """Yield this prim and all prims below it, parents first."""
        pending = [self]
        while pending:
            record = pending.pop()
            yield record
            if record.children:
                pending.extend(reversed(record.children))


@dataclass(slots=True)
class Outline:
    """The tree of records, with counts and reasons of pruned prims.

    As a context manager, it breaks the reference cycles between records on exit, which releases the stage: while a
    stage is in use, OpenUSD returns its cached layers even if the file has changed.
    """

    root: PrimRecord
    """The pseudo-root."""
    records: list[PrimRecord] = field(default_factory=list)
    """All records below the root, parents first."""
    left_out: Counter[str] = field(default_factory=Counter)
    """Reason → number of prims."""
    faults: dict[str, str] = field(default_factory=dict)
    """Path of a prim that was pruned for a fault of the stage → reason, in traversal order."""
    prim_count: int = 0
    joints: list[JointLink] = field(default_factory=list)
    """The bodies of the joints, in traversal order."""
    joint_prims: list[Any] = field(default_factory=list)
    """The joint prims, in traversal order."""
    labelled_prims: list[Any] = field(default_factory=list)
    """Prims with semantic properties or schemas, in traversal order; prims shared by instances only once."""
    has_purpose_bindings: bool = False
    """Whether any material is bound for a single purpose, or to a collection."""

    @property
    def pruned(self) -> dict[str, str]:
        """Path of each pruned prim → reason; made anew on each access."""
        return {
            f"{record.path.rstrip('/')}/{name}": reason
            for record in (self.root, *self.records)
            for name, reason in record.left_out or ()
        }

    def __enter__(self) -> "Outline":
        return self

    def __exit__(self, *_: object) -> None:
        for record in self.records:
            record.parent = None
