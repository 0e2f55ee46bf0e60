"""Ground an open stage, and colour it by class in its session layer. Imports neither Qt nor usdview."""

from dataclasses import dataclass
from pathlib import Path

from pxr import Sdf, Usd, UsdGeom

from usd2kg.diagrams import Coloring, ColorMode, color_scene
from usd2kg.grounding import Grounding, ground
from usd2kg.ontology import TBox
from usd2kg.pipeline import open_tbox
from usd2kg.scene import Scene, SceneObject, read_scene
from usd2kg.scene.model import Vector
from usd2kg.scene.session_layer import add_to_session, remove_from_session

__all__ = ["GroundedStage", "color_by_class", "find_object", "ground_stage", "reset_colors"]

_CONTENT = "colors"
_COLOR = "primvars:displayColor"
_INDICES = f"{_COLOR}:indices"


@dataclass(frozen=True)
class GroundedStage:
    """The objects of a stage with their classes."""

    scene: Scene
    tbox: TBox
    grounding: Grounding


def ground_stage(stage: Usd.Stage, ontology: Path | str | None = None) -> GroundedStage:
    """Return the objects of an open stage with their classes. Colours of `color_by_class` are removed first.

    Args:
        stage: the open stage, read with its session layer and current variants.
        ontology: an OWL file; default: the built-in one that suits the stage.

    Raises:
        Usd2kgError: the stage has no objects, or the ontology cannot be read.
    """
    reset_colors(stage)
    scene = read_scene(stage)
    tbox = open_tbox(ontology, scene)
    return GroundedStage(scene, tbox, ground(scene, tbox))


def color_by_class(stage: Usd.Stage, grounded: GroundedStage) -> Coloring:
    """Colour the objects of an open stage by their classes, in its session layer; return the colours.

    A class has the same colour as in the studio and in `usd2kg render`; what belongs to no object is grey. Instances
    stay instances unless their geometry has colours of its own, which only a prim that is no instance can override.

    Raises:
        OutputError: the stage has no session layer.
    """
    coloring = color_scene(ColorMode.CLASS, grounded.tbox, grounded.grounding, grounded.grounding, ())
    reset_colors(stage)
    opinions = Sdf.Layer.CreateAnonymous()
    colors = coloring.linear_colors()
    color_of: dict[Sdf.Path, Vector] = {Sdf.Path.absoluteRootPath: colors["/"]}
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        path = prim.GetPath()
        if prim.IsPseudoRoot():
            continue
        inherited = color_of[path.GetParentPath()]
        color_of[path] = color = colors.get(str(path), inherited)
        if _needs_color(prim, is_new=color != inherited):
            _author_color(opinions, prim, color)
    add_to_session(stage, opinions, _CONTENT)
    return coloring


def reset_colors(stage: Usd.Stage) -> bool:
    """Remove the colours of `color_by_class`; return whether there were any."""
    return remove_from_session(stage, _CONTENT)


def find_object(scene: Scene, prim_path: str) -> SceneObject | None:
    """Return the object at a path, or the nearest one above it; None if there is none."""
    path = Sdf.Path(prim_path)
    return next((scene.by_path[str(at)] for at in path.GetAncestorsRange() if str(at) in scene.by_path), None)


def _needs_color(prim: Usd.Prim, *, is_new: bool) -> bool:
    """Return whether a prim needs an opinion; others inherit the colour of their parent, as primvars do."""
    attribute = prim.GetAttribute(_COLOR)
    if attribute and attribute.HasAuthoredValue():
        return True
    return is_new or (prim.IsA(UsdGeom.Gprim) and not prim.IsInstanceProxy())


def _author_color(opinions: Sdf.Layer, prim: Usd.Prim, color: Vector) -> None:
    if prim.IsInstanceProxy():
        _make_uninstanceable(opinions, prim)
    spec = Sdf.CreatePrimInLayer(opinions, prim.GetPath())
    attribute = Sdf.AttributeSpec(spec, _COLOR, Sdf.ValueTypeNames.Color3fArray)
    attribute.default = [color]
    attribute.SetInfo("interpolation", UsdGeom.Tokens.constant)
    if prim.HasAttribute(_INDICES):
        # Indices of other colours would point behind the only one.
        Sdf.AttributeSpec(spec, _INDICES, Sdf.ValueTypeNames.IntArray).default = Sdf.ValueBlock()


def _make_uninstanceable(opinions: Sdf.Layer, prim: Usd.Prim) -> None:
    parent = prim.GetParent()
    while parent and not parent.IsPseudoRoot():
        if parent.IsInstance():
            Sdf.CreatePrimInLayer(opinions, parent.GetPath()).instanceable = False
        parent = parent.GetParent()
