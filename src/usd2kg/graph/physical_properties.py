"""Size, pose and mass of objects: as quality nodes with regions (SOMA), or as datatype properties (u2k).

SOMA: hasShape → Shape → hasRegion → BoxShape, with hasLength and hasDepth for KnowRob; a geometry file is a second
region, a MeshShape. Each quality node belongs to one object, since a shared quality makes the graph inconsistent.
"""

from collections.abc import Iterator

import pyoxigraph as ox

from usd2kg.graph.vocabulary import DUL, OWL, RDF, SOMA, U2K, Triple, number, text, vector_text
from usd2kg.scene import Box, SceneObject

__all__ = ["aspect_node", "declare_individual", "plain_properties", "shared_properties", "soma_properties"]

_REFERENCE_FRAME = "world"


def aspect_node(node: ox.NamedNode, part: str) -> ox.NamedNode:
    """Return the node of a quality, region or attribute of an object: shape, box, pose…"""
    return ox.NamedNode(f"{node.value}-{part}")


def declare_individual(node: ox.NamedNode, cls: ox.NamedNode) -> Iterator[Triple]:
    """Yield the declaration and type of a named individual."""
    yield node, RDF.type, OWL.NamedIndividual
    yield node, RDF.type, cls


def shared_properties(obj: SceneObject, node: ox.NamedNode) -> Iterator[Triple]:
    """Yield the properties that all profiles share: centre of mass, oriented size, shell, number of copies."""
    if obj.center_of_mass is not None:
        yield node, U2K.centerOfMass, text(vector_text(obj.center_of_mass))
    if obj.oriented_size is not None:
        yield node, U2K.orientedSize, text(vector_text(obj.oriented_size))
    if obj.shell_boxes:
        boxes = "; ".join(vector_text((*box.lower, *box.upper)) for box in obj.shell_boxes)
        yield node, U2K.shellBoxes, text(boxes)
    if obj.instances is not None:
        yield node, U2K.copies, number(obj.instances.count, "integer")


def plain_properties(obj: SceneObject, node: ox.NamedNode) -> Iterator[Triple]:
    """Yield size, pose and mass as datatype properties of the object."""
    if obj.box is not None:
        width, depth, height = obj.box.size
        yield node, U2K.width, number(width)
        yield node, U2K.depth, number(depth)
        yield node, U2K.height, number(height)
        yield node, U2K.boxCenter, text(vector_text(obj.box.center))
    if obj.geometry_file:
        yield node, U2K.meshFile, text(obj.geometry_file)
    if obj.position is not None:
        yield node, U2K.position, text(vector_text(obj.position))
    if obj.orientation is not None:
        yield node, U2K.orientation, text(vector_text(obj.orientation))
    if obj.mass_kg is not None:
        yield node, U2K.mass, number(obj.mass_kg)


def soma_properties(obj: SceneObject, node: ox.NamedNode) -> Iterator[Triple]:
    """Yield size, pose and mass as quality nodes."""
    if obj.box is not None or obj.geometry_file:
        yield from _shape(node, obj.box, obj.geometry_file)
    if obj.position is not None and obj.orientation is not None:
        yield from _pose(node, (*obj.position, *obj.orientation))
    if obj.mass_kg is not None:
        mass = aspect_node(node, "mass")
        yield node, SOMA.hasMassAttribute, mass
        yield from declare_individual(mass, SOMA.MassAttribute)
        yield mass, SOMA.hasMassValue, number(obj.mass_kg)


def _shape(node: ox.NamedNode, box: Box | None, file: str) -> Iterator[Triple]:
    shape = aspect_node(node, "shape")
    yield node, SOMA.hasShape, shape
    yield from declare_individual(shape, SOMA.Shape)
    regions = [name for name, is_known in (("box", box is not None), ("mesh", bool(file))) if is_known]
    for name in regions:
        yield shape, DUL.hasRegion, aspect_node(node, name)
    if box is not None:
        yield from _box(aspect_node(node, "box"), box)
    if file:
        mesh = aspect_node(node, "mesh")
        yield from declare_individual(mesh, SOMA.MeshShape)
        yield mesh, SOMA.hasFilePath, text(file)


def _box(region: ox.NamedNode, box: Box) -> Iterator[Triple]:
    # KnowRob's object_dimensions follows ROS REP 103: x forward, y left.
    along_x, along_y, along_z = box.size
    yield from declare_individual(region, SOMA.BoxShape)
    yield region, SOMA.hasWidth, number(along_y, "float")
    yield region, SOMA.hasLength, number(along_x, "float")
    yield region, SOMA.hasDepth, number(along_x, "float")
    yield region, SOMA.hasHeight, number(along_z, "float")
    yield region, U2K.boxCenter, text(vector_text(box.center))


def _pose(node: ox.NamedNode, pose: tuple[float, ...]) -> Iterator[Triple]:
    place, region = aspect_node(node, "place"), aspect_node(node, "pose")
    yield node, SOMA.hasLocalization, place
    yield from declare_individual(place, SOMA.Localization)
    yield place, DUL.hasRegion, region
    yield from declare_individual(region, SOMA["6DPose"])
    yield region, SOMA.hasPositionData, text(vector_text(pose))
    yield region, SOMA.hasReferenceFrame, text(_REFERENCE_FRAME)
