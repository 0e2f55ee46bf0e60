"""OtherVersion: what a scene is compared with, another stage, a graph, or a mapping of the same scene."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path

from usd2kg.convert import is_stage
from usd2kg.diff import Link, ObjectState, objects_of_scene
from usd2kg.grounding import ground, make_grounder
from usd2kg.ontology import TBox
from usd2kg.relations import SYMMETRIC_KINDS, Relation, find_relations
from usd2kg.scene import Scene, read_scene
from usd2kg.studio.class_claims import ClassClaim, claim_of, read_claims
from usd2kg.studio.graph_scene import read_graph_scene
from usd2kg.studio.open_session import is_graph
from usd2kg.studio.project import ProjectSources

__all__ = ["OtherVersion", "VersionSource", "compared_states", "read_other_version"]


class VersionSource(StrEnum):
    """Where a version comes from."""

    STAGE = "stage"
    """Read and grounded as the scene."""
    GRAPH = "graph"
    MAPPING = "mapping"
    """The same scene with other classes."""


@dataclass(frozen=True)
class OtherVersion:
    """The earlier version, or the other opinion."""

    path: Path
    source: VersionSource
    claims: Mapping[str, ClassClaim]
    """Prim path → class; a mapping need not have all objects."""
    objects: Sequence[ObjectState] = ()
    """With classes and relations; empty for a mapping, which has no objects of its own."""


def read_other_version(path: Path, sources: ProjectSources, tbox: TBox) -> OtherVersion:
    """Return the version in a file; a stage is grounded by the lexical grounder.

    Args:
        path: stage, graph, or mapping.
        sources: options with which a stage is read.
        tbox: the classes.

    Raises:
        Usd2kgError: the file cannot be read.
    """
    if is_stage(path):
        scene = read_scene(path, options=sources.reading)
        grounding = ground(scene, tbox, make_grounder("lexical", alignment=sources.alignment))
        relations: Iterable[Relation] = find_relations(scene, tbox, grounding)
        source = VersionSource.STAGE
    elif is_graph(path):
        read = read_graph_scene(path)
        scene, grounding, relations, source = read.scene, read.grounding, read.relations, VersionSource.GRAPH
    else:
        return OtherVersion(path, VersionSource.MAPPING, read_claims(path, tbox))
    claims = {p.prim_path: claim_of(p, tbox) for p in grounding.predictions}
    return OtherVersion(path, source, claims, compared_states(scene, claims, relations))


def compared_states(
    scene: Scene, claims: Mapping[str, ClassClaim], relations: Iterable[Relation]
) -> tuple[ObjectState, ...]:
    """Return the objects of a scene with classes and relations, to be compared."""
    links: dict[str, set[Link]] = {}
    for relation in relations:
        links.setdefault(relation.target, set()).add(Link(relation.kind, relation.anchor))
        if relation.kind in SYMMETRIC_KINDS:
            links.setdefault(relation.anchor, set()).add(Link(relation.kind, relation.target))
    found = []
    for state in objects_of_scene(scene):
        claim = claims.get(state.prim_path)
        found.append(
            replace(
                state,
                classes=(claim.class_iri,) if claim is not None and claim.class_iri is not None else (),
                class_label=claim.label if claim is not None else "",
                links=frozenset(links.get(state.prim_path, ())),
            )
        )
    return tuple(found)
