"""read_graph_scene: scene, grounding and relations as a graph that usd2kg wrote states them."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, get_args

import pyoxigraph as ox

from usd2kg.diff import GraphStyle, ObjectState, detect_graph_style, objects_of_graph
from usd2kg.diff.graph_states import as_vector
from usd2kg.errors import GraphError
from usd2kg.garbage import paused_collection
from usd2kg.graph.iris import individual_iri
from usd2kg.graph.literal_numbers import parse_numbers
from usd2kg.graph.rdf_document import read_statements
from usd2kg.graph.vocabulary import OWL, RDF, RDFS, U2K, USD
from usd2kg.grounding import Grounding
from usd2kg.prim_paths import nearest_in
from usd2kg.relations import Relation
from usd2kg.scene import Box, ObjectLabels, Scene, SceneObject, StageFrame
from usd2kg.scene.model import Encoding, Label
from usd2kg.studio.graph_grounding import read_stated_grounding
from usd2kg.studio.graph_index import GraphIndex
from usd2kg.studio.graph_relations import relations_of_graph

__all__ = ["GraphScene", "read_graph_scene"]

Vector = tuple[float, float, float]
_ENCODINGS: Mapping[str, Encoding] = {name: name for name in get_args(Encoding)}


@dataclass(frozen=True)
class GraphScene:
    """What a graph says about a scene."""

    statements: tuple[ox.Triple, ...]
    """In the order of the file."""
    style: GraphStyle
    iri: str
    """IRI of the owl:Ontology that the graph is; empty if it has none."""
    imports: tuple[str, ...]
    base: str
    """Namespace of the individuals."""
    scene: Scene
    """Objects by prim path; what a graph does not state, such as parts, is empty."""
    grounding: Grounding
    relations: tuple[Relation, ...]
    stage_name: str
    """File name of the stage; empty if the graph does not state it."""


def read_graph_scene(path: Path) -> GraphScene:
    """Return what a graph file says.

    Raises:
        GraphError: the file cannot be read, or describes no scene, or several.
    """
    with paused_collection():
        return _read(path, read_statements(path))


def _read(path: Path, statements: tuple[ox.Triple, ...]) -> GraphScene:
    stated = objects_of_graph(statements, str(path))
    style = detect_graph_style(statements)
    index = GraphIndex(statements)
    stage = next((node for node, _ in index.subjects_of(U2K.metresPerUnit)), None)
    header = next(
        (node for node, _ in index.subjects_of(U2K.run) if OWL.Ontology in index.values(node, RDF.type)), None
    )
    scene = _read_scene(path, index, stage, stated)
    return GraphScene(
        statements=statements,
        style=style,
        iri=header.value if isinstance(header, ox.NamedNode) else "",
        imports=index.texts(header, OWL.imports),
        base=style.base or _find_base(stated[0], path),
        scene=scene,
        grounding=read_stated_grounding(index, scene, stated),
        relations=tuple(relations_of_graph(index)),
        stage_name=index.text(stage, RDFS.label),
    )


def _find_base(stated: ObjectState, path: Path) -> str:
    """Return the namespace of the individuals, from the IRI of an object."""
    name = individual_iri("", stated.prim_path)
    if not stated.iri.endswith(name):
        raise GraphError(
            f"{path}: <{stated.iri}> is not how usd2kg names {stated.prim_path}; expected a graph it wrote"
        )
    return stated.iri.removesuffix(name)


def _read_scene(path: Path, index: GraphIndex, stage: Any, stated: Sequence[ObjectState]) -> Scene:
    metres = parse_numbers(index.text(stage, U2K.metresPerUnit))
    time = parse_numbers(index.text(stage, U2K.timeCode))
    known = {each.prim_path for each in stated}
    return Scene(
        source=str(path),
        content_hash=index.text(stage, U2K.contentHash),
        frame=StageFrame(
            up_axis=index.text(stage, U2K.upAxis) or "Z",
            metres_per_unit=metres[0] if metres else 1.0,
            kilograms_per_unit=1.0,
            is_authored=True,
        ),
        time=time[0] if time else None,
        # A graph does not state how many prims are not objects.
        prim_count=len(stated),
        objects=tuple(_read_object(each, index, _parent_in(known, each.prim_path)) for each in stated),
        left_out={},
    )


def _read_object(stated: ObjectState, index: GraphIndex, parent: str | None) -> SceneObject:
    node = ox.NamedNode(stated.iri)
    label = index.text(node, RDFS.label)
    return SceneObject(
        prim_path=stated.prim_path,
        name=stated.name,
        type_name="",
        kind="",
        selected_by="stated in the graph",
        parent_path=parent,
        box=_box(stated),
        own_box=None,
        part_boxes=(),
        position=stated.position,
        orientation=stated.orientation,
        mass_kg=stated.mass_kg,
        display_name="" if label == stated.name else label,
        documentation=index.text(node, RDFS.comment),
        asset=index.texts(node, U2K.asset),
        materials=index.texts(node, U2K.material),
        parts=(),
        display_color=_color(index, node),
        instance_of=None,
        oriented_size=as_vector(parse_numbers(index.text(node, U2K.orientedSize))),
        labels=ObjectLabels(tuple(_labels(index, node, stated.prim_path)), (), ()),
    )


def _box(stated: ObjectState) -> Box | None:
    """Return the world box; None if the graph states no valid one."""
    if stated.center is None or stated.box_size is None or min(stated.box_size) < 0:
        return None
    (x, y, z), (width, depth, height) = stated.center, stated.box_size
    return Box(
        (x - width / 2, y - depth / 2, z - height / 2),
        (x + width / 2, y + depth / 2, z + height / 2),
    )


def _parent_in(paths: set[str], prim_path: str) -> str | None:
    """Return the nearest path above an object that is an object, too."""
    return nearest_in(prim_path.rpartition("/")[0], paths)


def _color(index: GraphIndex, node: ox.NamedNode) -> Vector | None:
    """Return the linear RGB of an object in u2k or USD.owl terms; None if it has none."""
    qualities = index.values(node, USD.hasColor)
    text = index.text(node, U2K.color) or next(
        (index.text(quality, USD.primvars_displayColor) for quality in qualities), ""
    )
    found = as_vector(parse_numbers(text.strip("[]").replace(",", " ")))
    return found if found is not None and all(0 <= value <= 1 for value in found) else None


def _labels(index: GraphIndex, node: ox.NamedNode, prim_path: str) -> Iterable[Label]:
    """Yield the semantic labels that were authored for an object."""
    for value in index.values(node, U2K.sceneLabel):
        about = index.annotation((node, U2K.sceneLabel, value))
        encoding = _ENCODINGS.get(index.text(about, U2K.labelEncoding))
        if encoding is not None:
            source = index.text(about, U2K.labelledPrim) or prim_path
            taxonomy = index.text(about, U2K.labelTaxonomy)
            yield Label(source, encoding, taxonomy, str(value.value), is_inherited=source != prim_path)
