"""The spatial structure of an IFC file → prims: project, site, building and storey are groups, elements components."""

from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import Kind, Usd, UsdGeom, UsdSemantics, Vt

from usd2kg.convert.converted import Converted, parse_error
from usd2kg.convert.ifc.entity_facts import entity_data, kind_word, material_names, name_of, numbered_name
from usd2kg.convert.ifc.tessellation import NOT_PHYSICAL, Shape, instances_of, tessellate
from usd2kg.convert.materials import MaterialAuthor, SurfaceMaterial
from usd2kg.convert.origin import SOURCE_ID
from usd2kg.convert.prims import PrimAuthor, custom_data, new_stage
from usd2kg.prim_paths import nearest_in

__all__ = ["read_prims"]

_EXPECTED = "an IFC file (2x3, 4 or 4.3) in the STEP format"
_SPATIAL = ("IfcSpatialElement", "IfcSpatialStructureElement")
"""Spatial elements: since IFC 4, and in IFC 2x3."""
_WRITTEN = (*_SPATIAL, "IfcElement", "IfcProxy")
"""Classes whose instances are written even if unreachable from the project; wholes before parts."""


def read_prims(path: Path) -> Converted:
    """Return the stage of an IFC file, in metres and z-up.

    Raises:
        SceneError: IfcOpenShell cannot read the file, or it has no project or no geometry.
    """
    model = _open(path)
    project = next(iter(model.by_type("IfcProject")), None)
    if project is None:
        raise parse_error(path, "it has no IfcProject", _EXPECTED)
    _check_structure(path, model)
    shapes = dict(tessellate(model))
    if not shapes:
        raise parse_error(path, "no product has a body that can be tessellated", _EXPECTED)
    stage = new_stage("Z", 1.0)
    _BuildingWriter(stage, shapes, model).write(project, path.stem)
    return Converted(stage, f"ifcopenshell {version('ifcopenshell')}", tuple(_notes(model, shapes)))


def _check_structure(path: Path, model: Any) -> None:
    """Reject a file that IfcOpenShell would never finish: a GlobalId that is not text, a whole that is its own part.

    Raises:
        SceneError: the file has one.
    """
    for entity in model.by_type("IfcRoot"):
        if not entity.GlobalId:
            raise parse_error(path, f"#{entity.id()} has no GlobalId", _EXPECTED)
        if not isinstance(entity.GlobalId, str):
            # A surplus attribute shifts the others, so that a reference may be where the text is expected.
            found = f"#{entity.id()} {entity.is_a()} has a GlobalId that is no text; it may have a surplus attribute"
            raise parse_error(path, found, _EXPECTED)
    whole = {
        part.id(): relation.RelatingObject.id()
        for relation in model.by_type("IfcRelAggregates")
        for part in relation.RelatedObjects or ()
        if relation.RelatingObject is not None
    }
    ends: set[int] = set()
    for start in whole:
        chain: dict[int, None] = {}
        at = start
        while at in whole and at not in ends:
            if at in chain:
                raise parse_error(path, f"#{at} is a part of itself", _EXPECTED)
            chain[at] = None
            at = whole[at]
        ends.update(chain)


def _open(path: Path) -> Any:
    import ifcopenshell  # noqa: PLC0415

    try:
        return ifcopenshell.open(path)
    except (ifcopenshell.Error, OSError, RuntimeError, UnicodeDecodeError) as error:
        raise parse_error(path, error, _EXPECTED) from error


def _notes(model: Any, shapes: dict[int, Shape]) -> Iterator[str]:
    lost = [
        entity
        for entity in model.by_type("IfcElement")
        if entity.Representation is not None and entity.id() not in shapes and not _is_any(entity, NOT_PHYSICAL)
    ]
    if lost:
        first = ", ".join(f"{entity.is_a()} {entity.GlobalId}" for entity in lost[:3])
        yield f"{len(lost)} elements have a representation without a surface; they have no geometry: {first}"


def _is_any(entity: Any, classes: tuple[str, ...]) -> bool:
    return any(entity.is_a(name) for name in classes)


class _BuildingWriter:
    """Writes entities as prims, each once, without recursion."""

    def __init__(self, stage: Usd.Stage, shapes: dict[int, Shape], model: Any) -> None:
        from ifcopenshell.util.unit import calculate_unit_scale  # noqa: PLC0415

        self._model = model
        self._metres = float(calculate_unit_scale(model))
        self._shapes = shapes
        self._stage = stage
        self._author = PrimAuthor(stage)
        self._written: set[int] = set()
        self._worlds: dict[str, NDArray[np.float64]] = {}
        """Path of a prim with a transform → its matrix to the world."""
        self._materials: MaterialAuthor | None = None

    def write(self, project: Any, file_name: str) -> None:
        """Write the structure below the project, then the spaces and elements that it does not lead to."""
        root = self._author.define("/", name_of(project))
        self._stage.SetDefaultPrim(root)
        root.SetAssetInfo({"name": file_name})
        Usd.ModelAPI(root).SetKind(Kind.Tokens.assembly)
        facts = {**entity_data(project, self._metres), "schema": self._model.schema, "metresPerUnit": self._metres}
        root.SetCustomDataByKey("ifc", custom_data(facts))
        path = str(root.GetPath())
        self._materials = MaterialAuthor(self._author, path)
        self._written.add(project.id())
        self._write_all(_parts(project), path)
        for name in _WRITTEN:
            apart = [entity for entity in instances_of(self._model, name) or () if not _has_whole(entity)]
            self._write_all(apart, path)

    def _write_all(self, entities: list[Any], parent: str) -> None:
        # (entity, the room that it is in, path above, whether an element is above)
        pending: list[tuple[Any, Any, str, bool]] = [(entity, None, parent, False) for entity in reversed(entities)]
        while pending:
            entity, container, above, in_element = pending.pop()
            if entity.id() in self._written or _is_any(entity, NOT_PHYSICAL):
                continue
            self._written.add(entity.id())
            is_group = _is_any(entity, _SPATIAL) and not entity.is_a("IfcSpace")
            path = self._write_entity(entity, container, above, in_element)
            if entity.is_a("IfcSpace"):
                # A component must not contain components, so the contents of a room are its siblings.
                below = [(part, entity, above, False) for part in (*_parts(entity), *_contained(entity))]
            else:
                below = [(part, None, path, not is_group) for part in (*_parts(entity), *_contained(entity))]
            pending.extend(reversed(below))

    def _write_entity(self, entity: Any, container: Any, parent: str, in_element: bool) -> str:
        prim = self._author.define(parent, name_of(entity), display_name=numbered_name(entity))
        prim.SetCustomDataByKey("ifc", custom_data(entity_data(entity, self._metres, container)))
        prim.SetCustomDataByKey(SOURCE_ID, entity.GlobalId)
        path = str(prim.GetPath())
        shape = self._shapes.get(entity.id())
        if entity.is_a("IfcSpace"):
            _describe(prim, entity, Kind.Tokens.component)
            self._write_room(prim, shape)
        elif _is_any(entity, _SPATIAL):
            _describe(prim, entity, Kind.Tokens.group)
            if shape is not None:
                body = self._author.define(path, kind_word(entity) or "body")
                Usd.ModelAPI(body).SetKind(Kind.Tokens.component)
                self._write_mesh(body, shape)
        else:
            kind = Kind.Tokens.subcomponent if in_element else Kind.Tokens.component
            _describe(prim, entity, kind if self._has_geometry(entity) else None)
            if shape is not None:
                self._bind(self._write_mesh(prim, shape), entity)
        return path

    def _has_geometry(self, entity: Any) -> bool:
        pending, seen = [entity], set()
        while pending:
            part = pending.pop()
            if part.id() in self._shapes:
                return True
            if part.id() not in seen:
                seen.add(part.id())
                pending.extend(_parts(part))
        return False

    def _write_mesh(self, prim: Usd.Prim, shape: Shape) -> Usd.Prim:
        path = str(prim.GetPath())
        above = nearest_in(path.rpartition("/")[0], self._worlds)
        outer = None if above is None else self._worlds[above]
        world = self._worlds[path] = shape.matrix
        self._author.move(prim, world if outer is None else np.linalg.inv(outer) @ world)
        return self._author.define_mesh(path, "body", shape.mesh)

    def _write_room(self, prim: Usd.Prim, shape: Shape | None) -> None:
        """Write the box of a room, and its solid as a guide, since it would hide and touch the contents of the room."""
        if shape is None:
            return
        mesh = self._write_mesh(prim, shape)
        UsdGeom.Imageable(mesh).CreatePurposeAttr(UsdGeom.Tokens.guide)
        points = shape.mesh.points
        hint = Vt.Vec3fArray([tuple(points.min(axis=0).tolist()), tuple(points.max(axis=0).tolist())])
        UsdGeom.ModelAPI.Apply(prim).SetExtentsHint(hint)

    def _bind(self, mesh: Usd.Prim, entity: Any) -> None:
        names = material_names(entity)
        if names and self._materials is not None:
            self._materials.bind(mesh, SurfaceMaterial(names[0]))


def _describe(prim: Usd.Prim, entity: Any, kind: str | None) -> None:
    """Author kind and label of an entity."""
    if kind is not None:
        Usd.ModelAPI(prim).SetKind(kind)
    word = kind_word(entity)
    if word is not None and kind in {Kind.Tokens.component, Kind.Tokens.subcomponent}:
        labels = UsdSemantics.LabelsAPI.Apply(prim, "class")
        labels.CreateLabelsAttr().Set(Vt.TokenArray([word]))


def _parts(entity: Any) -> list[Any]:
    """Return the entities that an entity consists of, in the order of the file."""
    relations = [*getattr(entity, "IsDecomposedBy", ()), *getattr(entity, "IsNestedBy", ())]
    return sorted((part for relation in relations for part in relation.RelatedObjects), key=lambda part: part.id())


def _contained(entity: Any) -> list[Any]:
    """Return the elements in a spatial element, in the order of the file."""
    relations = getattr(entity, "ContainsElements", ())
    return sorted((part for relation in relations for part in relation.RelatedElements), key=lambda part: part.id())


def _has_whole(entity: Any) -> bool:
    """Return whether an entity is a part of another, which is written with its parts."""
    return any(getattr(entity, "Decomposes", ())) or any(getattr(entity, "Nests", ()))
