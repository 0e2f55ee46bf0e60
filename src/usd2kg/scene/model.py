"""Scene and its records: what was read from a stage, immutable and independent of OpenUSD."""

from collections.abc import Container, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal, NamedTuple

from usd2kg.convert.origin import Origin
from usd2kg.languages import split_compound
from usd2kg.rich_display import RichDisplay
from usd2kg.shapes.surface import Surface
from usd2kg.words import words_of

__all__ = [
    "NO_LABELS",
    "Box",
    "Diagnostic",
    "Instances",
    "Joint",
    "Label",
    "MaterialDetails",
    "ObjectLabels",
    "Scene",
    "SceneObject",
    "StageFile",
    "StageFrame",
]

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]
Encoding = Literal["UsdSemantics", "Isaac", "Multiverse"]
Strength = Literal["label", "report"]
JointType = Literal["revolute", "prismatic", "fixed", "spherical", "distance", "other"]
Direction = Literal["vertical", "horizontal", "oblique"]


@dataclass(frozen=True, slots=True)
class Box:
    """An axis-aligned box in the scene's world frame: metres, z-up, right-handed."""

    lower: Vector
    """Smallest x, y, z."""
    upper: Vector
    """Largest x, y, z."""

    @property
    def size(self) -> Vector:
        """Extent along x, y and z in metres."""
        (x0, y0, z0), (x1, y1, z1) = self.lower, self.upper
        return (x1 - x0, y1 - y0, z1 - z0)

    @property
    def center(self) -> Vector:
        """Centre of the box in metres."""
        (x0, y0, z0), (x1, y1, z1) = self.lower, self.upper
        return ((x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2)

    @property
    def volume(self) -> float:
        """Volume in cubic metres; 0 for a flat box."""
        width, depth, height = self.size
        return width * depth * height


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """A problem of a stage that did not prevent reading it."""

    code: str
    """Short and stable: `composition`, `units`, `transform`, `empty-box`, `openusd`, and so on."""
    message: str
    """What was found, and the consequence."""
    prim_path: str | None = None
    """The prim concerned; None if there is no single one."""
    layer: str | None = None
    """Identifier of the layer concerned; None if there is no single one."""


@dataclass(frozen=True, slots=True)
class StageFrame:
    """Units and up axis of the stage, before conversion to metres, kilograms and z-up."""

    up_axis: str
    """`Y` or `Z`."""
    metres_per_unit: float
    """Length of one stage unit in metres."""
    kilograms_per_unit: float
    """Mass of one stage unit in kilograms."""
    is_authored: bool
    """Whether the length unit is authored or overridden; if not, it is OpenUSD's fallback of one centimetre."""


@dataclass(frozen=True, slots=True)
class Instances:
    """The copies of an object's point instancers."""

    count: int
    """Number of visible copies."""
    prototypes: tuple[str, ...]
    """Names of the prototypes, in the order of the instancer."""


@dataclass(frozen=True, slots=True)
class Label:
    """One authored semantic label, without surrounding white space and unprintable characters."""

    prim_path: str
    """The prim on which the label is authored; for an inherited label, an ancestor of the object."""
    encoding: Encoding
    taxonomy: str
    """The vocabulary of the value: `class`, `wikidata_qcode`, and so on. For Multiverse, the namespace IRI of the
    ontology, or the name of the ontology's prim if no namespace is authored."""
    value: str
    """As authored: a class name, a Wikidata item, a path of classes, and so on."""
    is_inherited: bool = False
    """Whether it is authored on an ancestor; UsdSemantics inherits labels down the namespace."""
    strength: Strength = "label"
    """`report` for Multiverse's semanticReports: candidates proposed by a tool, weaker than labels."""
    confidence: float | None = None
    """Confidence of the prediction that `usd2kg label` wrote; None for a label of a person or another program."""

    @property
    def iri(self) -> str | None:
        """IRI of the class; None if the label has none."""
        if self.encoding == "Multiverse" and self.taxonomy.endswith(("#", "/")):
            return self.taxonomy + self.value
        return self.value if self.taxonomy == "iri" else None


class ObjectLabels(NamedTuple):
    """The labels of one object by the prim that carries them, without duplicates."""

    own: tuple[Label, ...]
    """On the object's prim; for a point instancer without any, those that all its drawn prototypes have."""
    inherited: tuple[Label, ...]
    """On its ancestors, nearest first, without those in `own`."""
    of_parts: tuple[Label, ...]
    """On prims and geometry subsets below it, without nested objects; at most 64."""
    of_whole: tuple[Label, ...] = ()
    """Those of `inherited` and `of_parts` that are about the object and nothing else: on a prim above without other
    geometry, or alike on all geometry below. Empty if there are labels of its own."""


NO_LABELS = ObjectLabels((), (), ())


@dataclass(frozen=True, slots=True)
class MaterialDetails:
    """A material with its constant surface parameters; None if a shading network computes one, or none is authored."""

    name: str
    """Name of the material prim."""
    prim_path: str
    """Path of the material prim, which may be missing."""
    base_color: Vector | None = None
    """Diffuse or base colour, linear RGB."""
    roughness: float | None = None
    """0 for a mirror, 1 for a matt surface."""
    metallic: float | None = None
    """0 for a dielectric, 1 for a metal."""
    opacity: float | None = None
    """0 for transparent, 1 for opaque."""


@dataclass(frozen=True, slots=True)
class Joint:
    """One joint: bodies, axis and limits.

    Angles are radians, lengths metres, vectors in the z-up world frame; None means not authored.
    """

    prim_path: str
    """The joint's prim."""
    type: JointType
    """`other` for the generic `PhysicsJoint` and for vendors' types."""
    body0: str | None
    """The parent body; None for the world. If the target is missing, its nearest existing ancestor."""
    body1: str | None
    """The child body, in the same way."""
    axis: str | None
    """The authored axis in the joint's own frame: X, Y or Z; None for joints without one."""
    axis_vector: Vector | None
    """The axis as a unit vector in the world. Positive values of a prismatic joint move body1 along it, positive angles
    of a revolute joint turn body1 right-handed about it."""
    origin: Vector | None
    """Origin of the joint frame in the world: a point on the axis."""
    direction: Direction | None
    """`vertical` or `horizontal` within 10 degrees, else `oblique`."""
    lower: float | None
    """Lower limit: radians for revolute, metres for prismatic and distance joints; None if unlimited."""
    upper: float | None
    """Upper limit, in the same units."""
    value: float | None
    """Authored joint position: radians for revolute, metres for prismatic joints."""
    is_enabled: bool
    is_excluded_from_articulation: bool
    """Whether it is excluded from the articulation, as a joint that closes a kinematic loop."""


@dataclass(frozen=True, slots=True)
class SceneObject:
    """One object that a person would name, with everything the stage states about it.

    Lengths are metres and masses kilograms in the z-up world frame; None means not authored.
    """

    prim_path: str
    """The authored path: the stable key of the object."""
    name: str
    """The name of the prim, the last element of its path."""
    type_name: str
    """The prim's schema type (`Xform`, `Mesh`, and so on), empty if untyped."""
    kind: str
    """The authored model kind, or the standard kind that a custom one derives from; empty if none."""
    selected_by: str
    """Why this prim is an object, in words."""
    parent_path: str | None
    """The nearest object above this one, or None."""
    box: Box | None
    """World AABB of all geometry at and below the prim with nested objects, otherwise of its `extentsHint`; or None."""
    own_box: Box | None
    """The same without nested objects."""
    part_boxes: tuple[Box, ...]
    """World AABBs of the object's own gprims, such as the boards of a shelf: the 64 largest; empty for one gprim."""
    position: Vector | None
    """World translation of the prim's own frame; None if its transform is not finite."""
    orientation: Quaternion | None
    """World rotation (x, y, z, w) of the prim's own frame; None if undefined (singular transform)."""
    mass_kg: float | None
    """Authored mass of the prim, or the sum over its parts."""
    display_name: str
    """The authored display name, empty if none."""
    documentation: str
    """The authored documentation, empty if none."""
    asset: tuple[str, ...]
    """Names of its asset: name and identifier of assetInfo, file stems of references and payloads."""
    materials: tuple[str, ...]
    """Names of the materials bound to its visible geometry, as resolved by UsdShade, in order of appearance."""
    parts: tuple[str, ...]
    """Distinct names of the prims below it, in order of appearance, without nested objects."""
    display_color: Vector | None
    """First authored display colour, linear RGB from 0 to 1."""
    instance_of: str | None
    """Path of the first instance of the same prototype, possibly its own; None if the prim is not an instance.
    (OpenUSD generates the path of the prototype itself, which differs between runs.)"""
    instances: Instances | None = None
    """The copies, if the object contains point instancers."""
    oriented_size: Vector | None = None
    """Extent along the prim's own axes; None if they are parallel to the world axes."""
    center_of_mass: Vector | None = None
    """Authored centre of mass in the world; for several parts, weighted by mass."""
    geometry_file: str = ""
    """The referenced file of its geometry: relative to the stage's folder if it is in it, else as authored; empty if
    none."""
    source_id: str = ""
    """Identifier in the file that the stage was converted from, such as the GlobalId of IFC; empty if none."""
    labels: ObjectLabels = NO_LABELS
    """Semantic labels in all encodings; evidence, not truth."""
    variants: tuple[tuple[str, str], ...] = ()
    """(variant set, selected variant), sorted by set."""
    texts: tuple[tuple[str, str], ...] = ()
    """(name, text) of custom attributes and metadata that hold free text."""
    material_details: tuple[MaterialDetails, ...] = ()
    """The bound materials with their constant surface parameters."""
    support_levels: tuple[Box, ...] = ()
    """Broad horizontal faces of its meshes that face up, as flat boxes from the bottom up, such as the boards of a
    shelf. At most 32; measured only if the bottom of another object is within its box."""
    shell_boxes: tuple[Box, ...] = ()
    """World AABBs that together cover the surface of a large object whose box holds the middle of another: the walls of
    a flat in one mesh. Empty if the surface fills its box."""

    @property
    def words(self) -> tuple[str, ...]:
        """The descriptive words of the display name or, without one, of the prim's name; compounds are split."""
        return tuple(part for word in words_of(self.display_name or self.name) for part in split_compound(word))


@dataclass(frozen=True)
class StageFile:
    """A file that a stage was composed of, as it was when it was read."""

    path: str
    """A layer, or the package that contains it; absolute, links resolved."""
    bytes: int
    modified_ns: int
    sha256: str
    """Hexadecimal digits."""


@dataclass(frozen=True)
class Scene(RichDisplay):
    """All objects of one stage, with joints and diagnostics."""

    source: str
    """The file as the user named it."""
    content_hash: str
    """`sha256:` and the digest of all layers of the stage."""
    frame: StageFrame
    """Authored units and up axis."""
    time: float | None
    """Requested time code, otherwise the start time code of the stage; None without an authored time range."""
    prim_count: int
    """Number of traversed prims, including instance proxies."""
    objects: tuple[SceneObject, ...]
    """In traversal order: parents before children."""
    left_out: Mapping[str, int]
    """Reason → number of prims that are not objects for that reason."""
    diagnostics: tuple[Diagnostic, ...] = ()
    """Problems of the stage."""
    missing_paths: tuple[str, ...] = ()
    """Requested paths that are not on the stage."""
    joints: tuple[Joint, ...] = ()
    """In traversal order."""
    origin: Origin | None = None
    """What the stage was converted from; None if it is not a conversion."""
    files: tuple[StageFile, ...] = field(default=(), compare=False, repr=False)
    """The layers in use, sorted by path; empty for other formats. Textures and missing files are not among them."""
    surfaces: Mapping[str, Surface] = field(default_factory=dict, compare=False, repr=False)
    """Prim path → triangles, for objects near others whose box is only an approximation, not for axis-aligned boxes."""

    @cached_property
    def by_path(self) -> Mapping[str, SceneObject]:
        """Prim path → object."""
        return {obj.prim_path: obj for obj in self.objects}

    def extent_without(self, left_out: Container[str]) -> Box | None:
        """Return the box around all objects except those at the given paths; None if none has a box."""
        boxes = [obj.box for obj in self.objects if obj.box and obj.prim_path not in left_out]
        if not boxes:
            return None
        lower = [min(box.lower[axis] for box in boxes) for axis in range(3)]
        upper = [max(box.upper[axis] for box in boxes) for axis in range(3)]
        return Box((lower[0], lower[1], lower[2]), (upper[0], upper[1], upper[2]))

    def ancestors(self, obj: SceneObject) -> Iterator[SceneObject]:
        """Yield the ancestors of `obj`, nearest first."""
        parent = obj.parent_path
        while parent is not None:
            above = self.by_path[parent]
            yield above
            parent = above.parent_path
