"""The records that reading a stage gives: plain, immutable, without any open stage behind them."""

from collections.abc import Container, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, NamedTuple

from usd2kg.languages import split_compound
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
        """The middle of the box in metres."""
        (x0, y0, z0), (x1, y1, z1) = self.lower, self.upper
        return ((x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2)

    @property
    def volume(self) -> float:
        """Volume in cubic metres; 0 for a flat box."""
        width, depth, height = self.size
        return width * depth * height


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """Something about the stage that a user should know; reading went on."""

    code: str
    """A short stable word: `composition`, `units`, `transform`, `empty-box`, `openusd`…"""
    message: str
    """What was found and what follows from it."""
    prim_path: str | None = None
    """The prim it is about, where there is one."""
    layer: str | None = None
    """The identifier of the layer it is about, where there is one."""


@dataclass(frozen=True, slots=True)
class StageFrame:
    """How the stage measures, before everything is converted to metres, kilograms and z-up."""

    up_axis: str
    """`Y` or `Z`, as composed."""
    metres_per_unit: float
    """Length of one stage unit in metres."""
    kilograms_per_unit: float
    """Mass of one stage unit in kilograms."""
    is_authored: bool
    """Whether the length unit is authored; False means OpenUSD's fallback of one centimetre."""


@dataclass(frozen=True, slots=True)
class Instances:
    """The copies that one point instancer scatters."""

    count: int
    """Number of copies that are drawn."""
    prototypes: tuple[str, ...]
    """Names of the prototypes, in the instancer's order."""


@dataclass(frozen=True, slots=True)
class Label:
    """One label as the stage has it, white space and unprintable characters cleaned up."""

    prim_path: str
    """The prim that carries the label: for an inherited one, the prim above."""
    encoding: Encoding
    """How it is written on the stage."""
    taxonomy: str
    """What the value is a word of: `class`, `wikidata_qcode`… For Multiverse the ontology's namespace IRI, or the
    name of the ontology's prim where the namespace is not authored."""
    value: str
    """The label: a class name, a Wikidata item, a path of classes, whatever was authored."""
    is_inherited: bool = False
    """Whether it stands on a prim above the one asked for; UsdSemantics lets labels inherit down the namespace."""
    strength: Strength = "label"
    """`report` for Multiverse's semanticReports: candidates that a tool brought up, weaker than labels."""

    @property
    def iri(self) -> str | None:
        """IRI of the class where the label states one, else None."""
        if self.encoding == "Multiverse" and self.taxonomy.endswith(("#", "/")):
            return self.taxonomy + self.value
        return self.value if self.taxonomy == "iri" else None


class ObjectLabels(NamedTuple):
    """The labels of one object, kept apart by where they stand; each set without repetitions."""

    own: tuple[Label, ...]
    """On the object's prim."""
    inherited: tuple[Label, ...]
    """On prims above it, nearest first, without those it has itself."""
    of_parts: tuple[Label, ...]
    """On prims and geometry subsets below it, nested objects left out; at most 64."""


NO_LABELS = ObjectLabels((), (), ())


@dataclass(frozen=True, slots=True)
class MaterialDetails:
    """A material and its surface, where that is one constant.

    None means that a texture or a network decides, or that nothing is authored.
    """

    name: str
    """Name of the material prim."""
    prim_path: str
    """Path of the material prim, also where it does not exist."""
    base_color: Vector | None = None
    """Diffuse or base colour, linear RGB."""
    roughness: float | None = None
    """0 is a mirror, 1 is matt."""
    metallic: float | None = None
    """0 is a dielectric, 1 a metal."""
    opacity: float | None = None
    """0 is clear, 1 is solid."""


@dataclass(frozen=True, slots=True)
class Joint:
    """One joint: what moves against what, which way and how far.

    Angles are radians, lengths metres, vectors in the z-up world frame; None means that the stage does not say.
    """

    prim_path: str
    """The joint's prim."""
    type: JointType
    """`other` for joints with free choice of axes (`PhysicsJoint`) and for types of vendors."""
    body0: str | None
    """The prim it hangs on; None for the world. Where the authored one does not exist, the nearest above it."""
    body1: str | None
    """The prim that it moves, found in the same way."""
    axis: str | None
    """The authored axis in the joint's own frame: X, Y or Z; None for joints without one."""
    axis_vector: Vector | None
    """The same as unit vector in the world at the time that was read: hinge line, slide direction. For a slide it
    points where positive values move body1, for a hinge positive angles turn right-handed about it."""
    origin: Vector | None
    """Origin of the joint's frame in the world at the time that was read: a point on the hinge line."""
    direction: Direction | None
    """`vertical` or `horizontal` within 10 degrees, else `oblique`."""
    lower: float | None
    """Lower limit: radians for revolute, metres for prismatic and distance joints; None if unlimited."""
    upper: float | None
    """Upper limit, in the same way."""
    value: float | None
    """Joint position where a joint state is authored: radians for revolute, metres for prismatic joints."""
    is_enabled: bool
    """Whether the simulation heeds the joint."""
    is_excluded_from_articulation: bool
    """Whether it closes a loop, so that it is no part of the tree of links."""


@dataclass(frozen=True, slots=True)
class SceneObject:
    """One thing a person would point at and name, with all that the stage says about it.

    Lengths are metres and masses kilograms in the z-up world frame; None means that the stage does not say.
    """

    prim_path: str
    """The authored path: the stable key of the object."""
    name: str
    """The prim's own name, the last part of its path."""
    type_name: str
    """The prim's schema type (`Xform`, `Mesh`…), empty if untyped."""
    kind: str
    """The authored model kind, a studio's own by the standard one it derives from; empty if none."""
    selected_by: str
    """Why this prim is an object, in words."""
    parent_path: str | None
    """The nearest object above this one, or None."""
    box: Box | None
    """Everything below the prim, nested objects included; None where there is no geometry."""
    own_box: Box | None
    """The same without the objects nested below it."""
    part_boxes: tuple[Box, ...]
    """Boxes of the object's own geometry prims, where there are several: a shelf's boards, a chair's seat. At most
    64, the largest; empty where one box says all."""
    position: Vector | None
    """World translation of the prim's own frame; None if its transform is not finite."""
    orientation: Quaternion | None
    """World rotation (x, y, z, w) of the prim's own frame; None if it has none (shear, zero scale)."""
    mass_kg: float | None
    """Authored mass, of the prim or added up over its parts."""
    display_name: str
    """The authored display name, empty if none."""
    documentation: str
    """The authored documentation, empty if none."""
    asset: tuple[str, ...]
    """Identifiers of the asset it comes from: assetInfo name and identifier, references, payloads."""
    materials: tuple[str, ...]
    """Names of the materials on its visible geometry, by UsdShade's rules of binding, in order of appearance."""
    parts: tuple[str, ...]
    """Distinct names of the prims below it, in order of appearance, nested objects left out."""
    display_color: Vector | None
    """First authored display colour, linear RGB from 0 to 1."""
    instance_of: str | None
    """Path of the first instance of the same prototype, maybe its own; None if the prim is not an instance. (The path
    of the prototype itself is OpenUSD's secret and differs from run to run.)"""
    instances: Instances | None = None
    """Set where the object stands for the copies of a point instancer."""
    oriented_size: Vector | None = None
    """Extent along the prim's own axes, where they are turned against the world's; None where `box` says as much."""
    center_of_mass: Vector | None = None
    """Authored centre of mass in the world, of several parts weighted by their masses."""
    geometry_file: str = ""
    """The file that its geometry is referenced from: relative to the stage's folder where it lies in it, else as
    authored; empty if none."""
    labels: ObjectLabels = NO_LABELS
    """Semantic labels that the stage carries already, in whatever encoding; evidence, not truth."""
    variants: tuple[tuple[str, str], ...] = ()
    """(variant set, selected variant), by name of the set."""
    texts: tuple[tuple[str, str], ...] = ()
    """(name, text) of custom attributes and metadata that carry words."""
    material_details: tuple[MaterialDetails, ...] = ()
    """The bound materials with base colour and finish, where those are constant."""
    support_levels: tuple[Box, ...] = ()
    """Broad level faces of its meshes that look up, as flat boxes from the bottom up: the boards of a shelf that is one
    mesh. At most 32; measured only where another object begins within its bounds."""

    @property
    def words(self) -> tuple[str, ...]:
        """The telling words of the display name or, without one, of the prim's name; foreign compounds are split."""
        return tuple(part for word in words_of(self.display_name or self.name) for part in split_compound(word))


@dataclass(frozen=True)
class Scene:
    """All objects of one stage, in traversal order, and what reading it brought up."""

    source: str
    """The file as the user named it."""
    content_hash: str
    """`sha256:` over all layers the stage was composed from."""
    frame: StageFrame
    """The stage's own measures."""
    time: float | None
    """The time code that was read; None for the default time."""
    prim_count: int
    """Prims visited, instance proxies included."""
    objects: tuple[SceneObject, ...]
    """The objects, in traversal order: parents before children."""
    left_out: Mapping[str, int]
    """Reason → number of prims that are not objects for that reason."""
    diagnostics: tuple[Diagnostic, ...] = ()
    """What was odd on the stage."""
    missing_paths: tuple[str, ...] = ()
    """Paths that were asked for and do not exist on the stage."""
    joints: tuple[Joint, ...] = ()
    """How things move, in traversal order."""

    @cached_property
    def by_path(self) -> Mapping[str, SceneObject]:
        """Prim path → object."""
        return {obj.prim_path: obj for obj in self.objects}

    def extent_without(self, left_out: Container[str]) -> Box | None:
        """Return the box around all objects but those at the given paths; None if none has a box."""
        boxes = [obj.box for obj in self.objects if obj.box and obj.prim_path not in left_out]
        if not boxes:
            return None
        lower = [min(box.lower[axis] for box in boxes) for axis in range(3)]
        upper = [max(box.upper[axis] for box in boxes) for axis in range(3)]
        return Box((lower[0], lower[1], lower[2]), (upper[0], upper[1], upper[2]))

    def ancestors(self, obj: SceneObject) -> Iterator[SceneObject]:
        """Yield the objects above `obj`, nearest first."""
        parent = obj.parent_path
        while parent is not None:
            above = self.by_path[parent]
            yield above
            parent = above.parent_path
