"""Visuals → prims: solids of USD, planes, polylines and meshes, with colours."""

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
from pxr import Usd, UsdGeom, UsdShade, Vt

from usd2kg.convert.materials import MaterialAuthor, SurfaceMaterial
from usd2kg.convert.prims import PrimAuthor, SourceMesh
from usd2kg.convert.sdf.budget import SdfBudget
from usd2kg.convert.sdf.meshes import MeshFiles, MeshPart
from usd2kg.convert.sdf.model import Visual
from usd2kg.convert.sdf.notes import Notes
from usd2kg.convert.sdf.resources import ResourceError, Resources
from usd2kg.convert.sdf.shapes import extrude, plane
from usd2kg.convert.sdf.values import Matrix, is_true, read_number, read_numbers
from usd2kg.convert.sdf.xml_tree import XmlElement
from usd2kg.convert.trimesh_files import MeshAuthor
from usd2kg.errors import SceneError
from usd2kg.srgb import linear_from_srgb

__all__ = ["VisualAuthor"]

_MIN_OUTLINE = 3
"""Points of a polygon."""


class VisualAuthor:
    """Authors visuals as prims."""

    def __init__(self, author: PrimAuthor, root: str, resources: Resources, notes: Notes, budget: SdfBudget) -> None:
        """Keep materials in a scope below the path `root`."""
        self._author = author
        self._resources = resources
        self._notes = notes
        self._budget = budget
        self._files = MeshFiles(resources)
        self._materials = MaterialAuthor(author, root)
        self._meshes = MeshAuthor(author, root, self._materials)
        self._shapes: dict[str, Callable[[XmlElement, Visual, str, Matrix], list[Usd.Prim]]] = {
            "box": self._box,
            "sphere": self._sphere,
            "cylinder": self._cylinder,
            "capsule": self._capsule,
            "cone": self._cone,
            "ellipsoid": self._ellipsoid,
            "plane": self._plane,
            "polyline": self._polyline,
            "mesh": self._mesh,
        }

    def define(self, parent: str, visual: Visual, matrix: Matrix) -> None:
        """Write a visual below the path `parent`, at a pose relative to it."""
        shape = next((child for child in visual.geometry.children if child.tag in self._shapes), None)
        if shape is None:
            found = next((child for child in visual.geometry.children if child.tag != "empty"), None)
            if found is not None:
                self._note(visual, found, f"the visual {visual.name!r} is a {found.tag}, which is left out")
            return
        for prim in self._shapes[shape.tag](shape, visual, parent, matrix):
            self._paint(prim, visual)

    def _solid(self, type_name: str, parent: str, name: str, matrix: Matrix, scale: tuple[float, ...]) -> Usd.Prim:
        prim = self._author.define(parent, name, type_name)
        self._author.move(prim, matrix @ np.diag([*scale, 1.0]))
        return prim

    def _box(self, shape: XmlElement, visual: Visual, parent: str, matrix: Matrix) -> list[Usd.Prim]:
        size = self._numbers(shape, visual, "size", 3, (1.0, 1.0, 1.0))
        prim = self._solid("Cube", parent, visual.name, matrix, size)
        UsdGeom.Cube(prim).CreateSizeAttr(1.0)
        return [prim]

    def _sphere(self, shape: XmlElement, visual: Visual, parent: str, matrix: Matrix) -> list[Usd.Prim]:
        prim = self._solid("Sphere", parent, visual.name, matrix, (1.0, 1.0, 1.0))
        UsdGeom.Sphere(prim).CreateRadiusAttr(self._numbers(shape, visual, "radius", 1, (1.0,))[0])
        return [prim]

    def _ellipsoid(self, shape: XmlElement, visual: Visual, parent: str, matrix: Matrix) -> list[Usd.Prim]:
        radii = self._numbers(shape, visual, "radii", 3, (1.0, 1.0, 1.0))
        prim = self._solid("Sphere", parent, visual.name, matrix, radii)
        UsdGeom.Sphere(prim).CreateRadiusAttr(1.0)
        return [prim]

    def _cylinder(self, shape: XmlElement, visual: Visual, parent: str, matrix: Matrix) -> list[Usd.Prim]:
        return [self._round("Cylinder", shape, visual, parent, matrix)]

    def _capsule(self, shape: XmlElement, visual: Visual, parent: str, matrix: Matrix) -> list[Usd.Prim]:
        return [self._round("Capsule", shape, visual, parent, matrix)]

    def _cone(self, shape: XmlElement, visual: Visual, parent: str, matrix: Matrix) -> list[Usd.Prim]:
        return [self._round("Cone", shape, visual, parent, matrix)]

    def _round(self, type_name: str, shape: XmlElement, visual: Visual, parent: str, matrix: Matrix) -> Usd.Prim:
        """Return a solid about z. As in USD, the length of a capsule is that of its cylinder."""
        prim = self._solid(type_name, parent, visual.name, matrix, (1.0, 1.0, 1.0))
        solid = getattr(UsdGeom, type_name)(prim)
        solid.CreateAxisAttr(UsdGeom.Tokens.z)
        solid.CreateRadiusAttr(self._numbers(shape, visual, "radius", 1, (1.0,))[0])
        solid.CreateHeightAttr(self._numbers(shape, visual, "length", 1, (1.0,))[0])
        extent = UsdGeom.Boundable.ComputeExtentFromPlugins(solid, Usd.TimeCode.Default())
        solid.CreateExtentAttr(extent)
        return prim

    def _plane(self, shape: XmlElement, visual: Visual, parent: str, matrix: Matrix) -> list[Usd.Prim]:
        normal = self._numbers(shape, visual, "normal", 3, (0.0, 0.0, 1.0))
        size = self._numbers(shape, visual, "size", 2, (1.0, 1.0))
        if math.hypot(*normal) < 1e-9:
            self._note(visual, shape, "the normal of the plane is 0 0 0, expected a direction; it is taken as 0 0 1")
            normal = (0.0, 0.0, 1.0)
        return [self._define_mesh(parent, visual.name, plane(normal, size), matrix)]

    def _polyline(self, shape: XmlElement, visual: Visual, parent: str, matrix: Matrix) -> list[Usd.Prim]:
        # The other polylines of a visual are its holes.
        outlines = list(visual.geometry.find_all("polyline"))
        rings = []
        for outline in outlines:
            read = (read_numbers(point, 2, visual.path, self._notes) for point in outline.find_all("point"))
            points = [point for point in read if point is not None]
            if len(points) > 1 and points[0] == points[-1]:
                points.pop()
            if len(points) >= _MIN_OUTLINE:
                rings.append(np.array(points, np.float64))
        if not rings:
            self._note(visual, shape, f"the polyline of the visual {visual.name!r} has too few points; it is left out")
            return []
        height = self._numbers(shape, visual, "height", 1, (1.0,))[0]
        return [self._define_mesh(parent, visual.name, extrude(rings, height), matrix)]

    def _define_mesh(self, parent: str, name: str, mesh: SourceMesh, matrix: Matrix) -> Usd.Prim:
        prim = self._author.define_mesh(parent, name, mesh)
        self._author.move(prim, matrix)
        return prim

    def _mesh(self, shape: XmlElement, visual: Visual, parent: str, matrix: Matrix) -> list[Usd.Prim]:
        uri = shape.text_of("uri")
        try:
            file = self._mesh_file(uri, visual.path)
            parts = self._files.parts(file)
        except (ResourceError, SceneError, OSError) as error:
            self._note(visual, shape, f"the mesh {uri} is not read ({error}); it has no geometry")
            return []
        parts, center = self._submesh(parts, shape, visual)
        self._budget.count_mesh(shape, visual.path, len(parts), sum(len(part.geometry.faces) for part in parts))
        scale = np.diag([*self._numbers(shape, visual, "scale", 3, (1.0, 1.0, 1.0)), 1.0])
        prim = self._author.define(parent, visual.name)
        self._author.move(prim, matrix)
        prims = []
        for part in parts:
            prims.append(self._meshes.define(str(prim.GetPath()), part.name, part.geometry))
            self._author.move(prims[-1], scale @ center @ part.matrix)
        return prims

    def _mesh_file(self, uri: str, path: Path) -> Path:
        file = self._resources.find(uri, path.parent)
        if not file.is_file():
            raise ResourceError("it is a folder")
        return file

    def _submesh(
        self, parts: tuple[MeshPart, ...], shape: XmlElement, visual: Visual
    ) -> tuple[tuple[MeshPart, ...], Matrix]:
        """Return the meshes that a visual names, all without a name, and the translation of their centre if asked."""
        element = shape.find("submesh")
        center = np.eye(4)
        if element is None:
            return parts, center
        name = element.text_of("name")
        found = tuple(part for part in parts if name in part.nodes)
        if not found:
            self._note(visual, element, f"the mesh {shape.text_of('uri')} has no submesh {name!r}; all of it is shown")
            return parts, center
        if is_true(element.text_of("center")):
            points = [part.geometry.vertices @ part.matrix[:3, :3].T + part.matrix[:3, 3] for part in found]
            together = np.concatenate(points)
            center[:3, 3] = -(together.min(axis=0) + together.max(axis=0)) / 2
        return found, center

    def _paint(self, prim: Usd.Prim, visual: Visual) -> None:
        """Author the colour and opacity of a visual; they come before those of its mesh."""
        material = visual.material
        diffuse = None if material is None else material.find("diffuse") or material.find("ambient")
        rgb = read_numbers(diffuse, 3, visual.path, self._notes)
        alpha = 1.0
        if rgb is not None and diffuse is not None and len(diffuse.text.split()) > 3:
            alpha = (read_numbers(diffuse, 4, visual.path, self._notes) or (1.0,))[-1]
        opacity = min(max(alpha * (1.0 - visual.transparency), 0.0), 1.0)
        color = None if rgb is None else tuple(linear_from_srgb(np.clip(rgb, 0, 1)).tolist())
        gprim = UsdGeom.Gprim(prim)
        if color is not None:
            UsdShade.MaterialBindingAPI(prim).UnbindAllBindings()
            gprim.CreateDisplayColorPrimvar(UsdGeom.Tokens.constant).Set(Vt.Vec3fArray([color]))
        if opacity < 1:
            gprim.CreateDisplayOpacityPrimvar(UsdGeom.Tokens.constant).Set(Vt.FloatArray([opacity]))
        name = self._material_name(visual)
        if name:
            self._materials.bind(prim, self._surface(name, color, opacity, visual))

    def _material_name(self, visual: Visual) -> str:
        script = None if visual.material is None else visual.material.find("script")
        # The materials of Gazebo are named `Gazebo/Wood`.
        return "" if script is None else script.text_of("name").rpartition("/")[2]

    def _surface(
        self, name: str, color: tuple[float, float, float] | None, opacity: float, visual: Visual
    ) -> SurfaceMaterial:
        pbr = None if visual.material is None else visual.material.find("pbr")
        metal = None if pbr is None else pbr.find("metal")
        roughness, metallic = (
            None if metal is None else read_number(metal.find(tag), visual.path, self._notes)
            for tag in ("roughness", "metalness")
        )
        return SurfaceMaterial(name, color, opacity if opacity < 1 else None, roughness, metallic)

    def _numbers(
        self, shape: XmlElement, visual: Visual, tag: str, count: int, default: tuple[float, ...]
    ) -> tuple[float, ...]:
        found = read_numbers(shape.find(tag), count, visual.path, self._notes)
        return default if found is None else found

    def _note(self, visual: Visual, element: XmlElement, text: str) -> None:
        self._notes.add(visual.path, element, text)
