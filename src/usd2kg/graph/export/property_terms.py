"""What each RDF property becomes in a property graph, in both profiles."""

from usd2kg.graph.vocabulary import DUL, KNOWROB, OWL, RDFS, SKOS, SOMA, U2K, USD

__all__ = ["EDGES", "EDGE_NUMBERS", "NUMBERS", "OBJECT_CLASSES", "PARTS", "SYMMETRIC", "TEXTS", "VECTORS"]

OBJECT_CLASSES = frozenset({USD.Prim, U2K.Object, OWL.NamedIndividual})
"""What every object is: no label says so but `Object`."""
SYMMETRIC = frozenset({"TOUCHING", "NEXT_TO", "NEAR"})
"""Types of edges that hold both ways; each is one edge."""

EDGES = {
    SOMA.isOntopOf: "ON",
    U2K.on: "ON",
    SOMA.isInsideOf: "INSIDE",
    U2K.inside: "INSIDE",
    KNOWROB.isAboveOf: "ABOVE",
    U2K.above: "ABOVE",
    KNOWROB.isBelowOf: "BELOW",
    U2K.below: "BELOW",
    DUL.hasCommonBoundary: "TOUCHING",
    U2K.touching: "TOUCHING",
    KNOWROB.isNextTo: "NEXT_TO",
    U2K.nextTo: "NEXT_TO",
    DUL.nearTo: "NEAR",
    U2K.near: "NEAR",
    KNOWROB.isLeftOf: "LEFT_OF",
    U2K.leftOf: "LEFT_OF",
    KNOWROB.isRightOf: "RIGHT_OF",
    U2K.rightOf: "RIGHT_OF",
    KNOWROB.isInFrontOf: "IN_FRONT_OF",
    U2K.inFrontOf: "IN_FRONT_OF",
    KNOWROB.isBehindOf: "BEHIND",
    U2K.behind: "BEHIND",
    U2K.inRoom: "IN_ROOM",
    U2K.partOf: "PART_OF",
    U2K.hasJoint: "HAS_JOINT",
    SOMA.hasParentLink: "PARENT",
    U2K.parentObject: "PARENT",
    SOMA.hasChildLink: "CHILD",
    U2K.childObject: "CHILD",
}
"""Property → type of edge, in the same direction."""

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
"""Property → the property of the node, text."""
NUMBERS = {
    U2K.width: "width",
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
"""Property → the property of the node, a number or truth value."""
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
"""Property with several numbers as text → the properties that they become."""
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
"""Properties that lead from an object to the nodes that say how large it is, where, how heavy."""
EDGE_NUMBERS = ("gap", "distance", "overlapRatio", "insideRatio", "betweenRatio", "angle", "margin")
"""What is measured of a relation."""
