"""SDFormat file → stage: a component for each model, links and visuals below it."""

from importlib.metadata import version
from pathlib import Path
from typing import NamedTuple

import numpy as np
from pxr import Gf, Kind, Sdf, Usd, UsdPhysics, UsdSemantics, Vt

from usd2kg.convert.converted import Converted
from usd2kg.convert.prims import PrimAuthor, custom_data, new_stage, valid_text
from usd2kg.convert.sdf.budget import SdfBudget
from usd2kg.convert.sdf.frames import MODEL_FRAME, NESTED, Scope
from usd2kg.convert.sdf.joints import define_joint
from usd2kg.convert.sdf.model import Asset, Model, Pose, SdfLink, SdfWorld
from usd2kg.convert.sdf.notes import Notes
from usd2kg.convert.sdf.reader import SdfReader
from usd2kg.convert.sdf.resources import Resources
from usd2kg.convert.sdf.values import Matrix, inverse
from usd2kg.convert.sdf.visuals import VisualAuthor

__all__ = ["read_prims"]

_PERSON = "person"


def read_prims(path: Path) -> Converted:
    """Return the stage of an SDFormat file, in metres and z-up.

    The default prim is the world, the model of a file with one model, or else a prim named after the file.

    Raises:
        SceneError: it is no SDFormat file, has no world and no model, includes itself, or has more than a
            scene can have.
    """
    notes, resources, budget = Notes(), Resources(path), SdfBudget(path)
    world = SdfReader(path, resources, notes, budget).read()
    stage = new_stage("Z", 1.0)
    _StageWriter(stage, resources, notes, budget).write(world, path)
    return Converted(stage, f"usd2kg {version('usd2kg')}", tuple(notes))


class _StageWriter:
    """Writes models as prims; `SdfReader` limits how deep they are nested."""

    def __init__(self, stage: Usd.Stage, resources: Resources, notes: Notes, budget: SdfBudget) -> None:
        self._stage = stage
        self._author = PrimAuthor(stage)
        self._resources = resources
        self._notes = notes
        self._budget = budget
        self._visuals: VisualAuthor | None = None

    def write(self, world: SdfWorld, path: Path) -> None:
        """Write the models of a file, which is at `path`."""
        scope = Scope(world, self._notes, path)
        if not world.name and len(world.models) == 1:
            self._write_model(world.models[0], scope, _Parent("/", np.eye(4)))
            self._stage.SetDefaultPrim(self._stage.GetPseudoRoot().GetChildren()[0])
            return
        root = self._author.define("/", world.name or path.stem)
        root.SetAssetInfo({"name": path.stem})
        Usd.ModelAPI(root).SetKind(Kind.Tokens.assembly)
        self._stage.SetDefaultPrim(root)
        parent = _Parent(str(root.GetPath()), np.eye(4))
        bodies = self._write_models(world, scope, parent)
        for joint in world.joints:
            define_joint(self._author, parent.path, joint, scope, bodies, parent.to_world, self._notes)

    def _write_models(self, owner: SdfWorld | Model, scope: Scope, parent: "_Parent") -> dict[str, str]:
        """Write the models of `owner`, and return their links, as `Scope.link_of` names them, with their paths."""
        bodies: dict[str, str] = {}
        for model in owner.models:
            inner = self._write_model(model, scope, parent)
            bodies.update({f"{model.name}{NESTED}{name}": path for name, path in inner.items()})
        return bodies

    def _write_model(self, model: Model, owner: Scope, parent: "_Parent") -> dict[str, str]:
        prim = self._author.define(parent.path, model.name or "model")
        local = owner.place_model(model)
        self._author.move(prim, local)
        scope = owner.scope_of(model)
        is_group = parent.kind != Kind.Tokens.subcomponent and _is_group(model)
        Usd.ModelAPI(prim).SetKind(Kind.Tokens.group if is_group else parent.kind)
        _describe(prim, model)
        below = _Parent(
            str(prim.GetPath()),
            parent.to_world @ local,
            Kind.Tokens.component if is_group else Kind.Tokens.subcomponent,
            parent.is_static or model.is_static,
        )
        bodies = {link.name: self._write_link(link, scope, below) for link in model.links}
        bodies.update(self._write_models(model, scope, below))
        for joint in model.joints:
            define_joint(self._author, below.path, joint, scope, bodies, below.to_world, self._notes)
        return bodies

    def _write_link(self, link: SdfLink, scope: Scope, parent: "_Parent") -> str:
        prim = self._author.define(parent.path, link.name or "link")
        path = str(prim.GetPath())
        matrix = scope.place(link.pose, MODEL_FRAME)
        self._author.move(prim, matrix)
        # A rigid body without a kind would be an object of its own.
        Usd.ModelAPI(prim).SetKind(Kind.Tokens.subcomponent)
        if not parent.is_static:
            UsdPhysics.RigidBodyAPI.Apply(prim)
        to_link = inverse(matrix)
        if link.mass is not None:
            mass = UsdPhysics.MassAPI.Apply(prim)
            mass.CreateMassAttr(link.mass)
            if link.center_of_mass is not None:
                center = _relative(link.center_of_mass, scope, to_link)[:3, 3]
                mass.CreateCenterOfMassAttr(Gf.Vec3f(*center.tolist()))
        for visual in link.visuals:
            self._visual_author(path).define(path, visual, _relative(visual.pose, scope, to_link))
        return path

    def _visual_author(self, path: str) -> VisualAuthor:
        if self._visuals is None:
            root = f"/{path.split('/')[1]}"
            self._visuals = VisualAuthor(self._author, root, self._resources, self._notes, self._budget)
        return self._visuals


class _Parent(NamedTuple):
    """What models and links are written below."""

    path: str
    to_world: Matrix
    kind: str = Kind.Tokens.component
    """Kind of a model below it."""
    is_static: bool = False


def _relative(pose: Pose, scope: Scope, to_link: Matrix) -> Matrix:
    """Return a pose in the frame of the link, which is its default."""
    return to_link @ scope.place(pose, MODEL_FRAME) if pose.relative_to else pose.matrix


def _is_group(model: Model) -> bool:
    """Return whether a model is a group of things: it has no links of its own, and no joints between its models."""
    return len(model.models) > 1 and not model.links and not model.joints


def _asset(model: Model) -> Asset | None:
    """Return the asset of a model; for one that only wraps another, the asset of that."""
    while model.asset is None and not model.links and len(model.models) == 1:
        model = model.models[0]
    return model.asset


def _describe(prim: Usd.Prim, model: Model) -> None:
    """Author the asset of a model, and the label of a person."""
    asset = _asset(model)
    if asset is not None:
        # OpenUSD refuses asset paths with control characters, which XML may contain.
        identifier = Sdf.AssetPath("".join(character for character in asset.uri if character.isprintable()))
        prim.SetAssetInfo({"name": valid_text(asset.name), "identifier": identifier})
        if asset.texts:
            prim.SetCustomDataByKey("sdf", custom_data(asset.texts))
    if model.is_person:
        labels = UsdSemantics.LabelsAPI.Apply(prim, "class")
        labels.CreateLabelsAttr().Set(Vt.TokenArray([_PERSON]))
