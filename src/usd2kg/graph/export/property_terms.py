"""Mapping of RDF properties of both profiles to edges and properties of a property graph."""

from usd2kg.graph.relation_patterns import KIND_OF_PROPERTY
from usd2kg.graph.vocabulary import DUL, OWL, RDFS, SKOS, SOMA, U2K, USD

__all__ = ["EDGES", "EDGE_NUMBERS", "NUMBERS", "OBJECT_CLASSES", "PARTS", "SYMMETRIC", "TEXTS", "VECTORS"]

OBJECT_CLASSES = frozenset({USD.Prim, U2K.Object, OWL.NamedIndividual})
"""Generic classes of every object, which do not become node labels."""
SYMMETRIC = frozenset({"TOUCHING", "NEXT_TO", "NEAR"})
"""Edge types of symmetric relations."""

_EDGE_TYPES = {"left": "LEFT_OF", "right": "RIGHT_OF", "front": "IN_FRONT_OF", "room": "IN_ROOM"}
EDGES = {
    **{
        name: _EDGE_TYPES.get(kind, kind.upper().replace("-", "_"))
        for name, kind in KIND_OF_PROPERTY.items()
        if name != SOMA.isSupportedBy
    },
    U2K.hasJoint: "HAS_JOINT",
    SOMA.hasParentLink: "PARENT",
    U2K.parentObject: "PARENT",
    SOMA.hasChildLink: "CHILD",
    U2K.childObject: "CHILD",
}
"""Property → edge type, in the same direction."""

TEXTS = {
    U2K.asset: "asset",
    U2K.material: "material",
    U2K.variant: "variant",
    U2K.sceneLabel: "sceneLabel",
    U2K.text: "text",
    SKOS.altLabel: "primName",
    RDFS.comment: "documentation",
    U2K.meshFile: "meshFile",
    SOMA.hasFilePath: "meshFile",
    U2K.colorSource: "colorSource",
    U2K.status: "status",
    U2K.explanation: "explanation",
}
"""RDF property → text property."""
NUMBERS = {
    U2K.width: "width",
    # As KnowRob, SOMA's depth is along x and its width along y (ROS REP 103), see `physical_properties`.
    SOMA.hasDepth: "width",
    U2K.depth: "depth",
    SOMA.hasWidth: "depth",
    U2K.height: "height",
    SOMA.hasHeight: "height",
    U2K.mass: "mass",
    SOMA.hasMassValue: "mass",
    U2K.copies: "copies",
    U2K.lowerLimit: "lowerLimit",
    SOMA.hasJointPositionMin: "lowerLimit",
    U2K.upperLimit: "upperLimit",
    SOMA.hasJointPositionMax: "upperLimit",
    U2K.jointPosition: "jointPosition",
    SOMA.hasJointPosition: "jointPosition",
    U2K.isEnabled: "isEnabled",
    U2K.closesLoop: "closesLoop",
}
"""RDF property → number or Boolean property."""
_POSITION, _ORIENTATION = ("x", "y", "z"), ("qx", "qy", "qz", "qw")
VECTORS = {
    U2K.boxCenter: ("centerX", "centerY", "centerZ"),
    U2K.position: _POSITION,
    U2K.orientation: _ORIENTATION,
    SOMA.hasPositionData: (*_POSITION, *_ORIENTATION),
    U2K.color: ("red", "green", "blue"),
    SOMA.hasRGBValue: ("red", "green", "blue"),
    U2K.centerOfMass: ("massCenterX", "massCenterY", "massCenterZ"),
    U2K.orientedSize: ("sizeX", "sizeY", "sizeZ"),
    U2K.jointAxis: ("axisX", "axisY", "axisZ"),
    U2K.jointOrigin: ("originX", "originY", "originZ"),
}
"""RDF property with a vector literal → number properties of its components."""
PARTS = (
    SOMA.hasShape,
    SOMA.hasLocalization,
    SOMA.hasMassAttribute,
    SOMA.hasColor,
    USD.hasColor,
    SOMA.hasJointLimit,
    SOMA.hasJointState,
    DUL.hasRegion,
)
"""Properties from an object to its quality nodes and their regions."""
EDGE_NUMBERS = ("gap", "distance", "overlapRatio", "insideRatio", "betweenRatio", "angle", "margin")
"""Measurements of relations."""
