"""The two versions of a scene to compare, each a graph or a stage."""

from collections.abc import Callable, Iterable, Iterator, Set
from pathlib import Path
from typing import NamedTuple

import pyoxigraph as ox

from usd2kg.convert import is_stage
from usd2kg.diff.graph_states import GraphStyle, detect_graph_style, objects_of_graph
from usd2kg.diff.object_state import ObjectState, objects_of_scene
from usd2kg.graph import GraphOptions, instantiate
from usd2kg.graph.iris import default_base
from usd2kg.graph.rdf_document import read_statements
from usd2kg.graph.vocabulary import OWL
from usd2kg.grounding import ground
from usd2kg.ontology import TBox
from usd2kg.relations import ALL_KINDS, DEFAULT_KINDS, VIEWPOINT_KINDS, RelationOptions, find_relations
from usd2kg.scene import ReadOptions, Scene, read_scene

__all__ = ["Version", "VersionOptions", "read_objects", "read_versions"]


class Version(NamedTuple):
    """A scene at one time."""

    statements: frozenset[ox.Triple]
    objects: tuple[ObjectState, ...]
    style: GraphStyle


class VersionOptions(NamedTuple):
    """Options for building the graph of a stage for a comparison."""

    reading: ReadOptions
    kinds: Set[str] = frozenset()
    """Kinds of relations to find in addition to the default ones; those that need a viewpoint are not found."""
    base: str | None = None
    """Namespace of the individuals; None for that of the other version or, without one, derived from the old file."""
    is_grounded: bool = True


def read_objects(path: Path, options: ReadOptions) -> tuple[ObjectState, ...]:
    """Return the objects of a graph or a stage; those of a stage have no classes.

    Raises:
        Usd2kgError: the file cannot be read.
    """
    if is_stage(path):
        return objects_of_scene(read_scene(path, options=options))
    return objects_of_graph(read_statements(path), str(path))


def read_versions(
    old: Path, new: Path, open_tbox: Callable[[Iterable[Scene], Iterable[str]], TBox], options: VersionOptions
) -> tuple[Version, Version]:
    """Return both versions; the graph of a stage is built with base, profile and annotations of the other graph.

    Args:
        old: the earlier version.
        new: the later version.
        open_tbox: returns the TBox for stages, and for the classes and imports that the other graph states; called
            only if one of the versions is a stage.
        options: options for building the graph of a stage.

    Raises:
        Usd2kgError: a file cannot be read.
    """
    graphs = {path: _version(frozenset(read_statements(path)), path) for path in (old, new) if not is_stage(path)}
    style = next((version.style for version in graphs.values()), GraphStyle(None, "auto", "owl"))
    style = style._replace(base=options.base or style.base or default_base(str(old)))
    if graphs.keys() == {old, new}:
        return graphs[old], graphs[new]
    scenes = {path: read_scene(path, options=options.reading) for path in (old, new) if path not in graphs}
    # Ground both versions in the same TBox; otherwise, classes would appear as changes.
    tbox = open_tbox(scenes.values(), {iri for version in graphs.values() for iri in _stated_in(version)})
    before, after = (graphs.get(path) or _build(path, scenes[path], tbox, style, options) for path in (old, new))
    return before, after


def _stated_in(version: Version) -> Iterator[str]:
    """Yield the classes of the objects and the imports of a graph."""
    for thing in version.objects:
        yield from thing.classes
    for statement in version.statements:
        if statement.predicate == OWL.imports and isinstance(statement.object, ox.NamedNode):
            yield statement.object.value


def _build(path: Path, scene: Scene, tbox: TBox, style: GraphStyle, options: VersionOptions) -> Version:
    grounding = ground(scene, tbox) if options.is_grounded else ground(scene, tbox, "dictionary", paths=())
    wanted = {*DEFAULT_KINDS, *options.kinds} - {*VIEWPOINT_KINDS}
    kinds = tuple(kind for kind in ALL_KINDS if kind in wanted)
    graph = instantiate(
        scene,
        tbox,
        grounding,
        base=style.base,
        profile=style.profile,
        options=GraphOptions(annotations=style.annotations),
        relations=find_relations(scene, tbox, grounding, RelationOptions(kinds=kinds)),
    )
    return _version(frozenset(graph.triples), path)


def _version(statements: frozenset[ox.Triple], path: Path) -> Version:
    return Version(statements, objects_of_graph(statements, str(path)), detect_graph_style(statements))
